#include "acquisition/documents/circular/circular_certificate_csv.hpp"

#include "acquisition/documents/circular/circular_json.hpp"
#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/csv_text.hpp"
#include "analysis/circular/circular_trials.hpp"

namespace axiscal {
namespace {

constexpr double micrometres = 1e3;

void append_head(std::string& csv, const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const CircularRun& run = measured.run;
    const auto line = [&](const char* key, const std::string& value) {
        append_csv_line(csv, {std::string{"# "} + key, csv_field(value)});
    };
    append_csv_line(csv, {"# axiscal.circular-csv/1"});
    line(measured.taken_elsewhere ? "case" : "run", run.run_id);
    line("certificate_number", run.statements.certificate_number);
    if (!certificate.replaces.empty()) line("replaces", certificate.replaces);
    line("machine", run.statements.machine);
    line("machine_serial", run.statements.machine_serial);
    line("plane", measured.axes[0] + measured.axes[1]);
    line("nominal_diameter_mm", csv_number(2 * measured.test.nominal_radius_mm));
    line("feed_mm_per_s", csv_number(measured.test.feed_mm_per_s));
    line("started", measured.started_utc);
    line("finished", measured.finished_utc);
    line("standard", "ISO 230-4");
    line("sign", "deviation = measured radius - nominal radius; angle from the first + axis, "
                 "counter-clockwise");
    line(measured.taken_elsewhere ? "case_sha256" : "run_file_sha256", certificate.file_sha256);
    line("software_version", run.software_version);
    for (const PreflightRecord& check : run.preflight)
        if (!check.passed)
            append_csv_line(csv, {"# preflight overridden", csv_field(check.name),
                                  csv_field(check.verdict), csv_field(check.override_reason)});
}

void append_figures(std::string& csv, const CircularCertificate& certificate) {
    append_conformity(csv, certificate.conformity);
    const SignalSource source = certificate.measured.test.source;
    for (const auto& [key, value] : circular::figures_by_key(certificate.parameters)) {
        const std::string label = circular_label(key, source);
        const auto* known = certificate.uncertainty_of(key);
        if (!known) {
            append_csv_line(csv,
                            {"# parameter", label, csv_number(value), "mm", "U not evaluated"});
            continue;
        }
        append_csv_line(csv, {"# parameter", label, csv_number(value), "mm",
                              "\u00B1 " + csv_number(known->expanded_mm),
                              "k = " + csv_number(certificate.budget->coverage)});
    }
    for (const auto& [key, reason] : certificate.parameters.not_evaluated)
        append_csv_line(csv, {"# not_evaluated", circular_label(key, source), csv_field(reason)});
    for (const MissingTerm& term : certificate.missing)
        append_csv_line(csv, {"# preliminary", "not stated", csv_field(term.words)});
    for (const CauseContribution& cause : certificate.diagnosis.ranking)
        append_csv_line(csv, {"# diagnosis", cause.cause, csv_number(cause.G_mm), "mm",
                              csv_field(cause.words)});
}

std::string side_of(const ZoneRing& ring, std::size_t reading) {
    for (const RingPoint& point : ring.control_points)
        if (point.index == reading) return point.side == ZoneSide::outer ? "outer" : "inner";
    return {};
}

void append_readings(std::string& csv, const CircularCertificate& certificate) {
    const CircularTest& test = certificate.measured.test;
    for (const CircularTrace& trace : test.traces) {
        const ZoneRing& ring = certificate.parameters.of(trace.sense)->G.ring;
        const CircularTrace about = centred(trace, test.nominal_radius_mm, ring.x_mm, ring.y_mm);
        const std::string sense{name_of(trace.sense)};
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
            append_csv_line(
                csv, {sense, std::to_string(i + 1), csv_number(trace.angle_rad[i] * degree_per_rad),
                      csv_number(trace.radial_deviation_mm[i] * micrometres),
                      csv_number(about.radial_deviation_mm[i] * micrometres), side_of(ring, i)});
    }
}

} // namespace

std::string circular_certificate_csv(const CircularCertificate& certificate) {
    std::string csv;
    append_head(csv, certificate);
    append_figures(csv, certificate);
    append_csv_line(
        csv, {"sense", "reading", "angle_deg", "deviation_um", "about_zone_um", "control_point"});
    append_readings(csv, certificate);
    return csv;
}

} // namespace axiscal
