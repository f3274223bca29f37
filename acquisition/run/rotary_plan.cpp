#include "acquisition/run/rotary_plan.hpp"

#include "acquisition/capture/wording.hpp"
#include "analysis/rotary/rotary_position.hpp"

#include <cmath>
#include <string>

namespace axiscal {
namespace {

constexpr double rounding_deg = 1e-6;

std::string in_deg(double angle_deg) {
    return plain_number(angle_deg, 4) + " deg";
}

tl::unexpected<Error> refused(std::string field, std::string reason) {
    return refuse(Fault::bad_configuration, std::move(field), std::move(reason));
}

Result<void> check_faces(const RunPlan& plan, const RotarySetup& setup) {
    for (const Length target : plan.targets) {
        const double beside_deg = std::remainder(target.in(mm), setup.step_deg);
        if (std::fabs(beside_deg) > rounding_deg)
            return refused("cycle.targets",
                           "The target " + in_deg(target.in(mm)) +
                               " lies between two faces of the polygon, which are " +
                               in_deg(setup.step_deg) + " apart: list targets at its faces.");
    }
    return {};
}

} // namespace

Result<void> check_rotary_plan(const RunPlan& plan, const RotarySetup& setup) {
    if (setup.method == AngleMethod::polygon) return check_faces(plan, setup);
    const double step_deg = setup.step_deg, overrun_deg = plan.overrun.in(mm);
    const double reach_deg = step_deg / 2 + overrun_deg;
    if (reach_deg > setup.range_deg * usable_share_of_range)
        return refused("cycle.overrun",
                       "Half a step of the table and the overrun are " + in_deg(reach_deg) +
                           ", and the interferometer sees " + in_deg(setup.range_deg) +
                           ": make the overrun smaller, or take a table with a finer step.");
    if (plan.near_tolerance.in(mm) > step_deg / 2)
        return refused("cycle.near_tolerance",
                       "With a tolerance of " + in_deg(plan.near_tolerance.in(mm)) +
                           " a table that stands one step of " + in_deg(step_deg) +
                           " off would pass: make it half a step or less.");
    return {};
}

} // namespace axiscal
