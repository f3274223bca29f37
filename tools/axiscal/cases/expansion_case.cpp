#include "analysis/compensation/expansion.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// A number, or the mean of the numbers of several sensors.
Result<double> temperature_of(const json& object, const std::string& field, std::size_t& sensors) {
    const std::string full = field + ".temperature_degC";
    AXISCAL_TRY(const json* value, member(object, "temperature_degC", full));
    sensors = 1;
    if (!value->is_array()) return number_of(*value, full);
    AXISCAL_TRY(const auto readings, numbers_of(*value, full));
    if (readings.empty()) return refuse(Fault::bad_case, full, "is empty");
    for (const double reading : readings)
        if (!(std::abs(reading) <= 1e12))
            return refuse(Fault::bad_case, full, "is larger than 1e12, beyond any machine");
    sensors = readings.size();
    return std::accumulate(readings.begin(), readings.end(), 0.0) /
           static_cast<double>(readings.size());
}

struct Bodies {
    ThermalBody machine, instrument;
    std::size_t machine_sensors = 0, instrument_sensors = 0;
};

Result<ThermalBody> body_of(const json& object, const std::string& key, std::size_t& sensors) {
    AXISCAL_TRY(const json* body, member(object, key, key));
    AXISCAL_CHECK(check_object(*body, key, {"expansion_per_K", "temperature_degC"}));
    ThermalBody out;
    AXISCAL_TRY(out.expansion_per_K, number_at(*body, "expansion_per_K", key + ".expansion_per_K"));
    AXISCAL_TRY(out.temperature_degC, temperature_of(*body, key, sensors));
    return out;
}

/// first_order is what is done in practice.
Result<std::string> form_of(const json& object) {
    if (!object.contains("form")) return std::string{"first_order"};
    return one_of(object, "form", "form", {"first_order", "exact"});
}

/// `unit`: "" where the case names one, else what the keys end in.
void add_at_20C(ordered_json& object,
                const DeviationAt20C& value,
                const std::string& form,
                const std::string& unit) {
    object["at_20C" + unit] = form == "exact" ? value.exact : value.first_order;
    object["first_order" + unit] = value.first_order;
    object["exact" + unit] = value.exact;
    object["exact_minus_first_order" + unit] = value.exact - value.first_order;
}

ordered_json header(const std::string& kind, const std::string& form) {
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["kind"] = kind;
    answer["form"] = form;
    return answer;
}

void add_body(ordered_json& answer, const char* key, const ThermalBody& body, std::size_t sensors) {
    answer[key]["temperature_degC"] = body.temperature_degC;
    answer[key]["strain"] = thermal_strain(body);
    answer[key]["sensors"] = sensors;
}

/// A number or an array of numbers.
Result<std::vector<double>> one_or_more(const json& object, const std::string& key) {
    AXISCAL_TRY(const json* value, member(object, key, key));
    if (value->is_array()) return numbers_of(*value, key);
    AXISCAL_TRY(const double number, number_of(*value, key));
    return std::vector<double>{number};
}

// ---- scale and laser: deviations that were read -----------------------------------------------

Result<Bodies> bodies_of(const json& object, bool laser) {
    Bodies bodies;
    AXISCAL_TRY(bodies.machine, body_of(object, "machine", bodies.machine_sensors));
    if (!laser) {
        AXISCAL_TRY(bodies.instrument, body_of(object, "instrument", bodies.instrument_sensors));
    }
    return bodies;
}

Result<void> check_laser(const json& object) {
    AXISCAL_TRY(const json* compensated,
                member(object, "wavelength_compensated", "wavelength_compensated"));
    if (*compensated == json(true)) return {};
    return refuse(Fault::bad_case, "wavelength_compensated",
                  "must be true: the readings of a laser must already be corrected for the air, "
                  "once; raw counts go to kind \"interferometer\"");
}

Result<ordered_json> expansion_of_readings(const json& object, const std::string& kind) {
    const bool laser = kind == "laser";
    Words keys{"analysis", "kind", "form", "unit", "distance", "deviation", "machine"};
    keys.emplace_back(laser ? "wavelength_compensated" : "instrument");
    AXISCAL_CHECK(check_object(object, "", keys));
    AXISCAL_TRY(const std::string form, form_of(object));
    AXISCAL_TRY(const std::string unit, one_of(object, "unit", "unit", {"um", "mm", "m"}));
    if (laser) AXISCAL_CHECK(check_laser(object));
    AXISCAL_TRY(const Bodies bodies, bodies_of(object, laser));
    AXISCAL_TRY(const auto distances, one_or_more(object, "distance"));
    AXISCAL_TRY(const auto deviations, one_or_more(object, "deviation"));
    if (deviations.size() != distances.size())
        return refuse(Fault::bad_case, "deviation", "must hold as many numbers as distance");
    ordered_json answer = header(kind, form);
    answer["unit"] = unit;
    add_body(answer, "machine", bodies.machine, bodies.machine_sensors);
    if (!laser) add_body(answer, "instrument", bodies.instrument, bodies.instrument_sensors);
    if (bodies.machine_sensors < 2)
        answer["remarks"] = {"one material sensor: a gradient along the axis stays unseen; two or "
                             "more are usual"};
    answer["points"] = ordered_json::array();
    for (std::size_t i = 0; i < distances.size(); ++i) {
        AXISCAL_TRY(const auto corrected, deviation_at_20C(distances[i], deviations[i],
                                                           bodies.machine, bodies.instrument));
        ordered_json point{{"distance", distances[i]}, {"deviation", deviations[i]}};
        add_at_20C(point, corrected, form, "");
        answer["points"].push_back(std::move(point));
    }
    return answer;
}

