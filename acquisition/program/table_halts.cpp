#include "acquisition/program/table_halts.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr double rounding = 1e-6; // decimal steps in binary

} // namespace

std::vector<TableHalt> table_halts(const RotarySetup& setup,
                                   double datum_deg,
                                   double from_deg,
                                   int position,
                                   double goal_deg,
                                   int wanted) {
    const double step_deg = setup.step_deg, usable_deg = setup.range_deg * usable_share_of_range;
    const int stride = std::max(1, static_cast<int>(std::floor(usable_deg / step_deg + rounding)));
    const int way = goal_deg >= from_deg ? 1 : -1;
    std::vector<TableHalt> halts;
    while (std::fabs(goal_deg - datum_deg - position * step_deg) > usable_deg) {
        position += way * stride;
        halts.push_back({datum_deg + position * step_deg, position});
    }
    if (position != wanted) halts.push_back({goal_deg, wanted});
    return halts;
}

} // namespace axiscal
