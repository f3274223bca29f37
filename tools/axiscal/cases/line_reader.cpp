#include "tools/axiscal/cases/line_reader.hpp"

#include "analysis/quantity/quantity.hpp"
#include "tools/axiscal/cases/case_reader.hpp"

#include <utility>

namespace axiscal {

using nlohmann::json;

namespace {

const std::string taken_at_20C = "a case is taken as measured at 20 degC";

/// Mean of both directions at each target, in the order of the targets.
std::vector<double> means_of(const PositioningResult& result) {
    std::vector<double> means;
    for (const PositionRow& row : result.positions)
        means.push_back(row.mean.value_or(row.mean_forward));
    return means;
}

Result<LineCase>
line_of_readings(const json& object, const std::string& prefix, double target_to_unit) {
    AXISCAL_TRY(const auto targets, numbers_at(object, "targets", prefix + "targets"));
    AXISCAL_TRY(DeviationTable table, read_table(object, prefix, "deviations", targets));
    const auto run = declare_at_20C(std::move(table), taken_at_20C);
    if (!run) return under(prefix, run.error());
    LineCase out;
    out.repetition = evaluate_positioning(*run, "ISO 230-1:2012");
    for (const double target : targets)
        out.line.positions.push_back(target * target_to_unit);
    out.line.deviations = means_of(*out.repetition);
    return out;
}

/// The angles stand on segments: 0, 1, 2, ... are their places in the table.
Result<std::vector<double>> mean_angles(const json& object, const std::string& prefix) {
    const char* key = object.contains("angles") ? "angles" : "forward";
    AXISCAL_TRY(const json* angles, member(object, key, prefix + key));
    std::vector<double> places;
    for (std::size_t i = 0; angles->is_array() && i < angles->size(); ++i)
        places.push_back(static_cast<double>(i));
    if (places.empty()) return refuse(Fault::bad_case, prefix + key, "must be a filled array");
    AXISCAL_TRY(DeviationTable table, read_table(object, prefix, "angles", std::move(places)));
    const auto run = declare_at_20C(std::move(table), taken_at_20C);
    if (!run) return under(prefix, run.error());
    return means_of(evaluate_positioning(*run));
}

Result<LineCase>
line_from_angles(const json& object, const std::string& prefix, double target_to_unit) {
    for (const char* key : {"targets", "deviations"})
        if (object.contains(key))
            return refuse(Fault::bad_case, prefix + key, "does not go with angles");
    AXISCAL_TRY(const std::string unit, one_of(object, "angle_unit", prefix + "angle_unit",
                                               {"rad", "urad", "um/m", "arcsec", "deg"}));
    AXISCAL_TRY(const double base, number_at(object, "base", prefix + "base"));
    AXISCAL_TRY(const double start, number_or(object, "start", prefix + "start", 0));
    AXISCAL_TRY(auto angles, mean_angles(object, prefix));
    for (double& angle : angles)
        angle *= angle_unit_rad(unit);
    auto line = line_of_angles(angles, base * target_to_unit, start * target_to_unit);
    if (!line) return under(prefix, line.error());
    return LineCase{*std::move(line), std::nullopt};
}

} // namespace

const std::vector<std::string> line_keys{"targets",    "deviations", "forward", "backward",
                                         "angle_unit", "angles",     "base",    "start"};

double length_unit_m(std::string_view unit) {
    return unit == "um" ? 1e-6 : unit == "mm" ? 1e-3 : 1;
}

double angle_unit_rad(std::string_view unit) {
    if (unit == "urad" || unit == "um/m") return 1e-6;
    if (unit == "arcsec") return arcsec.size;
    return unit == "deg" ? degree.size : 1;
}

tl::unexpected<Error> under(const std::string& prefix, Error error) {
    error.field = prefix + error.field;
    return tl::unexpected<Error>(std::move(error));
}

Result<DeviationTable> read_table(const json& object,
                                  const std::string& prefix,
                                  const std::string& single,
                                  std::vector<double> targets) {
    DeviationTable table;
    table.targets = std::move(targets);
    if (object.contains(single)) {
        for (const char* key : {"forward", "backward"})
            if (object.contains(key))
                return refuse(Fault::bad_case, prefix + key, "does not go with " + single);
        AXISCAL_TRY(const auto values, numbers_at(object, single, prefix + single));
        if (values.size() != table.targets.size())
            return refuse(Fault::bad_case, prefix + single,
                          "has " + std::to_string(values.size()) + " values for " +
                              std::to_string(table.targets.size()) + " targets");
        for (const double value : values)
            table.forward.push_back({value});
        return table;
    }
    AXISCAL_TRY(const json* forward, member(object, "forward", prefix + "forward"));
    AXISCAL_TRY(table.forward, rows_of(*forward, prefix + "forward"));
    if (object.contains("backward")) {
        AXISCAL_TRY(table.backward, rows_of(object.at("backward"), prefix + "backward"));
    }
    return table;
}

Result<LineCase> read_line(const json& object, const std::string& prefix, double target_to_unit) {
    if (object.contains("angle_unit") || object.contains("angles"))
        return line_from_angles(object, prefix, target_to_unit);
    for (const char* key : {"base", "start"})
        if (object.contains(key))
            return refuse(Fault::bad_case, prefix + key, "goes with angles only");
    return line_of_readings(object, prefix, target_to_unit);
}

} // namespace axiscal
