// What the form comes from, for the person at the machine.

#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"
#include "analysis/circular/cause_advice.hpp"
#include "analysis/circular/cause_words.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

using circular::Cause;

std::string um_of(double mm) {
    return fixed(mm * um_per_mm, 2);
}

std::string sign_of_unit(const circular::TimeUnit& unit) {
    return unit.word == "us" ? "µs" : unit.word;
}

void draw_ranking(Sheet& sheet, const CircularCertificate& certificate) {
    const CircleDiagnosis& diagnosis = certificate.diagnosis;
    const AxisNames& axes = certificate.measured.axes;
    std::vector<TableRow> rows;
    for (const CauseContribution& cause : diagnosis.ranking)
        rows.push_back({circular::title_of(cause, axes) +
                            (cause.significant ? "" : " (within its uncertainty)"),
                        um_of(cause.G_mm), um_of(cause.G_b_mm),
                        sentence_on_paper(circular::with_names(cause.words, axes)),
                        cause.significant ? circular::advice_for(cause, diagnosis, axes)
                                          : "Nothing: it is not distinguishable from 0."});
    if (rows.empty()) {
        sheet.text("No cause rises above a picometre.", {7.5});
        return;
    }
    sheet.table({{"Cause", "", Align::left, true},
                 {"Alone: G", "µm"},
                 {"G(b)", "µm"},
                 {"What the form says", "", Align::left, true},
                 {"What a technician does first", "", Align::left, true}},
                rows, 7);
}

/// The larger of a lag and its uncertainty tells the unit of both.
TableRow row_of_lag(const circular::CauseOnPaper& paper, double lag_s, double u_s) {
    const circular::TimeUnit unit = circular::time_unit(std::max(std::fabs(lag_s), u_s));
    const int decimals = unit.word == "ms" ? 4 : 2;
    return {paper.name, fixed(lag_s * unit.a_second, decimals),
            fixed(u_s * unit.a_second, decimals), sign_of_unit(unit), paper.sign};
}

TableRow row_of(const CircularCertificate& certificate, Cause cause) {
    const circular::CauseOnPaper paper = circular::on_paper(cause, certificate.measured.axes);
    const CauseEstimate& estimate = certificate.diagnosis.of(cause);
    if (!estimate.value) return {paper.name, "not told apart", "–", paper.unit, paper.sign};
    if (cause == Cause::servo_lag_difference)
        return row_of_lag(paper, *estimate.value, estimate.standard_uncertainty);
    return {paper.name, fixed(*estimate.value * paper.factor, 2),
            fixed(estimate.standard_uncertainty * paper.factor, 2), paper.unit, paper.sign};
}

/// A sense that was not driven has no centre.
bool was_driven(const CircularCertificate& certificate, Cause cause) {
    const bool ccw = cause == Cause::center_ccw_x || cause == Cause::center_ccw_y;
    const bool cw = cause == Cause::center_cw_x || cause == Cause::center_cw_y;
    if (ccw) return certificate.measured.test.find(Sense::ccw) != nullptr;
    return !cw || certificate.measured.test.find(Sense::cw) != nullptr;
}

void draw_all_causes(Sheet& sheet, const CircularCertificate& certificate) {
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < circular::cause_count; ++i)
        if (was_driven(certificate, static_cast<Cause>(i)))
            rows.push_back(row_of(certificate, static_cast<Cause>(i)));
    sheet.advance(4);
    sheet.require(60);
    sheet.text("Every cause of the fit, with its sign", {7.5, true});
    sheet.table({{"Cause", "", Align::left},
                 {"Value", ""},
                 {"u", ""},
                 {"Unit", "", Align::left},
                 {"Above 0 means", "", Align::left, true}},
                rows, 7);
    const CircleDiagnosis& diagnosis = certificate.diagnosis;
    sheet.text("Rank " + std::to_string(diagnosis.rank) + " of " +
                   std::to_string(diagnosis.columns) + " unknowns, condition " +
                   compact_number(diagnosis.condition) + ", residual " +
                   um_of(diagnosis.residual_rms_mm) +
                   " µm rms. u: standard uncertainty by the scatter of the residuals, taken as "
                   "independent. Scales stand as measured, expansion of machine and instrument "
                   "included." +
                   (diagnosis.reversals_masked
                        ? " Readings within 4° of a reversal were left out of the fit."
                        : ""),
               note_style);
}

