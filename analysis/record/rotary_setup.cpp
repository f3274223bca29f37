#include "analysis/record/rotary_setup.hpp"

namespace axiscal {

std::string_view name_of(AngleMethod method) {
    return method == AngleMethod::polygon ? "polygon" : "indexing_table";
}

} // namespace axiscal
