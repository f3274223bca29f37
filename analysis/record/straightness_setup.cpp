#include "analysis/record/straightness_setup.hpp"

namespace axiscal {

std::string_view name_of(StraightnessMethod method) {
    return method == StraightnessMethod::angle_steps ? "angle-steps" : "wollaston";
}

std::string_view name_of(MirrorPosition position) {
    return position == MirrorPosition::reversed ? "reversed" : "normal";
}

} // namespace axiscal