void draw_common_lag(Sheet& sheet, const CircularCertificate& certificate) {
    const auto& lag = certificate.diagnosis.common_lag;
    if (!lag) return;
    std::string words = "Mean radius change by both scales: " + um_of(lag->radius_change_mm) +
                        " µm. One feed does not tell a lag common to both axes from a scale error "
                        "of both";
    if (lag->longest_s) {
        const circular::TimeUnit unit = circular::time_unit(*lag->longest_s);
        words += "; were all of it lag, the lag would be " +
                 fixed(*lag->longest_s * unit.a_second, 2) + " " + sign_of_unit(unit);
    }
    sheet.text(words + ".", note_style);
}

void draw_reversals(Sheet& sheet, const CircularCertificate& certificate) {
    const auto& reversals = certificate.diagnosis.reversals;
    if (reversals.empty()) return;
    std::vector<TableRow> rows;
    for (const circular::Reversal& reversal : reversals) {
        const bool spike = reversal.spike_significant;
        rows.push_back({reversal.sense == Sense::ccw ? "CCW" : "CW",
                        certificate.measured.axes[static_cast<std::size_t>(reversal.axis)],
                        fixed(reversal.at_deg, 0) + "°", um_of(reversal.step_mm),
                        um_of(reversal.step_standard_uncertainty_mm), um_of(reversal.spike_mm),
                        spike ? fixed(reversal.spike_width_deg, 2) : "–",
                        spike ? fixed(reversal.spike_width_ms, 1) : "–", spike ? "yes" : "no"});
    }
    sheet.advance(4);
    sheet.require(60);
    sheet.text("Each reversal by itself: step outward on crossing (lost motion above 0), spike "
               "inward below 0",
               {7.5, true});
    sheet.table({{"Sense", "", Align::left},
                 {"Axis", "", Align::left},
                 {"At", ""},
                 {"Step", "µm"},
                 {"u(step)", "µm"},
                 {"Spike", "µm"},
                 {"Width", "°"},
                 {"Width", "ms"},
                 {"Spike above noise", "", Align::left}},
                rows, 7);
}

void draw_change_overs(Sheet& sheet, const CircularCertificate& certificate) {
    std::vector<TableRow> rows;
    for (const circular::ChangeOver& step : certificate.diagnosis.change_overs)
        if (step.significant)
            rows.push_back({step.sense == Sense::ccw ? "CCW" : "CW", fixed(step.at_deg, 0) + "°",
                            um_of(step.step_mm), um_of(step.standard_uncertainty_mm)});
    if (rows.empty()) return;
    sheet.advance(4);
    sheet.require(60);
    sheet.text("Steps where one axis hands the lead to the other", {7.5, true});
    sheet.table({{"Sense", "", Align::left}, {"At", ""}, {"Step outward", "µm"}, {"u", "µm"}}, rows,
                7);
}

} // namespace

void draw_circular_diagnosis(Sheet& sheet, const CircularCertificate& certificate) {
    sheet.new_page();
    sheet.heading("Diagnosis: what the form comes from");
    sheet.text("Not part of ISO 230-4. One least squares fit of named causes to all readings of " +
                   std::string{certificate.measured.test.traces.size() == 2 ? "both senses"
                                                                            : "one sense"} +
                   "; each alone would give the G that stands beside it. Contributions do not add "
                   "up. The largest first.",
               note_style);
    sheet.advance(3);
    draw_ranking(sheet, certificate);
    draw_all_causes(sheet, certificate);
    draw_common_lag(sheet, certificate);
    draw_reversals(sheet, certificate);
    draw_change_overs(sheet, certificate);
}

} // namespace axiscal
