#include "drivers/sample.hpp"

namespace axiscal {

std::string_view name_of(Quality quality) {
    switch (quality) {
    case Quality::good: return "good";
    case Quality::signal_error: return "signal_error";
    case Quality::beam_lost: return "beam_lost";
    case Quality::absent: return "absent";
    }
    return "?";
}

} // namespace axiscal
