#include "analysis/circular/circle_watch.hpp"

#include "analysis/circular/circle_cut.hpp"

#include <utility>

namespace axiscal {

CircleWatch::CircleWatch(CircularSetup setup)
    : setup_{std::move(setup)} {}

void CircleWatch::see(double reading_m) {
    const bool beside = height_above_step_mm(setup_, reading_m) >= 0;
    if (stage_ == Stage::unknown && beside) stage_ = Stage::beside;
    if (stage_ == Stage::beside && !beside) stage_ = Stage::within;
    if (stage_ == Stage::within && beside) stage_ = Stage::driven;
}

} // namespace axiscal
