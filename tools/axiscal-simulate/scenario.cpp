#include "scenario.hpp"

#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>

namespace axiscal::simulate {

using Json = nlohmann::json;

double SlowSignal::at(double seconds) const {
    return start + rate_per_hour * seconds / 3600.0 +
           swing * std::sin(2.0 * std::numbers::pi * seconds / period_s);
}

namespace {

/// One table of the file: reads keys into variables, refuses what is left over.
class Fields {
public:
    Fields(const Json& object, std::string place, std::string& refusals)
        : object_{object}
        , place_{std::move(place)}
        , refusals_{refusals} {
        if (!object_.is_object()) refuse("", "is not a table");
    }
    /// Once everything known was read.
    void refuse_what_is_left() {
        if (!object_.is_object()) return;
        for (const auto& [key, value] : object_.items())
            if (!seen_.contains(key)) refuse(key, "is not a known key");
    }

    template <class T> void read(const char* key, T& value) {
        const Json* found = find(key);
        if (found == nullptr) return;
        try {
            value = found->get<T>();
        } catch (const Json::exception&) {
            refuse(key, "has the wrong type");
        }
    }
    template <class T> void read(const char* key, std::optional<T>& value) {
        if (!has(key)) return;
        T given{};
        read(key, given);
        value = given;
    }
    void letter(const char* key, char& value) {
        std::string text(1, value);
        read(key, text);
        if (text.size() != 1) return refuse(key, "is one letter");
        value = text[0];
    }
    void one_of(const char* key, std::string& value, const std::set<std::string>& allowed) {
        read(key, value);
        if (allowed.contains(value)) return;
        std::string list;
        for (const auto& word : allowed)
            list += " " + (word.empty() ? "\"\"" : word);
        refuse(key, "is one of:" + list);
    }
    void positive(const char* key, double& value) {
        read(key, value);
        if (!(value > 0)) refuse(key, "must be above 0");
    }
    void table(const char* key, const std::function<void(Fields&)>& reader) {
        const Json* found = find(key);
        if (found == nullptr) return;
        Fields inner{*found, place_ + key + ".", refusals_};
        if (found->is_object()) reader(inner);
        inner.refuse_what_is_left();
    }
    void tables(const char* key, const std::function<void(Fields&)>& reader) {
        const Json* found = find(key);
        if (found == nullptr) return;
        if (!found->is_array()) return refuse(key, "is not a list of tables");
        for (std::size_t i = 0; i < found->size(); ++i) {
            Fields inner{(*found)[i], place_ + key + "[" + std::to_string(i) + "].", refusals_};
            if ((*found)[i].is_object()) reader(inner);
            inner.refuse_what_is_left();
        }
    }
    [[nodiscard]] bool has(const char* key) const {
        return object_.is_object() && object_.contains(key);
    }
    void refuse(const std::string& key, const std::string& why) {
        refusals_ += (refusals_.empty() ? "" : "; ") + place_ + key + " " + why;
    }

private:
    const Json* find(const char* key) {
        seen_.insert(key);
        return has(key) ? &object_.at(key) : nullptr;
    }
    const Json& object_;
    std::string place_;
    std::string& refusals_;
    std::set<std::string> seen_;
};

void read_signal(Fields& in, const char* key, SlowSignal& signal) {
    in.table(key, [&](Fields& f) {
        f.read("start", signal.start);
        f.read("rate_per_hour", signal.rate_per_hour);
        f.read("swing", signal.swing);
        f.positive("period_s", signal.period_s);
    });
}

void read_axis(Fields& f, AxisScenario& axis) {
    f.read("name", axis.name);
    f.letter("letter", axis.letter);
    f.read("start_mm", axis.start_mm);
    f.read("travel_low_mm", axis.travel_low_mm);
    f.read("travel_high_mm", axis.travel_high_mm);
    f.positive("rapid_mm_per_min", axis.rapid_mm_per_min);
    f.positive("acceleration_mm_per_s2", axis.acceleration_mm_per_s2);
}

void read_table(Fields& f, ErrorScenario& errors) {
    std::vector<std::vector<double>> rows;
    f.read("table", rows);
    for (const auto& row : rows) {
        const bool ascending =
            errors.table.empty() || row.empty() || row.front() > errors.table.back().position_mm;
        if (row.size() != 2 || !ascending)
            return f.refuse("table", "needs ascending pairs [position mm, error um]");
        errors.table.push_back({row[0], row[1]});
    }
}

void read_errors(Fields& f, ErrorScenario& errors) {
    f.read("linear_um_per_m", errors.linear_um_per_m);
    f.read("quadratic_um_per_m2", errors.quadratic_um_per_m2);
    f.read("cubic_um_per_m3", errors.cubic_um_per_m3);
    f.read("centre_mm", errors.centre_mm);
    read_table(f, errors);
    f.tables("periodic", [&](Fields& p) {
        PeriodicError term;
        p.read("amplitude_um", term.amplitude_um);
        p.positive("period_mm", term.period_mm);
        p.read("phase_deg", term.phase_deg);
        errors.periodic.push_back(term);
    });
    f.read("reversal_um", errors.reversal_um);
    f.read("reversal_slope_um_per_m", errors.reversal_slope_um_per_m);
    f.read("approach_noise_um", errors.approach_noise_um);
    f.read("noise_um", errors.noise_um);
    f.read("vibration_um", errors.vibration_um);
    f.positive("vibration_hz", errors.vibration_hz);
    f.read("drift_um_per_hour", errors.drift_um_per_hour);
}

void read_laser(Fields& f, LaserScenario& laser) {
    f.one_of("kind", laser.kind,
             {"umd0", "umd1", "umd2-homodyne", "umd2-heterodyne", "ids3010", "hpi-3d"});
    const bool homodyne = laser.kind == "umd0" || laser.kind == "umd2-homodyne";
    laser.counts_per_cycle = homodyne ? 4 : 1;
    laser.phase_bits = laser.kind == "umd1" ? 8 : 16;
    f.read("path", laser.path);
    f.positive("wavelength_nm", laser.wavelength_nm);
    f.read("fold", laser.fold);
    f.read("counts_per_cycle", laser.counts_per_cycle);
    f.read("phase_bits", laser.phase_bits);
    f.read("fields", laser.fields);
    f.read("sign", laser.sign);
    f.read("dead_path_mm", laser.dead_path_mm);
    f.read("zero_mm", laser.zero_mm);
    f.read("rate_hz", laser.rate_hz);
    f.read("partial_first_line", laser.partial_first_line);
    f.read("port", laser.port);
    f.read("device_corrects", laser.device_corrects);
    f.read("beam_tilt_mrad", laser.beam_tilt_mrad);
    f.read("contrast_percent", laser.contrast_percent);
    f.read("beam_radius_mm", laser.beam_radius_mm);
    if (laser.beam_radius_mm && !(*laser.beam_radius_mm > 0))
        f.refuse("beam_radius_mm", "must be above 0");
    if (laser.beam_radius_mm && laser.kind != "ids3010" && laser.kind != "hpi-3d")
        f.refuse("beam_radius_mm", "needs ids3010 or hpi-3d: the other kinds tell no strength");
    f.read("resolution_um", laser.resolution_um);
    f.read("scale_expansion_um_per_m_k", laser.scale_expansion_um_per_m_k);
    if (laser.resolution_um && !(*laser.resolution_um > 0))
        f.refuse("resolution_um", "must be above 0");
    if (laser.resolution_um && !homodyne)
        f.refuse("resolution_um", "needs a homodyne kind: heterodyne firmware counts no A-quad-B");
    if (laser.sign != 1 && laser.sign != -1) f.refuse("sign", "is 1 or -1");
    if (laser.fields != 8 && laser.fields != 16) f.refuse("fields", "is 8 or 16");
    if (laser.phase_bits != 8 && laser.phase_bits != 16) f.refuse("phase_bits", "is 8 or 16");
    if (laser.rate_hz && !(*laser.rate_hz > 0)) f.refuse("rate_hz", "must be above 0");
}

void read_sensor(Fields& f, SensorScenario& sensor) {
    f.read("name", sensor.name);
    f.one_of("kind", sensor.kind,
             {"dracal-vcp", "tm-th8", "xy-md02", "comet", "nd-28x", "mitutoyo", "sylvac", "vaisala",
              "vaisala-hmp", "labjack-t7", "m-7015", "ds18b20", "temper-serial", "elcomat"});
    f.read("path", sensor.path);
    f.read("port", sensor.port);
    f.read("unit", sensor.unit);
    f.read("fraction_digits", sensor.fraction_digits);
    f.read("first_register", sensor.first_register);
    if (sensor.name.empty()) f.refuse("name", "is missing");
    const std::set<std::string> on_tcp{"tm-th8",      "xy-md02",    "comet",
                                       "vaisala-hmp", "labjack-t7", "m-7015"};
    if (!on_tcp.contains(sensor.kind) && sensor.path.empty()) f.refuse("path", "is missing");
}

void read_indexing_table(Fields& f, TableScenario& table) {
    f.positive("step_deg", table.step_deg);
    f.positive("turn_deg_per_s", table.turn_deg_per_s);
    f.positive("arm_mm", table.arm_mm);
    f.positive("range_deg", table.range_deg);
    f.read("deviation_arcsec", table.deviation_arcsec);
}

void read_polygon(Fields& f, PolygonScenario& polygon) {
    f.read("faces", polygon.faces);
    f.positive("range_arcsec", polygon.range_arcsec);
    f.read("y_arcsec", polygon.y_arcsec);
    f.positive("poll_s", polygon.poll_s);
    f.read("deviation_arcsec", polygon.deviation_arcsec);
    if (polygon.faces < 3) f.refuse("faces", "is at least 3");
}

void read_straightness(Fields& f, StraightnessScenario& straightness) {
    f.positive("factor", straightness.factor);
    f.read("mirror_reversed", straightness.mirror_reversed);
    f.table("across", [&](Fields& t) { read_errors(t, straightness.across); });
    f.table("mirror", [&](Fields& t) { read_errors(t, straightness.mirror); });
}

void read_squareness(Fields& f, SquarenessScenario& squareness) {
    f.read("axes_um_per_m", squareness.axes_um_per_m);
    f.read("square_um_per_m", squareness.square_um_per_m);
    f.read("square_turned", squareness.square_turned);
    f.read("first_um_per_m", squareness.first_um_per_m);
}

/// The optics stand before the counter of a uMD, in place of those that show the axis.
void refuse_other_optics(Fields& f, const Scenario& s) {
    if (s.squareness && !s.straightness)
        f.refuse("squareness", "needs [straightness] beside it: prism and mirror of both axes");
    if (!s.straightness) return;
    if (s.rotary()) f.refuse("straightness", "needs an axis that does not turn");
    if (s.laser.kind == "ids3010" || s.laser.kind == "hpi-3d" || s.laser.resolution_um)
        f.refuse("straightness", "needs the laser of a uMD: umd0, umd1 or umd2");
}

/// An autocollimator looks at the slide that the laser's face moves.
void refuse_blind_autocollimator(Fields& f, const Scenario& s) {
    for (const SensorScenario& sensor : s.sensors) {
        if (sensor.kind != "elcomat") continue;
        if (!s.polygon) f.refuse("polygon", "is missing: \"elcomat\" has nothing to look at");
        if (s.laser.path.empty() || s.laser.kind == "ids3010" || s.laser.kind == "hpi-3d")
            f.refuse("laser.path", "is missing: \"elcomat\" looks at the axis of a uMD's face");
    }
}

void read_ballbar(Fields& f, BallbarScenario& bar) {
    f.read("path", bar.path);
    f.one_of("plane", bar.plane, {"XY", "YZ", "ZX"});
    f.read("centre_first_mm", bar.centre_first_mm);
    f.read("centre_second_mm", bar.centre_second_mm);
    f.positive("radius_mm", bar.radius_mm);
    f.read("start_first_mm", bar.start_first_mm);
    f.read("start_second_mm", bar.start_second_mm);
    f.read("scale_first_um_per_m", bar.scale_first_um_per_m);
    f.read("scale_second_um_per_m", bar.scale_second_um_per_m);
    f.read("squareness_um_per_m", bar.squareness_um_per_m);
    f.read("backlash_first_um", bar.backlash_first_um);
    f.read("backlash_second_um", bar.backlash_second_um);
    f.read("cyclic_first_um", bar.cyclic_first_um);
    f.positive("cyclic_period_mm", bar.cyclic_period_mm);
    f.read("noise_um", bar.noise_um);
    f.read("rate_hz", bar.rate_hz);
    if (bar.rate_hz && !(*bar.rate_hz > 0)) f.refuse("rate_hz", "must be above 0");
    f.read("resolution_um", bar.resolution_um);
    if (bar.resolution_um && !(*bar.resolution_um > 0))
        f.refuse("resolution_um", "must be above 0");
    f.read("stroke_um", bar.stroke_um);
    if (bar.stroke_um && !(*bar.stroke_um > 0)) f.refuse("stroke_um", "must be above 0");
    if (bar.path.empty()) f.refuse("path", "is missing");
}

void read_cnc(Fields& f, CncScenario& cnc) {
    f.one_of("shape", cnc.shape, {"sequence-block", "single-register", "coil-and-index", "dwell"});
    f.one_of("transport", cnc.transport, {"tcp", "rtu", "server"});
    f.read("host", cnc.host);
    f.read("path", cnc.path);
    f.read("port", cnc.port);
    f.read("baud", cnc.baud);
    f.read("unit", cnc.unit);
    f.read("base_address", cnc.base_address);
    f.letter("parity", cnc.parity);
    f.positive("poll_s", cnc.poll_s);
    f.positive("counts_per_unit", cnc.counts_per_unit);
    f.read("low_word_first", cnc.low_word_first);
    f.one_of("motion_fault", cnc.motion_fault,
             {"", "diameter", "inch", "wrong-axis", "swapped-sign", "shifted-datum"});
    f.read("shift_mm", cnc.shift_mm);
    f.tables("fault", [&](Fields& g) {
        CncFault fault;
        g.one_of("kind", fault.kind,
                 {"doubled", "late", "missed", "out-of-order", "wrong-direction", "wrong-target"});
        g.read("request", fault.request);
        g.positive("late_s", fault.late_s);
        cnc.faults.push_back(fault);
    });
}

void read_all(Fields& f, Scenario& s) {
    f.read("seed", s.seed);
    f.table("axis", [&](Fields& t) { read_axis(t, s.axis); });
    f.table("errors", [&](Fields& t) { read_errors(t, s.errors); });
    f.table("thermal", [&](Fields& t) {
        t.read("expansion_um_per_m_k", s.thermal.expansion_um_per_m_k);
        t.read("fixed_point_mm", s.thermal.fixed_point_mm);
        read_signal(t, "material", s.thermal.material);
        t.read("sensor_difference_k", s.thermal.sensor_difference_k);
        t.read("scale_warmer_k", s.thermal.scale_warmer_k);
    });
    f.table("air", [&](Fields& t) {
        read_signal(t, "temperature", s.air.temperature);
        read_signal(t, "pressure_pa", s.air.pressure_pa);
        read_signal(t, "humidity_percent", s.air.humidity_percent);
        t.read("co2_ppm", s.air.co2_ppm);
    });
    f.table("laser", [&](Fields& t) { read_laser(t, s.laser); });
    f.tables("sensor", [&](Fields& t) { read_sensor(t, s.sensors.emplace_back()); });
    f.table("indexing_table",
            [&](Fields& t) { read_indexing_table(t, s.indexing_table.emplace()); });
    f.table("polygon", [&](Fields& t) { read_polygon(t, s.polygon.emplace()); });
    refuse_blind_autocollimator(f, s);
    f.table("straightness", [&](Fields& t) { read_straightness(t, s.straightness.emplace()); });
    f.table("squareness", [&](Fields& t) { read_squareness(t, s.squareness.emplace()); });
    refuse_other_optics(f, s);
    f.table("ballbar", [&](Fields& t) { read_ballbar(t, s.ballbar.emplace()); });
    f.table("cnc", [&](Fields& t) { read_cnc(t, s.cnc.emplace()); });
    f.table("truth", [&](Fields& t) {
        t.positive("window_s", s.truth.window_s);
        t.positive("duration_s", s.truth.duration_s);
        t.read("draws", s.truth.draws);
    });
}

} // namespace

Result<Scenario> parse_scenario(const std::string& text, bool toml) {
    Json document;
    try {
        if (toml) {
            std::ostringstream json;
            json << toml::json_formatter{toml::parse(text)};
            document = Json::parse(json.str());
        } else {
            document = Json::parse(text);
        }
    } catch (const std::exception& error) {
        return fail(Fault::bad_configuration, std::string{"scenario: "} + error.what());
    }
    Scenario scenario;
    std::string refusals;
    Fields root{document, "", refusals};
    read_all(root, scenario);
    root.refuse_what_is_left();
    if (!refusals.empty()) return fail(Fault::bad_configuration, "scenario: " + refusals);
    return scenario;
}

Result<Scenario> read_scenario(const std::string& path) {
    std::ifstream file{path};
    std::ostringstream text;
    if (!file || !(text << file.rdbuf()))
        return fail(Fault::not_found, "the scenario file " + path + " can not be read");
    return parse_scenario(text.str(), !path.ends_with(".json"));
}

} // namespace axiscal::simulate
