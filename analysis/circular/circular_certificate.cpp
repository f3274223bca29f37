#include "analysis/circular/circular_certificate.hpp"

#include "analysis/circular/circular_trials.hpp"
#include "analysis/quantity/counted.hpp"
#include "analysis/record/preflight_remarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace axiscal {
namespace {

struct NeededTerm {
    std::string_view term, name, words;
};
/// By the names of CircularBudget::not_stated.
constexpr std::array needed_terms{
    NeededTerm{"device", "device", "the transducer's own error over the range of one test"},
    NeededTerm{"repeatability", "repeatability", "the repeatability (one circle alone)"},
    NeededTerm{"environment", "drift", "the drift (E_VE)"},
    NeededTerm{"calibration", "calibration", "the calibration of the bar's length"},
    NeededTerm{"machine_temperature", "machine temperature",
               "the uncertainty of the machine's temperature"},
    NeededTerm{"bar_temperature", "bar temperature", "the uncertainty of the bar's temperature"},
    NeededTerm{"machine_expansion", "machine expansion",
               "the uncertainty of the machine's expansion coefficient"},
    NeededTerm{"bar_expansion", "bar expansion",
               "the uncertainty of the bar's expansion coefficient"},
    NeededTerm{"centre", "centre", "the uncertainty of the set-up centre"}};

/// Form alone moves G; a diameter moves D, too; the centre F about the set-up's.
bool counts_in(std::string_view term, std::string_view key, RadialCentre centre) {
    const bool drift = term == "repeatability" || term == "environment";
    if (drift) return true;
    if (term == "device") return key != "D";
    if (key.starts_with('G')) return false;
    return term != "centre" || (key.starts_with('F') && centre == RadialCentre::set_up);
}

RadialCentre centre_of(const CircularParameters& parameters, std::string_view key) {
    const auto& seen = parameters.of(key.ends_with("_ccw") ? Sense::ccw : Sense::cw);
    return seen ? seen->F.centre : RadialCentre::automatic;
}

bool is_stated(std::string_view term, const std::optional<CircularBudget>& budget) {
    return budget && std::ranges::find(budget->not_stated, term) == budget->not_stated.end();
}

std::vector<MissingTerm> missing_terms_of(const CircularCertificate& certificate) {
    std::vector<MissingTerm> missing;
    for (const auto& [term, name, words] : needed_terms)
        if (!is_stated(term, certificate.budget) && certificate.needs(term))
            missing.push_back({std::string{name}, std::string{words}});
    return missing;
}

double standard_deviation(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double value : values)
        mean += value / static_cast<double>(values.size());
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// Of the figure that repeats worst.
void take_repeatability(const CircularCertificate& certificate,
                        CircularUncertaintyStatement& stated,
                        std::vector<std::string>& remarks) {
    if (stated.repeatability_um || certificate.of_repeats.empty()) return;
    double largest = 0;
    for (const auto& [key, values] : certificate.of_repeats)
        largest = std::max(largest, standard_deviation(values));
    constexpr double micrometres = 1e3;
    stated.repeatability_um = largest * micrometres;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "Repeatability: %.3f \u00B5m, the largest standard deviation of a figure over "
                  "%zu repeats.",
                  *stated.repeatability_um, certificate.of_repeats.begin()->second.size());
    remarks.emplace_back(text.data());
}

/// Widths about temperature mean nothing where none was measured.
void drop_warmth(CircularUncertaintyStatement& stated) {
    stated.machine_temperature_width_K.reset();
    stated.bar_temperature_width_K.reset();
    stated.machine_alpha_width_per_K.reset();
    stated.bar_alpha_width_per_K.reset();
}

Result<void> evaluate_repeats(CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    if (measured.repeats.size() < 2) return {};
    for (const CircularTest& repeat : measured.repeats) {
        AXISCAL_TRY(const CircularParameters seen,
                    evaluate_circular(repeat, measured.f_centre, measured.expansion));
        for (const auto& [key, value] : circular::figures_by_key(seen))
            certificate.of_repeats[key].push_back(value);
    }
    return {};
}

void name_source_of_eve(CircularBudget& budget, const std::string& drift_test) {
    const auto term =
        std::ranges::find(budget.contributions, "environment", &CircularContribution::term);
    if (term != budget.contributions.end()) term->source = drift_test;
}

Result<void> evaluate_uncertainty(CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    if (measured.stated) {
        CircularUncertaintyStatement stated = *measured.stated;
        take_repeatability(certificate, stated, certificate.remarks);
        if (!measured.expansion && !measured.taken_elsewhere) drop_warmth(stated);
        AXISCAL_TRY(certificate.budget,
                    circular_budget(measured.test, measured.f_centre, measured.expansion, stated,
                                    measured.trials));
        name_source_of_eve(*certificate.budget, measured.run.eve_source);
    }
    certificate.missing = missing_terms_of(certificate);
    certificate.preliminary = !certificate.missing.empty();
    return {};
}

