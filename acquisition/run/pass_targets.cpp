#include "acquisition/run/pass_targets.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/principal_positions.hpp"
#include "analysis/positioning/target_rule.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

Length whole_steps_above(Length length) {
    return target_step * std::ceil(length / target_step - 1e-6);
}

/// The widest with which `count` drawn targets fit whatever their random part is.
Length widest_interval(const Pass& pass, int count) {
    return whole_steps_below((highest(pass) - lowest(pass) - target_step) /
                             (count - 1 + 2 * random_share));
}

Result<Length> interval_of(const Pass& pass) {
    const auto& config = pass.config;
    if (!config.interval && !config.target_count)
        return refuse_plan("interval", "Give a list of targets, an interval, or a target count.");
    if (config.target_count && *config.target_count < 2)
        return refuse_plan("target_count", "At least 2 targets are needed.");
    if (config.interval) return whole_steps_below(*config.interval);
    const Length widest = widest_interval(pass, *config.target_count);
    return config.axis_kind == AxisKind::rotary ? std::min(widest, turn_interval) : widest;
}

/// 0, 90, 180 and 270 degrees are asked for on a rotary axis of up to one turn.
bool wants_principal_positions(const Pass& pass) {
    return pass.config.axis_kind == AxisKind::rotary &&
           !is_long_travel(pass.config, pass.end - pass.begin);
}

Length usual_first_target(const Pass& pass, Length interval) {
    if (wants_principal_positions(pass))
        return first_for_principal_positions(lowest(pass), highest(pass), interval,
                                             pass.config.target_count.value_or(0));
    return whole_steps_above(lowest(pass) + interval * random_share);
}

/// On a rotary axis targets without a random part stand at the principal positions.
Result<void> check_interval(const Pass& pass, Length interval) {
    const auto& config = pass.config;
    const std::string named = "An interval of " + in_unit(config, interval);
    if (interval < 10 * target_step)
        return refuse_plan("interval", named + " is too small to draw a random part.");
    const bool two_fit = interval <= widest_interval(pass, 2) + target_step;
    if (two_fit || wants_principal_positions(pass)) return {};
    const int least = least_targets(config.axis_kind, pass.end - pass.begin);
    return refuse_plan("interval", named + " is too long: between " +
                                       in_unit(config, lowest(pass)) + " and " +
                                       in_unit(config, highest(pass)) +
                                       ", the travel without its overrun, not even two targets "
                                       "fit; take " +
                                       in_unit(config, widest_interval(pass, least)) + " or less.");
}

tl::unexpected<Error>
refuse_first_target(const Pass& pass, Length first, Length interval, Length may_fall_to) {
    const auto& config = pass.config;
    const Length least = lowest(pass) + (first - may_fall_to);
    return refuse_plan(
        config.first_target ? "first_target" : "interval",
        "At an interval of " + in_unit(config, interval) + " the first target of " +
            in_unit(config, first) + " may fall to " + in_unit(config, may_fall_to) +
            "; with its overrun the lowest possible is " + in_unit(config, lowest(pass)) + ": " +
            (config.first_target
                 ? "leave first_target out, take " + in_unit(config, least) + " or more, or take"
                 : std::string{"take"}) +
            " a smaller interval.");
}

Result<PassTargets> draw_targets(const Pass& pass) {
    const auto& config = pass.config;
    AXISCAL_TRY(const Length interval, interval_of(pass));
    AXISCAL_CHECK(check_interval(pass, interval));
    const auto low = lowest(pass), high = highest(pass);
    const auto first = config.first_target.value_or(usual_first_target(pass, interval));
    const bool principal = wants_principal_positions(pass);
    const auto reach_at = [&](Length place) {
        return principal && is_principal_position(place) ? Length{} : interval * random_share;
    };
    int fit = static_cast<int>(std::floor((high - first) / interval + 1e-6)) + 1;
    const Length end = first + interval * (fit - 1);
    if (fit > 0 && end + reach_at(end) > high + interval * 1e-6) --fit;
    const int count = config.target_count.value_or(fit);
    const Length last = first + interval * (count - 1);
    if (first - reach_at(first) < low - rounding)
        return refuse_first_target(pass, first, interval, first - reach_at(first));
    if (count > fit)
        return refuse_plan("target_count", std::to_string(count) + " targets at intervals of " +
                                               in_unit(config, interval) + " reach up to " +
                                               in_unit(config, last + reach_at(last)) +
                                               "; with the overrun the highest possible is " +
                                               in_unit(config, high) + ": " +
                                               std::to_string(std::max(fit, 0)) + " fit.");
    if (config.cycle == CycleKind::standard && config.overrun > (1 - 2 * random_share) * interval)
        return refuse_plan("overrun", "An overrun of " + in_unit(config, config.overrun) +
                                          " is longer than the shortest way between two targets, "
                                          "0.4 of the interval: take an interval of " +
                                          in_unit(config, config.overrun / 0.4) + " or more.");
    PassTargets drawn{spread_targets(first, interval, count, pass.seed), interval, pass.seed};
    if (principal) take_principal_positions(drawn.positions, first, interval, low, high);
    return drawn;
}

