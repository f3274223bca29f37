#include "acquisition/documents/positioning/certificate_csv.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/csv_text.hpp"
#include "acquisition/documents/positioning/certificate_json.hpp"
#include "acquisition/documents/uncertainty_json.hpp"
#include "analysis/compensation/environment_history.hpp"
#include "analysis/record/run_clock.hpp"

#include <algorithm>

namespace axiscal {
namespace {

void append_head(std::string& csv, const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const auto line = [&](const char* key, const std::string& value) {
        append_csv_line(csv, {std::string{"# "} + key, csv_field(value)});
    };
    append_csv_line(csv, {"# axiscal.certificate-csv/1"});
    line("run", run.run_id);
    line("certificate_number", run.statements.certificate_number);
    if (!certificate.replaces.empty()) line("replaces", certificate.replaces);
    line("machine", run.statements.machine);
    line("machine_serial", run.statements.machine_serial);
    line("axis", run.statements.axis);
    line("started", run.imported ? run.imported->measured : certificate.started_utc);
    line("finished", run.imported ? run.imported->measured : certificate.finished_utc);
    line("standard", certificate.result.standard);
    if (run.scale) line("reference", "linear scale");
    if (run.imported) line("imported", run.imported->file + ", SHA-256 " + run.imported->sha256);
    line("sign", "deviation = actual - target; B_mean = mean forward - mean backward");
    line("run_file_sha256", certificate.run_file_sha256);
    line("software_version", run.software_version);
}

/// What enters no figure, one line a target and direction; excluded readings have lines of their
/// own (append_set_aside).
void append_completeness(std::string& csv, const Certificate& certificate) {
    const Completeness& known = certificate.completeness;
    append_csv_line(csv,
                    {"# completeness", known.partial() ? "partial" : "complete",
                     "used " + std::to_string(known.used), "of " + std::to_string(known.expected)});
    if (!known.partial()) return;
    for (const LeftOut& entry : known.left_out)
        append_csv_line(csv, {"# left_out", std::to_string(entry.approaches.size()),
                              entry.direction == Direction::positive ? "forward" : "backward",
                              csv_number(certificate.planned_targets.at(
                                  static_cast<std::size_t>(entry.target_index))),
                              csv_field(entry.why)});
}

void append_parameters(std::string& csv, const Certificate& certificate) {
    auto document = certificate_to_json(certificate);
    const std::string unit = csv_field(certificate.result.unit);
    for (const auto& [key, parameter] : document.at("parameters").items()) {
        const std::string value = csv_number(parameter.at("value").get<double>());
        const auto expanded = parameter.find("expanded_uncertainty");
        if (expanded == parameter.end())
            append_csv_line(csv, {"# parameter", key, value, unit, "U not evaluated"});
        else
            append_csv_line(csv, {"# parameter", key, value, unit,
                                  "\u00B1 " + csv_number(expanded->at("value").get<double>()),
                                  "k = " + csv_number(expanded->at("k").get<double>())});
        if (const auto target = parameter.find("target_uncertainty"); target != parameter.end())
            append_csv_line(csv, {"# target_uncertainty", key,
                                  csv_number(target->at("value").get<double>()), unit,
                                  target->at("met").get<bool>() ? "met" : "not met"});
    }
    for (const auto& [key, parameter] : document.at("parameters").items())
        if (const auto drawn = parameter.find("monte_carlo"); drawn != parameter.end())
            append_csv_line(csv,
                            {"# simulated", key, csv_number(drawn->at("u").get<double>()), unit,
                             "95 % from " + csv_number(drawn->at("interval_95")[0].get<double>()),
                             "to " + csv_number(drawn->at("interval_95")[1].get<double>())});
    for (const auto& [key, parameter] : document.at("parameters").items())
        if (const auto lies_in = parameter.find("true_value_95"); lies_in != parameter.end())
            append_csv_line(csv, {"# true_value", key, csv_number((*lies_in)[0].get<double>()),
                                  unit, "to " + csv_number((*lies_in)[1].get<double>()), "95 %"});
    for (const auto& [key, reason] : certificate.result.not_evaluated)
        append_csv_line(csv, {"# not_evaluated", key, csv_field(reason)});
}

void append_budget(std::string& csv, const Certificate& certificate) {
    const RunUncertainty& known = certificate.uncertainty;
    const double divisor = budget_units_per(certificate.result.unit);
    if (known.budget)
        for (const Contribution& term : known.budget->contributions)
            append_csv_line(csv, {"# budget", std::string{name_of(term.term)},
                                  csv_number(term.u / divisor), csv_field(certificate.result.unit),
                                  csv_field(term.formula), csv_field(term.status)});
    if (known.simulation)
        append_csv_line(csv,
                        {"# simulation", std::to_string(known.simulation->trials) + " sessions",
                         "seed " + std::to_string(known.simulation->seed)});
    for (const MissingTerm& term : known.missing)
        append_csv_line(csv, {"# preliminary", "not stated", csv_field(term.words)});
}

void append_synchronisation(std::string& csv, const Certificate& certificate) {
    const SynchronisationSummary over =
        summarize_synchronisation(certificate.run, certificate.attachments.synchronisation);
    if (!over.largest) return append_csv_line(csv, {"# synchronisation", "not stated"});
    const SynchronisationUnit unit = synchronisation_unit_of(certificate.run);
    append_csv_line(csv,
                    {"# synchronisation", csv_number(over.largest->stated->error_um * unit.per_um),
                     std::string{unit.name},
                     "largest of " + std::to_string(over.stated) + " captures; " +
                         std::to_string(over.captures - over.stated) + " not stated"});
}

/// Air and material at one instant; absent where nothing was measured near it.
struct Surroundings {
    std::optional<double> air_degC, pressure_Pa, humidity_percent, material_degC;
};

Surroundings surroundings_at(const EnvironmentHistory& history, MonotonicTime at) {
    Surroundings found;
    if (const auto air = history.air_at(at, "")) {
        found.air_degC = air->temperature.in_celsius();
        found.pressure_Pa = air->pressure.in(pascal);
        found.humidity_percent = air->relative_humidity.in(percent);
    }
    if (const auto material = history.material_at(at, ""))
        found.material_degC = material->in_celsius();
    return found;
}

bool is_excluded(const Certificate& certificate, const PointRecord& point) {
    return std::ranges::any_of(certificate.set_aside, [&](const SetAside& reading) {
        return !reading.superseded && reading.step == point.step;
    });
}

/// Readings that no figure uses: as comments, so that no reader takes them for data.
void append_set_aside(std::string& csv, const Certificate& certificate) {
    const double factor = certificate.run.plan.axis_kind == AxisKind::rotary ? 3600 : 1000;
    for (const SetAside& reading : certificate.set_aside)
        append_csv_line(csv,
                        {reading.superseded ? "# superseded" : "# excluded",
                         std::to_string(reading.planned.approach + 1),
                         reading.planned.direction == Direction::positive ? "forward" : "backward",
                         csv_number(certificate.planned_targets.at(
                             static_cast<std::size_t>(reading.planned.target_index))),
                         csv_number(reading.deviation * factor), csv_field(reading.reason)});
    for (const PreflightRecord& check : certificate.revisions.preflight)
        if (!check.passed)
            append_csv_line(csv, {"# preflight overridden", csv_field(check.name),
                                  csv_field(check.verdict), csv_field(check.override_reason)});
}

/// In the unit of synchronisation_unit_of(); empty where it is not stated.
std::optional<double> synchronisation_error(const Certificate& certificate,
                                            const PointRecord& point) {
    const auto* record =
        synchronisation_of_step(certificate.attachments.synchronisation, point.step);
    if (record == nullptr || !record->stated) return std::nullopt;
    return record->stated->error_um * synchronisation_unit_of(certificate.run).per_um;
}

void append_points(std::string& csv, const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const bool rotary = run.plan.axis_kind == AxisKind::rotary;
    const double deviation_factor = rotary ? 3600 : 1000;
    const EnvironmentHistory history{run};
    const ClockTie tie = tie_of_points(run.opened, run.events);
    for (std::size_t k = 0; k < run.points.size(); ++k) {
        const PointRecord& point = run.points[k];
        const bool forward = point.planned.direction == Direction::positive;
        const auto i = static_cast<std::size_t>(point.planned.target_index);
        const auto j = static_cast<std::size_t>(point.planned.approach);
        if (is_excluded(certificate, point)) continue; // stands among those set aside
        const double target = certificate.planned_targets.at(i);
        const double deviation = certificate.compensation.after.at(k);
        const MonotonicTime at = point.window_begin + (point.window_end - point.window_begin) / 2;
        const Surroundings around = surroundings_at(history, at);
        append_csv_line(csv, {std::to_string(j + 1), forward ? "forward" : "backward",
                              csv_number(target), csv_number(target + deviation),
                              csv_number(deviation * deviation_factor), csv_number(around.air_degC),
                              csv_number(around.pressure_Pa), csv_number(around.humidity_percent),
                              csv_number(around.material_degC),
                              run.imported ? "" : iso8601_utc(tie.utc_ns_at(at)),
                              csv_number(synchronisation_error(certificate, point))});
    }
}

} // namespace

std::string certificate_csv(const Certificate& certificate) {
    const bool rotary = certificate.run.plan.axis_kind == AxisKind::rotary;
    std::string csv;
    append_head(csv, certificate);
    append_completeness(csv, certificate);
    append_conformity(csv, certificate.conformity);
    append_parameters(csv, certificate);
    for (const OtherResult& other : certificate.others)
        for (const NamedFigure& figure : other.parameters)
            append_csv_line(csv, {"# other_standard", csv_field(other.standard), figure.name,
                                  csv_number(figure.value), csv_field(certificate.result.unit)});
    append_budget(csv, certificate);
    append_synchronisation(csv, certificate);
    append_set_aside(csv, certificate);
    append_csv_line(
        csv, {"run", "direction", rotary ? "target_deg" : "target_mm",
              rotary ? "measured_deg" : "measured_mm", rotary ? "deviation_arcsec" : "deviation_um",
              "t_air_degC", "p_Pa", "rh_percent", "t_mat_degC", "time",
              "synchronisation_" + std::string{synchronisation_unit_of(certificate.run).name}});
    append_points(csv, certificate);
    return csv;
}

} // namespace axiscal