// ---- interferometer: counts -------------------------------------------------------------------

Result<double> beam_angle_of(const json& object) {
    if (!object.contains("beam_walk_mm")) {
        if (object.contains("beam_walk_travel_mm"))
            return refuse(Fault::bad_case, "beam_walk_travel_mm", "needs beam_walk_mm beside it");
        return number_or(object, "beam_angle_rad", "beam_angle_rad", 0);
    }
    if (object.contains("beam_angle_rad"))
        return refuse(Fault::bad_case, "beam_angle_rad", "stands beside beam_walk_mm");
    AXISCAL_TRY(const double walk, number_at(object, "beam_walk_mm", "beam_walk_mm"));
    AXISCAL_TRY(const double travel,
                number_at(object, "beam_walk_travel_mm", "beam_walk_travel_mm"));
    if (!(travel >= 1e-12 && travel <= 1e12))
        return refuse(Fault::bad_case, "beam_walk_travel_mm", "must be positive");
    return beam_angle_of_walk(walk, travel);
}

struct InterferometerCase {
    InterferometerSetup setup;
    std::vector<double> counts, n_minus_1;
    std::size_t sensors = 0;
};

Result<InterferometerCase> interferometer_of(const json& object) {
    InterferometerCase out;
    AXISCAL_TRY(out.setup.vacuum_wavelength_nm,
                number_at(object, "vacuum_wavelength_nm", "vacuum_wavelength_nm"));
    AXISCAL_TRY(const double passes, number_or(object, "passes", "passes", 2));
    out.setup.passes = passes == 2 ? 2 : passes == 4 ? 4 : 0;
    AXISCAL_TRY(out.counts, one_or_more(object, "counts"));
    AXISCAL_TRY(out.n_minus_1, one_or_more(object, "n_minus_1"));
    if (out.n_minus_1.size() == 1 && !out.counts.empty())
        out.n_minus_1.assign(out.counts.size(), out.n_minus_1.front());
    if (out.n_minus_1.size() != out.counts.size())
        return refuse(Fault::bad_case, "n_minus_1", "must be one number, or one for each count");
    AXISCAL_TRY(out.setup.dead_path_mm, number_or(object, "dead_path_mm", "dead_path_mm", 0));
    const bool needs_zero = out.setup.dead_path_mm != 0;
    if (needs_zero || object.contains("n_minus_1_at_zero")) {
        AXISCAL_TRY(out.setup.n_minus_1_at_zero,
                    number_at(object, "n_minus_1_at_zero", "n_minus_1_at_zero"));
    }
    AXISCAL_TRY(out.setup.beam_angle_rad, beam_angle_of(object));
    if (object.contains("machine")) {
        AXISCAL_TRY(out.setup.machine, body_of(object, "machine", out.sensors));
    }
    return out;
}

Result<void> add_abbe(const json& object, ordered_json& answer) {
    if (!object.contains("abbe")) return {};
    const json& abbe = object.at("abbe");
    AXISCAL_CHECK(check_object(abbe, "abbe", {"offset_mm", "angle_rad"}));
    AXISCAL_TRY(const double offset, number_at(abbe, "offset_mm", "abbe.offset_mm"));
    AXISCAL_TRY(const double angle, number_at(abbe, "angle_rad", "abbe.angle_rad"));
    if (!(std::abs(offset) <= 1e12))
        return refuse(Fault::bad_case, "abbe.offset_mm", "is larger than 1e12");
    if (!(std::abs(angle) <= 1.5))
        return refuse(Fault::bad_case, "abbe.angle_rad", "must lie in -1.5..1.5 rad");
    answer["abbe_mm"] = abbe_error(offset, angle);
    return {};
}

ordered_json displacement_json(const Displacement& found, double counts, const std::string& form) {
    ordered_json point;
    point["counts"] = counts;
    point["vacuum_mm"] = found.vacuum_mm;
    point["in_air_mm"] = found.in_air_mm;
    point["cosine_mm"] = found.cosine_mm;
    point["along_axis_mm"] = found.along_axis_mm;
    if (found.at_20C) add_at_20C(point, *found.at_20C, form, "_mm");
    return point;
}

Result<ordered_json> expansion_of_counts(const json& object) {
    AXISCAL_CHECK(
        check_object(object, "",
                     {"analysis", "kind", "form", "vacuum_wavelength_nm", "passes", "counts",
                      "n_minus_1", "n_minus_1_at_zero", "dead_path_mm", "beam_angle_rad",
                      "beam_walk_mm", "beam_walk_travel_mm", "machine", "abbe"}));
    AXISCAL_TRY(const std::string form, form_of(object));
    AXISCAL_TRY(const InterferometerCase stated, interferometer_of(object));
    ordered_json answer = header("interferometer", form);
    answer["beam_angle_rad"] = stated.setup.beam_angle_rad;
    if (stated.setup.machine) add_body(answer, "machine", *stated.setup.machine, stated.sensors);
    AXISCAL_CHECK(add_abbe(object, answer));
    answer["points"] = ordered_json::array();
    for (std::size_t i = 0; i < stated.counts.size(); ++i) {
        AXISCAL_TRY(const Displacement found,
                    displacement_of(stated.setup, stated.counts[i], stated.n_minus_1[i]));
        answer["points"].push_back(displacement_json(found, stated.counts[i], form));
    }
    return answer;
}

} // namespace

Result<ordered_json> expansion_case(const json& object) {
    AXISCAL_TRY(const std::string kind,
                one_of(object, "kind", "kind", {"scale", "laser", "interferometer"}));
    return kind == "interferometer" ? expansion_of_counts(object)
                                    : expansion_of_readings(object, kind);
}

} // namespace axiscal
