// The circular test of ISO 230-4: [ballbar] states the bar, [circular] what is driven.
#include "config/station_readers.hpp"

namespace axiscal {
namespace {

/// A key that may be left out; `value` is read in any case, so that the key counts as known.
template <class Value>
std::optional<Value> if_stated(Settings& table, std::string_view key, Value value) {
    return table.has(key) ? std::optional{value} : std::nullopt;
}

std::optional<double> width_um(Settings& table, std::string_view key) {
    return if_stated(table, key, table.length(key, mm(0), mm(1), mm(0)).in(um));
}
std::optional<double> width_K(Settings& table, std::string_view key) {
    return if_stated(
        table, key, table.temperature_difference(key, kelvin(0), kelvin(50), kelvin(0)).in(kelvin));
}
std::optional<double> per_K(Settings& table, std::string_view key) {
    return if_stated(
        table, key,
        table.expansion(key, um_per_m_kelvin(0), um_per_m_kelvin(100), um_per_m_kelvin(0)).si());
}

void read_bar(Settings bar, CircularConfig& config, const StationConfig& station) {
    CircularSetup& setup = config.setup;
    setup.bar_sign = bar.integer("sign", -1, 1, 1) < 0 ? -1 : 1;
    setup.bar_length_mm = bar.length("length", mm(0), metre(10), mm(0)).in(mm);
    setup.bar_alpha_per_K = per_K(bar, "expansion");
    setup.uncertainty.calibration_U_um = width_um(bar, "length_U");
    const double k = bar.number("length_k", 1, 5, 2);
    if (setup.uncertainty.calibration_U_um) setup.uncertainty.calibration_k = k;
    if (!bar.text("temperature", "").empty())
        config.bar_temperature = read_role(bar, "temperature", station);
}

void read_senses(Settings& circular, CircularPlan& plan) {
    const auto words =
        circular.texts("senses", std::optional{std::vector<std::string>{"ccw", "cw"}});
    plan.senses.clear();
    for (const std::string& word : words)
        plan.senses.push_back(word == "cw" ? Sense::cw : Sense::ccw);
    for (const std::string& word : words)
        if (word != "ccw" && word != "cw")
            return circular.refuse("senses", "knows \"ccw\" and \"cw\", each at most once");
    if (plan.senses.empty() || plan.senses.size() > 2 ||
        (plan.senses.size() == 2 && plan.senses[0] == plan.senses[1]))
        circular.refuse("senses", "knows \"ccw\" and \"cw\", each at most once");
}

double degrees_of(Settings& table, std::string_view key, double low, double high, double usual) {
    return table.angle(key, degree(low), degree(high), degree(usual)).in(degree);
}

void read_arc(Settings& circular, CircularPlan& plan) {
    plan.start_deg = degrees_of(circular, "start", -360, 360, plan.start_deg);
    plan.arc_deg = degrees_of(circular, "arc", 90, 360, plan.arc_deg);
    plan.overshoot_deg = degrees_of(circular, "overshoot", 0, 360, plan.overshoot_deg);
    plan.feed_in_mm = circular.length("feed_in", mm(0.05), mm(50), mm(plan.feed_in_mm)).in(mm);
    plan.feed_in_outside =
        circular.choice("feed_in_side", {"outside", "inside"}, "outside") == "outside";
    const Length least = mm(-100'000), most = mm(100'000);
    const auto centre = circular.lengths("centre", least, most,
                                         std::optional{std::vector<Length>{mm(0), mm(0), mm(0)}});
    if (centre.size() != 3) return circular.refuse("centre", "needs three coordinates: X, Y and Z");
    for (std::size_t i = 0; i < 3; ++i)
        plan.centre_mm[i] = centre[i].in(mm);
}

/// The words at the ends of an arc are numbers that change while the machine moves: a bit and a
/// number could part on their way, and a dwell says nothing.
void read_start(Settings& circular, Settings trigger, CircularPlan& plan) {
    const bool by_words =
        circular.choice("start_from", {"feed-in", "trigger"}, "feed-in") == "trigger";
    const Duration delay = circular.duration("trigger_delay", std::chrono::seconds{0},
                                             std::chrono::seconds{1}, std::chrono::seconds{0});
    plan.trigger_delay_s = seconds_of(delay);
    if (!by_words) return;
    plan.start = StartMethod::trigger;
    const std::string shape = trigger.text("shape", "");
    if (shape == "coil-and-index" || shape == "dwell")
        circular.refuse("start_from", "needs a trigger whose number alone is the word: shape "
                                      "\"single-register\" or \"sequence-block\", not \"" +
                                          shape + "\"");
}

void read_plan(Settings& circular, CircularPlan& plan) {
    const std::string plane = circular.choice("plane", {"XY", "YZ", "ZX"}, "XY");
    plan.plane = plane == "XY"   ? CircularPlane::xy
                 : plane == "YZ" ? CircularPlane::yz
                                 : CircularPlane::zx;
    plan.nominal_radius_mm = circular.length("radius", mm(1), metre(10), mm(100)).in(mm);
    plan.feed_mm_per_s =
        circular.speed("feed", mm_per_minute(1), metre_per_second(2), mm_per_minute(1000)).si() *
        1e3;
    read_senses(circular, plan);
    plan.repeats = static_cast<int>(circular.integer("repeats", 1, 50, plan.repeats));
    plan.warm_up = static_cast<int>(circular.integer("warm_up", 0, 50, plan.warm_up));
    read_arc(circular, plan);
    plan.tool_offset = circular.text("tool_offset", "");
    plan.work_offset = circular.text("work_offset", "");
}

void read_budget(Settings table, CircularConfig& config) {
    CircularUncertaintyStatement& statement = config.setup.uncertainty;
    statement.device_width_um = width_um(table, "device_width");
    statement.repeatability_um = width_um(table, "repeatability");
    statement.eve_um = width_um(table, "eve");
    refuse_beside(table, "eve", "eve_run");
    config.eve_run = table.text("eve_run", "");
    statement.centre_width_um = width_um(table, "centre_width");
    statement.machine_temperature_width_K = width_K(table, "machine_temperature_width");
    statement.bar_temperature_width_K = width_K(table, "bar_temperature_width");
    statement.machine_alpha_width_per_K = per_K(table, "machine_expansion_width");
    statement.bar_alpha_width_per_K = per_K(table, "bar_expansion_width");
}

/// What [axis.material] and [axis.air] say where there is an [axis].
void refuse_machine_beside_axis(const Settings& root, Settings& circular) {
    const bool with_axis = root.has("axis");
    for (const char* key : {"machine_expansion", "machine_temperature", "air_temperature"})
        if (circular.has(key) && with_axis)
            circular.refuse(key, "belongs to a station without [axis]: here [axis.material] and "
                                 "[axis.air] say it");
}

} // namespace

void read_circular(Settings root, StationConfig& station) {
    CircularConfig config;
    read_bar(root.table("ballbar"), config, station);
    Settings circular = root.table("circular");
    CircularSetup& setup = config.setup;
    read_plan(circular, setup.plan);
    refuse_machine_beside_axis(root, circular);
    read_start(circular, root.table("trigger"), setup.plan);
    const double low_pass_hz = circular.number("low_pass_hz", 0, 1e6, 0);
    if (low_pass_hz > 0) setup.capture.low_pass_hz = low_pass_hz;
    setup.capture.averaged = static_cast<int>(circular.integer("averaged", 1, 100'000, 1));
    read_budget(circular.table("uncertainty"), config);
    setup.uncertainty.runs = setup.plan.repeats;
    const double alpha_per_K = station.axis.material.coefficient.si();
    const bool stated = root.has("axis") || circular.has("machine_expansion");
    if (stated) setup.machine_alpha_per_K = alpha_per_K;
    if (station.ballbar) setup.bar_instrument = station.ballbar->instrument;
    if (!circular.has("radius")) return;
    if (!circular.has("feed") && !circular.refused("feed"))
        circular.refuse("feed", "is missing: the station calculates the angle on the circle from "
                                "it; write the programmed feed, as in feed = \"1000 mm/min\"");
    if (!station.ballbar)
        circular.refuse("radius", "needs a ballbar: name its channel in [ballbar] sensor");
    station.circular = std::move(config);
}

} // namespace axiscal
