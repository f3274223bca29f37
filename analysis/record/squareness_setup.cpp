#include "analysis/record/squareness_setup.hpp"

namespace axiscal {

std::string_view name_of(SquarePosition position) {
    return position == SquarePosition::turned ? "turned" : "normal";
}

} // namespace axiscal
