#include "acquisition/run/cycle_plan.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/pass_targets.hpp"
#include "acquisition/run/principal_positions.hpp"

#include <algorithm>
#include <numbers>

namespace axiscal {
namespace {

Result<void> check_basics(const CycleConfig& config) {
    if (config.travel_high <= config.travel_low)
        return refuse_plan("travel", "The travel ends at " + in_unit(config, config.travel_high) +
                                         ", not above its begin at " +
                                         in_unit(config, config.travel_low) + ".");
    if (config.overrun <= Length{})
        return refuse_plan("overrun",
                           "The overrun must be greater than 0, twice the backlash or more.");
    if (config.overrun * 2 >= config.travel_high - config.travel_low)
        return refuse_plan("overrun", "An overrun of " + in_unit(config, config.overrun) +
                                          " at both ends leaves nothing of the travel.");
    if (config.approaches < 1 || config.approaches > 100)
        return refuse_plan("approaches", std::to_string(config.approaches) +
                                             " approaches are not between 1 and 100.");
    return {};
}

Length near_tolerance_of(const CycleConfig& config, const PassTargets& targets) {
    if (config.near_tolerance) return *config.near_tolerance;
    const auto interval = targets.seed ? targets.interval : smallest_spacing(targets.positions);
    return std::min(0.5_mm, interval / 10);
}

Result<void> check_near_tolerance(const RunPlan& plan, const CycleConfig& config) {
    const auto spacing = smallest_spacing(plan.targets);
    if (plan.near_tolerance > Length{} && plan.near_tolerance < spacing / 2) return {};
    return refuse_plan("near_tolerance",
                       "A tolerance of " + in_unit(config, plan.near_tolerance) +
                           " cannot tell targets apart that are " + in_unit(config, spacing) +
                           " from each other: it must be greater than 0 and below half of that.");
}

Result<Length> datum_of(const CycleConfig& config, Length first) {
    const auto datum =
        config.datum.value_or(std::max(first - config.overrun * 2, config.travel_low));
    if (datum < config.travel_low - rounding || datum > config.travel_high + rounding)
        return refuse_plan("datum", "The datum " + in_unit(config, datum) +
                                        " lies outside the travel from " +
                                        in_unit(config, config.travel_low) + " to " +
                                        in_unit(config, config.travel_high) + ".");
    if (abs(datum - first) < config.overrun - rounding)
        return refuse_plan("datum", "The datum " + in_unit(config, datum) +
                                        " is nearer to the first target at " +
                                        in_unit(config, first) + " than the overrun of " +
                                        in_unit(config, config.overrun) +
                                        ": the first approach could not be seen.");
    return datum;
}

/// A list may leave them out, too; the certificate says so.
std::string principal_positions_left_out(const Pass& pass, const RunPlan& plan) {
    if (plan.axis_kind != AxisKind::rotary || is_long_travel(pass.config, pass.end - pass.begin))
        return {};
    return missing_principal_positions(plan.targets, lowest(pass), highest(pass));
}

/// Everything but the phases.
Result<RunPlan> build_pass(const Pass& pass) {
    const auto& config = pass.config;
    AXISCAL_TRY(auto targets, targets_of(pass));
    RunPlan plan;
    plan.axis_kind = config.axis_kind;
    plan.cycle = config.cycle;
    plan.pass = pass.name;
    plan.remark = pass.remark;
    plan.approaches = config.approaches;
    plan.bidirectional = config.bidirectional;
    plan.interval = targets.interval;
    plan.seed = targets.seed;
    plan.overrun = config.overrun;
    plan.near_tolerance = near_tolerance_of(config, targets);
    AXISCAL_TRY(plan.datum, datum_of(config, targets.positions.front()));
    plan.targets = std::move(targets.positions);
    if (auto checked = check_near_tolerance(plan, config); !checked)
        return tl::unexpected<Error>(checked.error());
    if (const std::string missing = principal_positions_left_out(pass, plan); !missing.empty())
        plan.remark = "No target stands at the principal positions " + missing + " degrees.";
    plan.points = order_points(plan.cycle, static_cast<int>(plan.targets.size()), plan.approaches,
                               plan.bidirectional);
    return plan;
}

bool phases_spread(const RunPlan& plan, Length pitch) {
    return phase_spread(plan.targets, pitch) >= pitch / 4;
}

/// An interval near `interval` whose drawn targets spread, whatever of eight seeds is used.
std::optional<Length> healing_interval(const Pass& bunched, Length interval, Length pitch) {
    constexpr int tries = 64, seeds = 8;
    for (int k = 1; k <= tries; ++k)
        for (const int side : {-1, 1}) {
            Pass trial = bunched;
            trial.config.targets.reset();
            trial.config.first_target.reset();
            trial.config.interval = whole_steps_below(interval * (1 + side * k / 128.0));
            bool heals = true;
            for (int s = 0; heals && s < seeds; ++s) {
                trial.seed = bunched.seed + static_cast<std::uint64_t>(s);
                const auto plan = build_pass(trial);
                heals = plan && phases_spread(*plan, pitch);
            }
            if (heals) return trial.config.interval;
        }
    return std::nullopt;
}

Result<RunPlan> plan_pass(const Pass& pass) {
    AXISCAL_TRY(auto plan, build_pass(pass));
    const auto& config = pass.config;
    if (!config.feedback_pitch || *config.feedback_pitch <= Length{}) return plan;
    const auto pitch = *config.feedback_pitch;
    if (phases_spread(plan, pitch)) return plan;
    const auto heals = healing_interval(pass, plan.interval, pitch);
    return refuse_plan(
        "targets",
        "Within the feedback pitch of " + in_unit(config, pitch) + " the targets cover only " +
            in_unit(config, phase_spread(plan.targets, pitch)) +
            ", less than a quarter of it, so the run cannot show the periodic error: " +
            (heals ? "take an interval of " + in_unit(config, *heals) +
                         " with targets drawn at random."
                   : std::string{"no interval near this one helps; list targets at other places "
                                 "within the pitch, or leave the feedback pitch out."}));
}

bool is_bunched(const Pass& pass, Length pitch) {
    const auto plan = build_pass(pass);
    return plan && !phases_spread(*plan, pitch);
}

Pass whole_pass(const CycleConfig& config, std::uint64_t seed) {
    return Pass{config, "whole", {}, config.travel_low, config.travel_high, seed};
}

/// The 2000 mm stretch as a short axis of its own; its overrun may use the rest of the travel.
Result<Pass> stretch_pass(const CycleConfig& config, std::uint64_t seed) {
    const auto travel = config.travel_high - config.travel_low;
    const auto begin = config.stretch_begin.value_or(config.travel_low + (travel - long_axis) / 2);
    if (begin < config.travel_low - rounding || begin + long_axis > config.travel_high + rounding)
        return refuse_plan("stretch_begin", "A stretch of 2000 mm from " + in_unit(config, begin) +
                                                " leaves the travel.");
    Pass pass{config, "stretch", {}, begin, begin + long_axis, seed};
    pass.config.first_target.reset();
    pass.config.target_count.reset();
    pass.config.datum.reset();
    if (config.targets) return pass;
    const int least = least_targets(AxisKind::linear, long_axis);
    const auto widest = whole_steps_below((highest(pass) - lowest(pass) - target_step) /
                                          (least - 1 + 2 * random_share));
    pass.config.interval = std::min(config.interval.value_or(widest), widest);
    return pass;
}

/// A seed that nobody chose is drawn again where its targets happen to bunch: some do of each plan.
std::uint64_t drawn_seed(const CycleConfig& config, std::uint64_t fresh_seed, bool with_stretch) {
    constexpr std::uint64_t most_draws = 16;
    const Length pitch = config.feedback_pitch.value_or(Length{});
    if (pitch <= Length{}) return fresh_seed;
    for (std::uint64_t seed = fresh_seed; seed - fresh_seed < most_draws; ++seed) {
        if (is_bunched(whole_pass(config, seed), pitch)) continue;
        const auto stretch = stretch_pass(config, seed + 1);
        if (!with_stretch || !stretch || !is_bunched(*stretch, pitch)) return seed;
    }
    return fresh_seed;
}

} // namespace

std::vector<PlannedPoint>
order_points(CycleKind cycle, int targets, int approaches, bool bidirectional) {
    std::vector<PlannedPoint> points;
    const auto add = [&](int target, Direction direction, int approach) {
        points.push_back({static_cast<int>(points.size()), target, direction, approach});
    };
    if (cycle == CycleKind::step) {
        for (int i = 0; i < targets; ++i) {
            for (int j = 0; j < approaches; ++j)
                add(i, Direction::positive, j);
            for (int j = 0; bidirectional && j < approaches; ++j)
                add(i, Direction::negative, j);
        }
        return points;
    }
    for (int j = 0; j < approaches; ++j) {
        for (int i = 0; i < targets; ++i)
            add(i, Direction::positive, j);
        for (int i = targets - 1; bidirectional && i >= 0; --i)
            add(i, Direction::negative, j);
    }
    return points;
}

Result<std::vector<RunPlan>> plan_passes(const CycleConfig& config, std::uint64_t fresh_seed) {
    if (auto sound = check_basics(config); !sound) return tl::unexpected<Error>(sound.error());
    const bool rotary = config.axis_kind == AxisKind::rotary;
    const bool is_long = is_long_travel(config, config.travel_high - config.travel_low);
    const bool with_stretch = is_long && !rotary && !config.stretch_declined;
    const auto seed = config.seed ? *config.seed : drawn_seed(config, fresh_seed, with_stretch);
    auto whole = whole_pass(config, seed);
    if (is_long) {
        whole.config.approaches = 1;
        if (!rotary && config.stretch_declined)
            whole.remark = "The 2000 mm stretch was declined: " + *config.stretch_declined;
    }
    std::vector<RunPlan> plans;
    AXISCAL_TRY(auto first, plan_pass(whole));
    plans.push_back(std::move(first));
    if (!with_stretch) return plans;
    AXISCAL_TRY(const auto stretch, stretch_pass(config, seed + 1));
    AXISCAL_TRY(auto second, plan_pass(stretch));
    plans.push_back(std::move(second));
    return plans;
}

Duration least_time_of(const RunPlan& plan, Speed feed, Duration dwell) {
    Length way;
    for (std::size_t i = 1; i < plan.points.size(); ++i) {
        const auto target = [&](std::size_t k) {
            return plan.targets[static_cast<std::size_t>(plan.points[k].target_index)];
        };
        way = way + abs(target(i) - target(i - 1));
    }
    const double moving_s = feed > Speed{} ? way.si() / feed.si() : 0;
    return from_seconds(moving_s) + static_cast<int>(plan.points.size()) * dwell;
}

Duration least_time_of(const CircularPlan& plan) {
    const double circles = static_cast<double>(plan.senses.size()) * (plan.repeats + plan.warm_up);
    const double arc_mm = plan.nominal_radius_mm * plan.arc_deg * std::numbers::pi / 180;
    return from_seconds(plan.feed_mm_per_s > 0 ? circles * arc_mm / plan.feed_mm_per_s : 0);
}

} // namespace axiscal
