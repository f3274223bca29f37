#include "analysis/uncertainty/budget_input.hpp"

namespace axiscal {

std::string_view name_of(InputOrigin origin) {
    switch (origin) {
    case InputOrigin::typed: return "typed";
    case InputOrigin::certificate: return "certificate";
    case InputOrigin::drift_test: return "drift_test";
    case InputOrigin::readings: return "readings";
    case InputOrigin::missing: return "missing";
    }
    return "";
}

} // namespace axiscal
