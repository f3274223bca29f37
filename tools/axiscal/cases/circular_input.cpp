#include "tools/axiscal/cases/circular_input.hpp"

#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/circular_report_member.hpp"
#include "tools/axiscal/cases/tolerances_member.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

/// In radians, by the one name of the two that stands there.
Result<std::vector<double>> angles_of(const json& object, const std::string& field) {
    const bool degrees = object.contains("angle_deg");
    if (degrees && object.contains("angle_rad"))
        return refuse(Fault::bad_case, field + ".angle_deg", "stands beside angle_rad");
    if (!degrees) return numbers_at(object, "angle_rad", field + ".angle_rad");
    AXISCAL_TRY(std::vector<double> angles, numbers_at(object, "angle_deg", field + ".angle_deg"));
    for (double& angle : angles)
        angle *= std::numbers::pi / 180;
    return angles;
}

Result<CircularTrace> trace_of(const json& object, const std::string& field) {
    AXISCAL_CHECK(check_object(
        object, field, {"sense", "angle_rad", "angle_deg", "radial_deviation_mm", "source"}));
    CircularTrace trace;
    AXISCAL_TRY(const std::string sense, one_of(object, "sense", field + ".sense", {"ccw", "cw"}));
    trace.sense = sense == "ccw" ? Sense::ccw : Sense::cw;
    AXISCAL_TRY(trace.angle_rad, angles_of(object, field));
    AXISCAL_TRY(trace.radial_deviation_mm,
                numbers_at(object, "radial_deviation_mm", field + ".radial_deviation_mm"));
    return trace;
}

