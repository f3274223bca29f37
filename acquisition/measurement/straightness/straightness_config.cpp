// [straightness] of the station file.
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/measurement/straightness/straightness_plan.hpp"

#include <cmath>
#include <string_view>
#include <utility>

namespace axiscal {
namespace {

constexpr int usual_targets_across = 11;

/// Why this station measures no straightness, whatever the table says; or nothing.
std::string what_station_lacks(const StationConfig& station) {
    if (station.circles_alone())
        return "needs the table [axis] and its laser: this station has a ballbar alone";
    if (station.cycle.axis_kind == AxisKind::rotary)
        return "is measured of a linear axis, and axis.kind is \"rotary\": remove the table";
    if (station.axis.scale)
        return "needs a laser before the prism, and [axis.scale] says that a linear scale measures "
               "this axis: remove one of the two";
    if (station.trigger.shape == TriggerShape::dwell)
        return "needs a control that sends requests: trigger.shape \"dwell\" sees no axis halt "
               "across its motion; choose another shape";
    return {};
}

bool is_measured_live(Settings& section, const StationConfig& station) {
    if (std::string lacks = what_station_lacks(station); !lacks.empty()) {
        section.refuse("", std::move(lacks));
        return false;
    }
    if (section.choice("method", {"wollaston", "angle-steps"}, "wollaston") == "wollaston")
        return true;
    if (!section.refused("method"))
        section.refuse("method", "\"angle-steps\" is not measured live yet; say \"wollaston\"");
    return false;
}

/// One laser measures the axis, along it and across: the key only says so once more.
void check_channel(Settings& section, const StationConfig& station) {
    if (!section.has("channel")) return;
    const RoleConfig stated = read_role(section, "channel", station);
    if (section.refused("channel")) return;
    const RoleConfig& laser = station.axis.laser;
    if (laser.by_kind)
        section.refuse("channel", "says which laser measures the axis, and axis.laser does not: "
                                  "name it there and leave it out here");
    else if (!laser.instrument.empty() &&
             (stated.instrument != laser.instrument || stated.channel != laser.channel))
        section.refuse("channel", "is another channel than axis.laser, \"" + laser.instrument +
                                      "/" + laser.channel +
                                      "\", by which the axis is measured: leave channel out, or "
                                      "name the other one there");
}

void read_direction(Settings& section, const StationConfig& station, StraightnessSetup& setup) {
    setup.across = section.choice("across", {"X", "Y", "Z", "U", "V", "W"});
    if (!section.refused("across") && setup.across == station.axis.program_axis)
        section.refuse("across", "is the axis itself: name the direction across its motion in "
                                 "which it is straight or not");
    setup.sign = static_cast<int>(section.integer("sign", -1, 1));
    if (setup.sign == 0 && !section.refused("sign"))
        section.refuse("sign", "is 1 when the laser's reading rises as the moving optics go in the "
                               "positive direction of `across`, and -1 when it falls: jog by "
                               "0.1 mm to see it");
}

void read_factor(Settings& section, StraightnessSetup& setup) {
    refuse_beside(section, "factor", "prism_angle");
    if (section.has("factor")) {
        setup.factor = section.number("factor", 1, 2000);
    } else if (section.has("prism_angle")) {
        const Angle parting = section.angle("prism_angle", degree(0.05), degree(50));
        setup.factor = factor_of_prism(parting);
    } else {
        section.refuse("factor", "is missing: state it from the certificate of the optics, for "
                                 "example factor = 36.012, or prism_angle = \"1.5916 deg\"");
    }
}

void read_mirror(Settings& section, StraightnessConfig& config) {
    if (section.choice("mirror", {"normal", "reversed"}, "normal") == "reversed")
        config.setup.mirror = MirrorPosition::reversed;
    config.reversal_of = section.text("reversal_of", "");
}

void read_statement(Settings& section, StraightnessConfig& config) {
    constexpr double least_k = 1, largest_k = 5, most_um_per_m2 = 100;
    const Ratio none, most = percent(50);
    StraightnessStatement& stated = config.setup.uncertainty;
    refuse_beside(section, "factor_uncertainty", "factor_limit");
    const Ratio expanded = section.ratio("factor_uncertainty", none, most, none);
    if (section.has("factor_uncertainty")) stated.factor_U = expanded;
    const Ratio limit = section.ratio("factor_limit", none, most, none);
    if (section.has("factor_limit")) stated.factor_limit = limit;
    stated.factor_k = section.number("factor_k", least_k, largest_k, stated.factor_k);
    if (section.has("factor_k") && !section.has("factor_uncertainty"))
        section.refuse("factor_k", "belongs to factor_uncertainty: state that one too");
    const double mirror = section.number("mirror_limit", 0, most_um_per_m2, 0);
    if (section.has("mirror_limit")) stated.mirror_limit_um_per_m2 = mirror;
    refuse_beside(section, "eve", "eve_run");
    const Length drift = section.length("eve", mm(0), mm(1), mm(0));
    if (section.has("eve")) stated.eve = drift;
    config.eve_run = section.text("eve_run", "");
}

void read_optics(Settings& section, StraightnessConfig& config) {
    config.range = section.length("range", um(1), mm(100), config.range);
    if (section.has("resolution"))
        config.setup.resolution = section.length("resolution", nm(0.001), um(100));
    config.setup.place = section.text("place", "");
    Settings optics = section.table("optics");
    config.optics.name = "straightness optics";
    config.optics.maker = optics.text("maker", "");
    config.optics.model = optics.text("model", "");
    config.optics.serial = optics.text("serial", "");
    read_certificate_dates(optics, config.optics);
}

void read_motion(Settings& section, const CaptureConfig& capture, CycleConfig& cycle) {
    using namespace std::chrono_literals;
    cycle.travel_low = section.length("travel_low", -farthest, farthest, cycle.travel_low);
    cycle.travel_high = section.length("travel_high", -farthest, farthest, cycle.travel_high);
    cycle.overrun = section.length("overrun", mm(0.01), metre(1), cycle.overrun);
    cycle.approaches = static_cast<int>(section.integer("approaches", 1, 50, cycle.approaches));
    if (section.has("datum")) cycle.datum = section.length("datum", -farthest, farthest);
    cycle.feed = section.speed("feed", mm_per_minute(0.1), metre_per_second(20), cycle.feed);
    cycle.dwell = section.duration("dwell", 100ms, 10min, cycle.dwell);
    if (section.has("feed") && !section.refused("feed") && cycle.feed > capture.fastest)
        section.refuse("feed", "is above capture.fastest, and the axis cannot move faster than "
                               "that: lower it, or state the rapid traverse there");
    if (section.has("dwell") && !section.refused("dwell") && cycle.dwell < capture.window)
        section.refuse("dwell", "is shorter than capture.window: the axis would not stand that "
                                "long");
}

/// [cycle] has an interval in any case, and draws a random part about it: only its list counts.
void read_targets_across(Settings& section, CycleConfig& cycle) {
    refuse_beside(section, "targets", "interval");
    if (section.has("targets"))
        cycle.targets = section.lengths("targets", -farthest, farthest);
    else if (section.has("interval"))
        cycle.targets = targets_each(cycle, section.length("interval", mm(0.1), metre(10)));
    else if (!cycle.targets)
        cycle.targets = even_targets(cycle, usual_targets_across);
}

/// Not by what was refused already, here or in [axis] and [cycle].
bool travel_is_known(Settings& section, const CycleConfig& cycle) {
    for (const char* key : {"travel_low", "travel_high", "overrun", "targets", "interval", "datum"})
        if (section.refused(key)) return false;
    const bool no_list = cycle.targets && cycle.targets->empty() && !section.has("targets");
    if (no_list || cycle.overrun <= Length{}) return false;
    if (cycle.travel_low < cycle.travel_high) return true;
    if (section.has("travel_low") || section.has("travel_high"))
        section.refuse("travel_high", "must lie above travel_low: exchange or correct the limits");
    return false;
}

void read_plan_across(Settings& section, const StationConfig& station, StraightnessConfig& config) {
    CycleConfig cycle = station.cycle;
    read_motion(section, station.capture, cycle);
    read_targets_across(section, cycle);
    config.feed = cycle.feed;
    config.dwell = cycle.dwell;
    if (!travel_is_known(section, cycle)) return;
    if (auto plan = plan_across(cycle))
        config.plan = *std::move(plan);
    else
        section.refuse(plan.error().field, plan.error().detail);
}

} // namespace

double factor_of_prism(Angle parting) {
    return 1 / (2 * std::sin(parting.in(radian) / 2));
}

RunPlan plan_of_kind(const StraightnessConfig& config, TestKind kind) {
    RunPlan plan = config.plan;
    plan.pass = name_of(kind);
    return plan;
}

std::any read_straightness_section(Settings section, const StationConfig& station) {
    if (!is_measured_live(section, station)) {
        section.accept_rest();
        return {};
    }
    StraightnessConfig config;
    check_channel(section, station);
    read_direction(section, station, config.setup);
    read_factor(section, config.setup);
    read_mirror(section, config);
    read_statement(section, config);
    read_optics(section, config);
    read_plan_across(section, station, config);
    return config;
}

} // namespace axiscal