void remark_on_run(const CircularRun& run, std::vector<std::string>& remarks) {
    if (run.missing > 0)
        remarks.push_back(counted(static_cast<long>(run.missing), "reading is", "readings are") +
                          " missing in the stream, at " +
                          counted(static_cast<long>(run.gaps), "place") +
                          "; the figures are those of the readings that are there.");
    if (run.dropped_blocks > 0)
        remarks.push_back(counted(static_cast<long>(run.dropped_blocks), "block") +
                          " of readings could not be stored: the disk did not keep up.");
    remark_on_preflight(run.preflight, remarks);
    for (const EventRecord& event : run.events) {
        const bool stopped = event.kind == EventKind::interrupted;
        if (!stopped && event.kind != EventKind::resumed) continue;
        remarks.push_back(
            (stopped ? "The run was interrupted at " : "The run was resumed at ") +
            iso8601_utc(event.utc_ns ? event.utc_ns : run.opened.utc_ns_at(event.at)) +
            (event.text.empty() ? "." : ": " + event.text));
    }
}

void remark_on_figures(CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    std::vector<std::string>& remarks = certificate.remarks;
    if (measured.taken_elsewhere)
        remarks.emplace_back("The readings were not taken by this station: they and all that is "
                             "stated here come from the case file.");
    if (!measured.clock_remark.empty()) remarks.push_back(measured.clock_remark);
    if (!certificate.parameters.correction_mm)
        remarks.emplace_back("F and D stand as measured, not at 20 °C: the temperatures and "
                             "expansion coefficients of machine and bar and the bar's calibrated "
                             "length were not all known.");
    if (measured.test.source == SignalSource::feedback)
        remarks.emplace_back("The readings are the machine's own feedback signals: its guideways "
                             "and what lies outside its measuring systems do not show.");
    for (const auto& deviation : {certificate.parameters.ccw, certificate.parameters.cw})
        if (deviation && deviation->G.wide) {
            remarks.emplace_back("The zone is wider than a tenth of the radius: a narrower one may "
                                 "exist elsewhere.");
            break;
        }
}

/// Appends figures in the form of canonical_bytes().
void append_figure(std::vector<std::byte>& bytes, const std::optional<double>& value) {
    constexpr double units_per_mm = 1e8, most_mm = 1e10; // what 64 bits hold
    bytes.push_back(std::byte{value ? std::uint8_t{1} : std::uint8_t{0}});
    if (!value) return;
    const auto units = static_cast<std::uint64_t>(
        std::llround(std::clamp(*value, -most_mm, most_mm) * units_per_mm));
    for (unsigned shift = 0; shift < 64; shift += 8)
        bytes.push_back(static_cast<std::byte>(units >> shift & 0xffu));
}

} // namespace

const CircularFigureUncertainty* CircularCertificate::uncertainty_of(std::string_view key) const {
    if (!budget) return nullptr;
    const bool complete = std::ranges::none_of(budget->not_stated, [&](const std::string& term) {
        return counts_in(term, key, centre_of(parameters, key));
    });
    return complete ? budget->find(key) : nullptr;
}

bool CircularCertificate::needs(std::string_view term) const {
    return std::ranges::any_of(circular::figures_by_key(parameters), [&](const auto& figure) {
        return counts_in(term, figure.first, centre_of(parameters, figure.first));
    });
}

namespace {

/// With the U that the certificate prints.
std::vector<FigureToJudge> figures_to_judge(const CircularCertificate& certificate) {
    std::vector<FigureToJudge> figures;
    for (const auto& [key, value_mm] : circular::figures_by_key(certificate.parameters)) {
        FigureToJudge figure{key, value_mm, {}};
        if (const auto* known = certificate.uncertainty_of(key)) {
            figure.expanded_uncertainty = known->expanded_mm;
            figure.coverage = certificate.budget->coverage;
        }
        figures.push_back(std::move(figure));
    }
    return figures;
}

} // namespace

Result<CircularCertificate> evaluate_measurement(CircularMeasurement measured,
                                                 std::string file_sha256) {
    CircularCertificate out;
    out.measured = std::move(measured);
    out.file_sha256 = std::move(file_sha256);
    const CircularMeasurement& from = out.measured;
    AXISCAL_TRY(out.parameters, evaluate_circular(from.test, from.f_centre, from.expansion));
    AXISCAL_TRY(out.diagnosis, diagnose_circle(from.test, from.axes));
    AXISCAL_CHECK(evaluate_repeats(out));
    remark_on_figures(out);
    if (!from.taken_elsewhere) {
        remark_on_run(from.run, out.remarks);
        out.capture_effect = capture_effect(from.test, from.run.capture);
    }
    AXISCAL_CHECK(evaluate_uncertainty(out));
    out.conformity = conformity_of(from.run.tolerances, figures_to_judge(out), "mm");
    return out;
}

std::vector<std::byte> canonical_bytes(const CircularParameters& parameters) {
    constexpr std::string_view format = "axiscal.canonical-circular/1";
    std::vector<std::byte> bytes;
    for (const char c : format)
        bytes.push_back(static_cast<std::byte>(c));
    const auto append_width = [&](const CircularDeviation* G) {
        append_figure(bytes, G ? std::optional{G->minimum_zone_mm} : std::nullopt);
        append_figure(bytes, G ? std::optional{G->least_squares_mm} : std::nullopt);
    };
    for (const Sense sense : {Sense::ccw, Sense::cw})
        append_width(parameters.of(sense) ? &parameters.of(sense)->G : nullptr);
    append_width(parameters.G_b ? &*parameters.G_b : nullptr);
    const auto figures = circular::figures_by_key(parameters);
    for (const char* key : {"F_max_ccw", "F_min_ccw", "F_max_cw", "F_min_cw", "D"}) {
        const auto found = figures.find(key);
        append_figure(bytes, found == figures.end() ? std::nullopt : std::optional{found->second});
    }
    return bytes;
}

} // namespace axiscal
