#include "tools/axiscal/imports/standstill_map.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/cycle_plan.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace axiscal {
namespace {

using namespace std::chrono_literals;

constexpr Length farthest_target = metre(1000);

Length coordinate_in(Settings& table,
                     const char* key,
                     AxisKind kind,
                     Length low,
                     Length high,
                     const std::optional<Length>& otherwise = {}) {
    return kind == AxisKind::linear ? table.length(key, low, high, otherwise)
                                    : table.rotary_length(key, low, high, otherwise);
}

Speed speed_in(Settings& table, const char* key, AxisKind kind, Speed low, Speed otherwise) {
    constexpr Speed high = metre_per_second(20); // of a light axis
    return kind == AxisKind::linear ? table.speed(key, low, high, otherwise)
                                    : table.rotary_speed(key, low, high, otherwise);
}

void read_places(Settings& table, RunPlan& plan) {
    plan.targets = plan.axis_kind == AxisKind::linear
                       ? table.lengths("targets", -farthest_target, farthest_target)
                       : table.rotary_lengths("targets", -farthest_target, farthest_target);
    if (table.refused("targets")) return;
    constexpr std::size_t most = 1000;
    if (plan.targets.size() < 2 || plan.targets.size() > most)
        return table.refuse("targets", "needs from 2 to " + std::to_string(most) + " targets");
    const bool rise =
        std::ranges::adjacent_find(plan.targets, std::greater_equal<>{}) == plan.targets.end();
    if (!rise) table.refuse("targets", "must rise; `begins` says from which end the axis starts");
}

/// The axis may begin at the far end: the same points, seen from there.
void turn_round(RunPlan& plan) {
    const int last = static_cast<int>(plan.targets.size()) - 1;
    for (PlannedPoint& point : plan.points) {
        point.target_index = last - point.target_index;
        point.direction =
            point.direction == Direction::positive ? Direction::negative : Direction::positive;
    }
}

void read_cycle_of_stops(Settings& table, RunPlan& plan) {
    const bool step = table.choice("cycle", {"standard", "step"}) == "step";
    plan.cycle = step ? CycleKind::step : CycleKind::standard;
    plan.approaches = static_cast<int>(table.integer("approaches", 1, 100));
    plan.bidirectional = table.flag("bidirectional");
    const bool low = table.choice("begins", {"low", "high"}, "low") == "low";
    plan.points = order_points(plan.cycle, static_cast<int>(plan.targets.size()), plan.approaches,
                               plan.bidirectional);
    if (!low) turn_round(plan);
}

/// The axis leaves a target where it leaves its neighbourhood: an overrun must lead out of it, or
/// the two stops of a reversal were one.
void read_neighbourhood(Settings& table, RunPlan& plan) {
    plan.overrun = coordinate_in(table, "overrun", plan.axis_kind, mm(0.01), metre(1));
    const bool known = !table.refused("targets") && !table.refused("overrun");
    const Length spacing = known ? smallest_spacing(plan.targets) : mm(1);
    const Length usual = std::min({0.5_mm, spacing / 10, plan.overrun / 2});
    plan.near_tolerance =
        coordinate_in(table, "near_tolerance", plan.axis_kind, um(1), mm(10), usual);
    if (known && (plan.near_tolerance >= plan.overrun || plan.near_tolerance * 2 >= spacing))
        table.refuse(
            "near_tolerance",
            "is " + in_axis_unit(plan.axis_kind, plan.near_tolerance) +
                ": it must be below the overrun and below half the spacing of the targets, or "
                "two stops cannot be told apart");
}

CaptureConfig stillness_in(Settings& table, AxisKind kind) {
    CaptureConfig config;
    config.window = table.duration("window", 10ms, 60s);
    config.spread_limit = coordinate_in(table, "spread_limit", kind, nm(1), mm(1));
    constexpr Speed usual = metre_per_second(1e-6); // as the station's
    const Speed slope = speed_in(table, "slope_limit", kind, metre_per_second(1e-9), usual);
    config.slope_limit_um_per_s = slope.si() / um.size;
    config.minimum_samples =
        static_cast<int>(table.integer("minimum_samples", 2, 100'000, config.minimum_samples));
    config.fastest = speed_in(table, "fastest", kind, mm_per_minute(0.1), Speed{});
    return config;
}

/// The length of one count: stated as such, or by the light.
double metres_per_count_in(Settings& counts) {
    if (counts.has("per_metre")) {
        for (const char* key : {"wavelength", "per_wavelength", "index"})
            if (counts.has(key))
                counts.refuse(key, "says again what per_metre says: keep one of them");
        return 1 / counts.number("per_metre", 1, 1e15);
    }
    const Length wavelength = counts.length("wavelength", nm(100), um(20));
    const double per_wavelength = counts.number("per_wavelength", 0.01, 1e6);
    const double index = counts.number("index", 1, 1.01); // air: 1.00027; 1 counts in vacuum
    return wavelength.si() / (per_wavelength * index);
}

} // namespace

StandstillMap standstill_map(Settings table, AxisKind kind) {
    StandstillMap map;
    map.plan.axis_kind = kind;
    read_places(table, map.plan);
    read_cycle_of_stops(table, map.plan);
    read_neighbourhood(table, map.plan);
    map.capture = stillness_in(table, kind);
    return map;
}

UmdMap umd_map(Settings root, AxisKind kind) {
    UmdMap map;
    if (kind == AxisKind::rotary)
        root.refuse("axis_kind", "is rotary, but the uMD's log counts lengths");
    Settings counts = root.table("counts");
    const bool rising = counts.choice("sign", {"+", "-"}, "+") == "+";
    map.metres_per_count = metres_per_count_in(counts) * (rising ? 1 : -1);
    if (counts.has("rate_Hz")) map.rate_Hz = counts.number("rate_Hz", 0.1, 1e6);
    map.sequence_bits = static_cast<int>(counts.integer("sequence_bits", 8, 63, 0));
    map.segment = static_cast<int>(counts.integer("segment", 1, 1'000'000, 0));
    Settings standstill = root.table("standstill");
    map.stops = standstill_map(standstill, kind);
    map.stops.plan.datum = standstill.length("datum", -farthest_target, farthest_target);
    // The rapid traverse of most machine tools: a counter that lost counts leaps faster.
    if (map.stops.capture.fastest <= Speed{}) map.stops.capture.fastest = mm_per_minute(60'000);
    return map;
}

} // namespace axiscal
