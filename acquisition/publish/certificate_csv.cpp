#include "acquisition/publish/certificate_csv.hpp"

#include "acquisition/publish/certificate_json.hpp"
#include "acquisition/publish/uncertainty_json.hpp"
#include "analysis/environment_history.hpp"

#include <charconv>
#include <initializer_list>

namespace axiscal {
namespace {

constexpr std::string_view line_end = "\r\n";

std::string number(double value) {
    char text[32];
    const auto written = std::to_chars(text, text + sizeof text, value);
    return {text, written.ptr};
}

std::string number(const std::optional<double>& value) {
    return value ? number(*value) : std::string{};
}

/// One field: no line breaks, quoted where a comma or a quote would end it.
std::string field(std::string_view words) {
    std::string text;
    bool quote = false;
    for (const char c : words) {
        if (c == '"') text += '"';
        text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        quote = quote || c == '"' || c == ',';
    }
    return quote ? '"' + text + '"' : text;
}

void append_line(std::string& csv, std::initializer_list<std::string> fields) {
    bool first = true;
    for (const std::string& text : fields) {
        if (!first) csv += ',';
        csv += text;
        first = false;
    }
    csv += line_end;
}

void append_head(std::string& csv, const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const auto line = [&](const char* key, const std::string& value) {
        append_line(csv, {std::string{"# "} + key, field(value)});
    };
    append_line(csv, {"# axiscal.certificate-csv/1"});
    line("run", run.run_id);
    line("certificate_number", run.statements.certificate_number);
    line("machine", run.statements.machine);
    line("machine_serial", run.statements.machine_serial);
    line("axis", run.statements.axis);
    line("started", certificate.started_utc);
    line("finished", certificate.finished_utc);
    line("standard", certificate.result.standard);
    line("sign", "deviation = actual - target; B_mean = mean forward - mean backward");
    line("run_file_sha256", certificate.run_file_sha256);
    line("software_version", run.software_version);
}

void append_parameters(std::string& csv, const Certificate& certificate) {
    auto document = certificate_to_json(certificate);
    const std::string unit = field(certificate.result.unit);
    for (const auto& [key, parameter] : document.at("parameters").items()) {
        const std::string value = number(parameter.at("value").get<double>());
        const auto expanded = parameter.find("expanded_uncertainty");
        if (expanded == parameter.end())
            append_line(csv, {"# parameter", key, value, unit, "U not evaluated"});
        else
            append_line(csv, {"# parameter", key, value, unit,
                              "\u00B1 " + number(expanded->at("value").get<double>()),
                              "k = " + number(expanded->at("k").get<double>())});
        if (const auto target = parameter.find("target_uncertainty"); target != parameter.end())
            append_line(csv,
                        {"# target_uncertainty", key, number(target->at("value").get<double>()),
                         unit, target->at("met").get<bool>() ? "met" : "not met"});
    }
    for (const auto& [key, parameter] : document.at("parameters").items())
        if (const auto drawn = parameter.find("monte_carlo"); drawn != parameter.end())
            append_line(csv, {"# simulated", key, number(drawn->at("u").get<double>()), unit,
                              "95 % from " + number(drawn->at("interval_95")[0].get<double>()),
                              "to " + number(drawn->at("interval_95")[1].get<double>())});
    for (const auto& [key, reason] : certificate.result.not_evaluated)
        append_line(csv, {"# not_evaluated", key, field(reason)});
}

void append_budget(std::string& csv, const Certificate& certificate) {
    const RunUncertainty& known = certificate.uncertainty;
    const double divisor = budget_units_per(certificate.result.unit);
    if (known.budget)
        for (const Contribution& term : known.budget->contributions)
            append_line(csv,
                        {"# budget", std::string{name_of(term.term)}, number(term.u / divisor),
                         field(certificate.result.unit), field(term.formula), field(term.status)});
    if (known.simulation)
        append_line(csv, {"# simulation", std::to_string(known.simulation->trials) + " sessions",
                          "seed " + std::to_string(known.simulation->seed)});
    for (const MissingTerm& term : known.missing)
        append_line(csv, {"# preliminary", "not stated", field(term.words)});
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

void append_points(std::string& csv, const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const bool rotary = run.plan.axis_kind == AxisKind::rotary;
    const double deviation_factor = rotary ? 3600 : 1000;
    const EnvironmentHistory history{run};
    for (const PointRecord& point : run.points) {
        const bool forward = point.planned.direction == Direction::positive;
        const auto i = static_cast<std::size_t>(point.planned.target_index);
        const auto j = static_cast<std::size_t>(point.planned.approach);
        const auto& rows =
            forward ? certificate.deviations.forward() : certificate.deviations.backward();
        const double target = certificate.deviations.targets().at(i);
        const double deviation = rows.at(i).at(j);
        const MonotonicTime at = point.window_begin + (point.window_end - point.window_begin) / 2;
        const Surroundings around = surroundings_at(history, at);
        append_line(csv, {std::to_string(j + 1), forward ? "forward" : "backward", number(target),
                          number(target + deviation), number(deviation * deviation_factor),
                          number(around.air_degC), number(around.pressure_Pa),
                          number(around.humidity_percent), number(around.material_degC),
                          iso8601_utc(run.opened.utc_ns_at(at))});
    }
}

} // namespace

std::string certificate_csv(const Certificate& certificate) {
    const bool rotary = certificate.run.plan.axis_kind == AxisKind::rotary;
    std::string csv;
    append_head(csv, certificate);
    append_parameters(csv, certificate);
    append_budget(csv, certificate);
    append_line(csv, {"run", "direction", rotary ? "target_deg" : "target_mm",
                      rotary ? "measured_deg" : "measured_mm",
                      rotary ? "deviation_arcsec" : "deviation_um", "t_air_degC", "p_Pa",
                      "rh_percent", "t_mat_degC", "time"});
    append_points(csv, certificate);
    return csv;
}

} // namespace axiscal