/// "feedback" and "external" say what made the readings; other words are a remark, unless they
/// sound like the former.
Result<std::optional<SignalSource>> source_of(const json& object, const std::string& field) {
    const auto found = object.find("source");
    if (found == object.end() || !found->is_string()) return std::optional<SignalSource>{};
    std::string words = found->get<std::string>();
    if (words == "feedback") return std::optional{SignalSource::feedback};
    if (words == "external") return std::optional{SignalSource::external};
    std::ranges::transform(words, words.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (words.find("feedb") != std::string::npos || words.find("external") != std::string::npos)
        return refuse(Fault::bad_case, field,
                      "must be \"feedback\" or \"external\"; remarks go under 'comment'");
    return std::optional<SignalSource>{};
}

Result<CircularTest> test_of(const json& object) {
    CircularTest test;
    AXISCAL_TRY(test.nominal_radius_mm,
                number_at(object, "nominal_radius_mm", "nominal_radius_mm"));
    AXISCAL_TRY(const double feed, number_at(object, "feed_mm_per_min", "feed_mm_per_min"));
    test.feed_mm_per_s = feed / 60;
    AXISCAL_TRY(const json* traces, member(object, "traces", "traces"));
    if (!traces->is_array() || traces->empty())
        return refuse(Fault::bad_case, "traces", "must be an array of one trace a sense");
    AXISCAL_TRY(const auto stated, source_of(object, "source"));
    std::optional<SignalSource> source = stated;
    for (std::size_t i = 0; i < traces->size(); ++i) {
        const std::string field = indexed("traces", i);
        AXISCAL_TRY(CircularTrace trace, trace_of((*traces)[i], field));
        test.traces.push_back(std::move(trace));
        AXISCAL_TRY(const auto own, source_of((*traces)[i], field + ".source"));
        const auto of_this = own ? own : stated.value_or(SignalSource::external);
        if (i == 0 && !source) source = of_this;
        if (of_this != source)
            return refuse(Fault::bad_case, field + ".source",
                          "feedback signals and an external instrument are never mixed");
    }
    test.source = source.value_or(SignalSource::external);
    return test;
}

Result<std::optional<BarExpansion>> bar_of(const json& object) {
    if (!object.contains("temperature")) return std::optional<BarExpansion>{};
    const json& stated = object.at("temperature");
    AXISCAL_CHECK(check_object(stated, "temperature",
                               {"bar_degC", "machine_degC", "bar_expansion_per_K",
                                "machine_expansion_per_K", "bar_length_mm"}));
    BarExpansion bar;
    AXISCAL_TRY(bar.bar_degC, number_at(stated, "bar_degC", "temperature.bar_degC"));
    AXISCAL_TRY(bar.machine_degC, number_at(stated, "machine_degC", "temperature.machine_degC"));
    AXISCAL_TRY(bar.bar_alpha_per_K,
                number_at(stated, "bar_expansion_per_K", "temperature.bar_expansion_per_K"));
    AXISCAL_TRY(bar.machine_alpha_per_K, number_at(stated, "machine_expansion_per_K",
                                                   "temperature.machine_expansion_per_K"));
    AXISCAL_TRY(bar.bar_length_mm, number_at(stated, "bar_length_mm", "temperature.bar_length_mm"));
    return std::optional{bar};
}

Result<AxisNames> axes_of(const json& object) {
    AxisNames axes{"X", "Y"};
    if (!object.contains("axes")) return axes;
    const json& stated = object.at("axes");
    const auto good = [](const json& name) {
        return name.is_string() && !name.get_ref<const std::string&>().empty() &&
               name.get_ref<const std::string&>().size() <= 8 &&
               std::ranges::all_of(name.get_ref<const std::string&>(),
                                   [](unsigned char c) { return c < 128 && std::isalnum(c); });
    };
    if (!stated.is_array() || stated.size() != 2 || !good(stated[0]) || !good(stated[1]) ||
        stated[0] == stated[1])
        return refuse(Fault::bad_case, "axes",
                      "must be two different names of up to eight letters and digits");
    return AxisNames{stated[0].get<std::string>(), stated[1].get<std::string>()};
}

Result<int> count_or(
    const json& object, const std::string& key, const std::string& field, int missing, int most) {
    if (!object.contains(key)) return missing;
    const json& value = object.at(key);
    if (!value.is_number_integer() || value.get<double>() < 0 || value.get<double>() > most)
        return refuse(Fault::bad_case, field,
                      "must be a whole number within 0 ... " + std::to_string(most));
    return value.get<int>();
}

Result<std::optional<StatedCircularUncertainty>> statement_of(const json& object) {
    if (!object.contains("uncertainty")) return std::optional<StatedCircularUncertainty>{};
    const json& given = object.at("uncertainty");
    StatedCircularUncertainty out;
    CircularUncertaintyStatement& s = out.stated;
    const std::vector<std::pair<const char*, std::optional<double>*>> numbers{
        {"device_width_um", &s.device_width_um},
        {"calibration_U_um", &s.calibration_U_um},
        {"calibration_k", &s.calibration_k},
        {"repeatability_um", &s.repeatability_um},
        {"eve_um", &s.eve_um},
        {"centre_width_um", &s.centre_width_um},
        {"machine_temperature_width_K", &s.machine_temperature_width_K},
        {"bar_temperature_width_K", &s.bar_temperature_width_K},
        {"machine_expansion_width_per_K", &s.machine_alpha_width_per_K},
        {"bar_expansion_width_per_K", &s.bar_alpha_width_per_K}};
    Words known{"n", "trials"};
    for (const auto& [key, place] : numbers)
        known.emplace_back(key);
    AXISCAL_CHECK(check_object(given, "uncertainty", known));
    for (const auto& [key, place] : numbers) {
        if (!given.contains(key)) continue;
        AXISCAL_TRY(*place, number_at(given, key, std::string{"uncertainty."} + key));
    }
    AXISCAL_TRY(s.runs, count_or(given, "n", "uncertainty.n", 1, 1000));
    AXISCAL_TRY(out.trials, count_or(given, "trials", "uncertainty.trials", 1000, 100'000));
    return std::optional{out};
}

Result<RadialCentre> centre_of(const json& object) {
    if (!object.contains("f_centre")) return RadialCentre::automatic;
    AXISCAL_TRY(const std::string word,
                one_of(object, "f_centre", "f_centre", {"set_up", "least_squares"}));
    return word == "set_up" ? RadialCentre::set_up : RadialCentre::least_squares;
}

} // namespace

Result<CircularInput> read_circular_case(const json& object) {
    AXISCAL_CHECK(
        check_object(object, "",
                     {"analysis", "nominal_radius_mm", "feed_mm_per_min", "traces", "f_centre",
                      "temperature", "axes", "uncertainty", "tolerances", "source", "report"}));
    CircularInput input;
    AXISCAL_TRY(input.test, test_of(object));
    AXISCAL_TRY(input.f_centre, centre_of(object));
    AXISCAL_TRY(input.bar, bar_of(object));
    AXISCAL_TRY(input.axes, axes_of(object));
    AXISCAL_TRY(input.uncertainty, statement_of(object));
    AXISCAL_TRY(input.report, report_of(object));
    if (object.contains("tolerances")) {
        AXISCAL_TRY(input.tolerances, circular_tolerances_of(object.at("tolerances")));
    }
    return input;
}

} // namespace axiscal
