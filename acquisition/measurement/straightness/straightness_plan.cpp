#include "acquisition/measurement/straightness/straightness_plan.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/target_positions.hpp"
#include "analysis/record/test_kind.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace axiscal {
namespace {

constexpr int fewest_targets_across = 3, most_targets_across = 1000;
constexpr Length binary_rounding = 1.0_nm; ///< travel is written in decimals

Length lowest_across(const CycleConfig& cycle) {
    return cycle.travel_low + cycle.overrun;
}

Length highest_across(const CycleConfig& cycle) {
    return cycle.travel_high - cycle.overrun;
}

/// What every control can be told exactly.
Length whole_micrometre(Length coordinate) {
    return mm(std::round(coordinate.in(um)) / 1000);
}

tl::unexpected<Error> refuse_across(const std::string& key, std::string reason) {
    return refuse(Fault::bad_configuration, key, std::move(reason));
}

std::string reach_text(Length low, Length high) {
    return "from " + in_mm(low) + " to " + in_mm(high);
}

Result<void> check_targets_across(const CycleConfig& cycle, const std::vector<Length>& targets) {
    const std::string has = "has " + counted(std::ssize(targets), "target");
    if (std::ssize(targets) < fewest_targets_across)
        return refuse_across("targets", has + ", and fewer than " +
                                            std::to_string(fewest_targets_across) +
                                            " lie on a line whatever the axis does: list more, or "
                                            "state a smaller interval");
    if (std::ssize(targets) > most_targets_across)
        return refuse_across("targets", has + " or more, and " +
                                            std::to_string(most_targets_across) +
                                            " are enough: state a larger interval");
    if (std::ranges::adjacent_find(targets, std::greater_equal<>{}) != targets.end())
        return refuse_across("targets", "does not rise from each target to the next: sort the list "
                                        "and keep each one once");
    const Length low = lowest_across(cycle), high = highest_across(cycle);
    for (const Length target : targets)
        if (target < low - binary_rounding || target > high + binary_rounding)
            return refuse_across("targets", in_mm(target) +
                                                " leaves no overrun inside the travel: keep every "
                                                "target " +
                                                reach_text(low, high));
    return {};
}

Result<void> check_overrun_across(const CycleConfig& cycle) {
    if (lowest_across(cycle) < highest_across(cycle)) return {};
    return refuse_across("overrun", in_mm(cycle.overrun) +
                                        " at both ends leaves nothing of the travel " +
                                        reach_text(cycle.travel_low, cycle.travel_high) +
                                        ": state a shorter overrun");
}

Result<Length> datum_across(const CycleConfig& cycle, Length first) {
    const Length datum =
        cycle.datum.value_or(std::max(first - cycle.overrun * 2, cycle.travel_low));
    if (datum >= cycle.travel_low - binary_rounding && datum <= cycle.travel_high + binary_rounding)
        return datum;
    return refuse_across("datum", in_mm(datum) + " lies outside the travel: name a place " +
                                      reach_text(cycle.travel_low, cycle.travel_high));
}

} // namespace

std::vector<Length> targets_each(const CycleConfig& cycle, Length interval) {
    const Length low = lowest_across(cycle), high = highest_across(cycle);
    std::vector<Length> targets;
    for (int i = 0; i <= most_targets_across; ++i) { // one more shows that they are too many
        const Length target = whole_micrometre(low + interval * i);
        if (target > high + binary_rounding) break;
        targets.push_back(target);
    }
    return targets;
}

std::vector<Length> even_targets(const CycleConfig& cycle, int count) {
    const Length low = lowest_across(cycle), high = highest_across(cycle);
    std::vector<Length> targets;
    for (int i = 0; i < count; ++i)
        targets.push_back(whole_micrometre(low + (high - low) * (i / (count - 1.0))));
    return targets;
}

Result<RunPlan> plan_across(const CycleConfig& cycle) {
    AXISCAL_CHECK(check_overrun_across(cycle));
    RunPlan plan;
    plan.targets = cycle.targets.value_or(std::vector<Length>{});
    AXISCAL_CHECK(check_targets_across(cycle, plan.targets));
    plan.pass = name_of(TestKind::straightness);
    plan.remark = "The targets have no random part: none is needed across the axis.";
    plan.approaches = cycle.approaches;
    plan.interval = smallest_spacing(plan.targets);
    plan.overrun = cycle.overrun;
    plan.near_tolerance = std::min(0.5_mm, plan.interval / 10);
    AXISCAL_TRY(plan.datum, datum_across(cycle, plan.targets.front()));
    plan.points =
        order_points(plan.cycle, static_cast<int>(plan.targets.size()), plan.approaches, true);
    return plan;
}

} // namespace axiscal
