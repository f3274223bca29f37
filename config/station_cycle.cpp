#include "config/station_readers.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

using namespace std::chrono_literals;

constexpr Speed slowest = mm_per_minute(0.1), light_axis = metre_per_second(20);

/// Eleven targets and their random part (0.3 p to either side) fill the travel; at least five lie
/// on a metre, and on an axis above 2 m no more than 250 mm apart (ISO 230-2:2014, 4.3).
Length usual_interval(const CycleConfig& config) {
    constexpr double intervals = 10.6, largest_mm = 250;
    const double reach_mm = (config.travel_high - config.travel_low - 2 * config.overrun).in(mm);
    const double whole_mm = std::floor(std::min(reach_mm / intervals, largest_mm));
    return whole_mm >= 1 ? mm(whole_mm) : mm(std::max(reach_mm / intervals, 0.01));
}

void read_targets(Settings cycle, AxisUnits units, CycleConfig& config) {
    const bool list = cycle.has("targets"), grid = cycle.has("interval");
    if (list) config.targets = units.coordinates(cycle, "targets", -farthest, farthest);
    config.interval = units.optional_coordinate(cycle, "interval", mm(0.01), metre(10));
    config.first_target = units.optional_coordinate(cycle, "first_target", -farthest, farthest);
    if (cycle.has("target_count"))
        config.target_count = static_cast<int>(cycle.integer("target_count", 2, 1000));
    if (cycle.has("seed"))
        config.seed = static_cast<std::uint64_t>(cycle.integer("seed", 0, INT64_MAX));
    if (list && grid)
        cycle.refuse("interval",
                     "is given together with targets: keep the list or the interval, not both");
    if (!list && !grid && config.axis_kind == AxisKind::rotary)
        cycle.refuse(
            "interval",
            "is missing: give interval = \"30 deg\" (targets are then placed with a random "
            "part), or a list: targets = [\"0 deg\", \"30 deg\", ...]");
    for (const char* key : {"first_target", "target_count", "seed"})
        if (list && !grid && cycle.has(key))
            cycle.refuse(key, "belongs to interval, not to a list of targets: remove it");
}

} // namespace

void read_cycle(Settings cycle, AxisUnits units, CycleConfig& config) {
    const std::string kind = cycle.choice("kind", {"standard", "step"}, "standard");
    config.cycle = kind == "step" ? CycleKind::step : CycleKind::standard;
    read_targets(cycle, units, config);
    config.approaches = static_cast<int>(cycle.integer("approaches", 1, 50, config.approaches));
    config.bidirectional = cycle.flag("bidirectional", config.bidirectional);
    config.overrun = units.coordinate(cycle, "overrun", mm(0.01), metre(1));
    if (cycle.refused("overrun")) config.overrun = Length{}; // not known: nothing is judged by it
    if (!config.targets && !config.interval && config.axis_kind == AxisKind::linear)
        config.interval = usual_interval(config);
    config.near_tolerance = units.optional_coordinate(cycle, "near_tolerance", um(1), mm(10));
    config.datum = units.optional_coordinate(cycle, "datum", -farthest, farthest);
    config.feed = units.speed(cycle, "feed", slowest, light_axis);
    config.dwell = cycle.duration("dwell", 100ms, 10min, config.dwell);
    if (cycle.has("stretch_declined")) {
        config.stretch_declined = cycle.text("stretch_declined");
        if (config.stretch_declined->empty() && !cycle.refused("stretch_declined"))
            cycle.refuse("stretch_declined", "needs the reason: it is printed");
    }
    config.stretch_begin = units.optional_coordinate(cycle, "stretch_begin", -farthest, farthest);
    if (config.stretch_begin && config.stretch_declined)
        cycle.refuse("stretch_begin", "contradicts stretch_declined: keep one of them");
}

void read_capture(Settings capture,
                  AxisUnits units,
                  const CycleConfig& cycle,
                  CaptureConfig& config) {
    config.window = capture.duration("window", 10ms, 60s, config.window);
    const bool linear = cycle.axis_kind == AxisKind::linear;
    config.spread_limit = units.coordinate(capture, "spread_limit", nm(1), mm(1),
                                           linear ? std::optional{um(2)} : std::nullopt);
    const Speed slope =
        units.speed(capture, "slope_limit", metre_per_second(1e-9), metre_per_second(1e-3),
                    metre_per_second(config.slope_limit_um_per_s * 1e-6));
    config.slope_limit_um_per_s = slope.si() / 1e-6;
    config.timeout = capture.duration("timeout", 100ms, 10min, config.timeout);
    config.history = capture.duration("history", 10s, 1h, config.history);
    config.minimum_samples =
        static_cast<int>(capture.integer("minimum_samples", 2, 100'000, config.minimum_samples));
    // Faster than the rapid traverse of most machine tools, and than the feed of this one.
    const Speed usual = std::min(std::max(mm_per_minute(60'000), 2 * cycle.feed), light_axis);
    config.fastest = units.speed(capture, "fastest", slowest, light_axis,
                                 linear ? std::optional{usual} : std::nullopt);
    if (!capture.refused("timeout") && config.timeout < config.window)
        capture.refuse("timeout", "is shorter than window: no window could ever be complete");
    if (!capture.refused("history") && config.history < 2 * config.window)
        capture.refuse("history", "is shorter than two windows: make it some minutes");
    if (!capture.refused("window") && cycle.dwell < config.window)
        capture.refuse("window", "is longer than cycle.dwell: the axis would not stand that long");
    if (!capture.refused("fastest") && config.fastest < cycle.feed)
        capture.refuse(
            "fastest",
            "is below cycle.feed: state the rapid traverse of the axis, with some spare");
}

} // namespace axiscal