Result<PassTargets> listed_targets(const Pass& pass) {
    const auto& config = pass.config;
    PassTargets targets;
    for (const auto target : *config.targets) {
        const auto place = "targets[" + std::to_string(targets.positions.size()) + "]";
        if (target < config.travel_low - rounding || target > config.travel_high + rounding)
            return refuse_plan(place, "The target " + in_unit(config, target) +
                                          " lies outside the travel from " +
                                          in_unit(config, config.travel_low) + " to " +
                                          in_unit(config, config.travel_high) + ".");
        if (target < pass.begin - rounding || target > pass.end + rounding) continue;
        if (!targets.positions.empty() && target <= targets.positions.back())
            return refuse_plan(place, "The target " + in_unit(config, target) +
                                          " does not lie above the one before it, " +
                                          in_unit(config, targets.positions.back()) + ".");
        targets.positions.push_back(target);
    }
    const auto count = targets.positions.size();
    if (count < 2)
        return refuse_plan("targets", "Only " + counted(static_cast<long>(count), "target") +
                                          " of the list can be used.");
    targets.interval =
        (targets.positions.back() - targets.positions.front()) / static_cast<double>(count - 1);
    return targets;
}

Result<void> check_overrun(const Pass& pass, const PassTargets& targets) {
    const auto& config = pass.config;
    const auto end_refusal = [&](Length target, Length end, const char* which) {
        return refuse_plan(
            "overrun", "From the " + std::string{which} + " target at " + in_unit(config, target) +
                           " an overrun of " + in_unit(config, config.overrun) +
                           " leaves the travel, which ends at " + in_unit(config, end) + ".");
    };
    const auto first = targets.positions.front(), last = targets.positions.back();
    if (first - config.overrun < config.travel_low - rounding)
        return end_refusal(first, config.travel_low, "first");
    if (last + config.overrun > config.travel_high + rounding)
        return end_refusal(last, config.travel_high, "last");
    const auto spacing = smallest_spacing(targets.positions);
    if (config.cycle == CycleKind::standard && spacing < config.overrun - rounding)
        return refuse_plan("overrun", "Two targets are only " + in_unit(config, spacing) +
                                          " apart, less than the overrun of " +
                                          in_unit(config, config.overrun) +
                                          ": the approach could not be seen.");
    return {};
}

/// Over 2000 mm (360 degrees) the mean interval rules, and both ends must be reached.
Result<void> check_long_pass(const Pass& pass, const PassTargets& targets, Length limit) {
    const auto& config = pass.config;
    if (targets.interval > limit + rounding)
        return refuse_plan("interval", "The mean interval of " + in_unit(config, targets.interval) +
                                           " exceeds " + in_unit(config, limit) +
                                           ", the most for this travel.");
    // 1.6 intervals: what a random first and last target may leave free at most.
    const auto free_end = limit * 1.6 + config.overrun;
    const auto below = targets.positions.front() - pass.begin;
    const auto above = pass.end - targets.positions.back();
    if (std::max(below, above) > free_end + rounding)
        return refuse_plan("targets", "The targets leave " +
                                          in_unit(config, std::max(below, above)) +
                                          " at one end of the travel untested, at most " +
                                          in_unit(config, free_end) + " are allowed.");
    return {};
}

Result<void> check_standard(const Pass& pass, const PassTargets& targets) {
    const auto& config = pass.config;
    const bool rotary = config.axis_kind == AxisKind::rotary;
    const auto travel = pass.end - pass.begin;
    if (is_long_travel(config, travel))
        return check_long_pass(pass, targets, rotary ? turn_interval : long_interval);
    if (rotary && targets.interval > turn_interval + rounding)
        return refuse_plan("interval", "The mean interval of " + in_unit(config, targets.interval) +
                                           " exceeds " + in_unit(config, turn_interval) +
                                           ", the most on a rotary axis.");
    const int least = least_targets(config.axis_kind, travel);
    const auto count = static_cast<int>(targets.positions.size());
    if (count >= least) return {};
    return refuse_plan("targets", counted(count, "target") + " on " + in_unit(config, travel) +
                                      ": the standard asks for at least " + std::to_string(least) +
                                      "; take a smaller interval or more targets.");
}

} // namespace

std::string in_unit(const CycleConfig& config, Length length) {
    return plain_number(length.in(mm), 3) +
           (config.axis_kind == AxisKind::rotary ? " degree" : " mm");
}

tl::unexpected<Error> refuse_plan(std::string field, std::string reason) {
    return refuse(Fault::bad_configuration, std::move(field), std::move(reason));
}

Length whole_steps_below(Length length) {
    return target_step * std::floor(length / target_step + 1e-6);
}
Length lowest(const Pass& pass) {
    return std::max(pass.begin, pass.config.travel_low + pass.config.overrun);
}
Length highest(const Pass& pass) {
    return std::min(pass.end, pass.config.travel_high - pass.config.overrun);
}

bool is_long_travel(const CycleConfig& config, Length travel) {
    if (config.axis_kind == AxisKind::rotary)
        return travel - config.overrun * 2 > full_turn + rounding;
    return travel > long_axis + rounding;
}

int least_targets(AxisKind kind, Length travel) {
    return target_rule_for(kind, travel.in(mm)).least_targets;
}

Result<PassTargets> targets_of(const Pass& pass) {
    AXISCAL_TRY(auto targets, pass.config.targets ? listed_targets(pass) : draw_targets(pass));
    const auto checked =
        check_standard(pass, targets).and_then([&] { return check_overrun(pass, targets); });
    if (!checked) return tl::unexpected<Error>(checked.error());
    return targets;
}

} // namespace axiscal
