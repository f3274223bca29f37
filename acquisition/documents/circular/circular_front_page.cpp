#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"
#include "acquisition/documents/circular/polar_plot.hpp"
#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/front_parts.hpp"
#include "analysis/circular/cause_advice.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr double width_of_both_senses = 300, column_gap = 12, legend_of_both_senses = 40;
constexpr Colour bar_colour{0.55, 0.62, 0.7};

std::string senses_text(const CircularTest& test) {
    std::string words;
    for (const CircularTrace& trace : test.traces)
        words += (words.empty() ? "" : " and ") + sense_name(trace.sense);
    return words;
}

std::string subject_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const bool full = certificate.parameters.cover.full_circle;
    return std::string{"Circular test, ISO 230-4, plane "} + measured.axes[0] + measured.axes[1] +
           ", nominal radius " + compact_number(measured.test.nominal_radius_mm) + " mm, " +
           feed_text(measured.test.feed_mm_per_s) + ", " + senses_text(measured.test) + ", " +
           (full ? "full circle"
                 : "arc of " + fixed(certificate.parameters.cover.arc_deg, 0) + "°") +
           (measured.test.source == SignalSource::feedback ? "; feedback signals" : "");
}

/// "G(b) = 9.6 µm ± 1.2 µm"; G where one sense was driven.
std::string main_figure(const CircularCertificate& certificate) {
    const auto lines = figure_lines(certificate);
    for (const std::string_view wanted : {"G_b", "G_ccw", "G_cw"})
        for (const CircularFigureLine& line : lines) {
            if (line.key != wanted) continue;
            const int decimals = deviation_decimals(certificate);
            const auto* known = certificate.uncertainty_of(line.key);
            return circular_symbols(certificate)(line.key) + " = " +
                   micrometres(line.value_mm, decimals) + " µm" +
                   (known ? " ± " + fixed_up(known->expanded_mm * 1000, decimals) + " µm"
                          : ", U not evaluated");
        }
    return "no figure";
}

FrontAnswer answer_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    return {"Plane " + measured.axes[0] + measured.axes[1] + ", " +
                machine_in_answer(measured.run.statements),
            stated(iso_date_of(measured)),
            verdict_on_paper(certificate.conformity, circular_symbols(certificate)),
            main_figure(certificate)};
}

std::vector<StatedField> draw_identity(Sheet& sheet, const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const std::string measured_at = measured_span(measured.started_utc, measured.finished_utc);
    auto shortened =
        sheet.fields(identity_fields(measured.run.statements,
                                     {measured_at, iso_date_of(measured), measured.next_due}),
                     2, 2);
    sheet.advance(5);
    return shortened;
}

std::string uncertainty_head(const CircularCertificate& certificate) {
    const auto lines = figure_lines(certificate);
    const bool known = std::ranges::any_of(lines, [&](const CircularFigureLine& line) {
        return certificate.uncertainty_of(line.key) != nullptr;
    });
    return known ? "± U (k = " + compact_number(certificate.budget->coverage) + ")" : "Uncertainty";
}

/// Symbol with its small index; value; U; the words below.
double draw_figures(Canvas& canvas, PageBox column, const CircularCertificate& certificate) {
    const double value_right = column.x + column.width * 0.55, u_left = value_right + 10;
    constexpr TextStyle head{7, true}, symbol{9, true}, value{9, true}, small{7.5};
    constexpr double row = 23.5;
    double y = column.y + 8;
    canvas.text({column.x, y}, "Figure", head);
    canvas.text({value_right, y}, "Value, µm", head, Align::right);
    canvas.text({u_left, y}, uncertainty_head(certificate), head);
    canvas.line({column.x, y + 4}, {column.right(), y + 4}, {ink, 0.5});
    y += 15;
    for (const CircularFigureLine& line : figure_lines(certificate)) {
        const double width = canvas.text({column.x, y}, line.symbol, symbol) + 1.5;
        TextStyle index{6.5};
        while (index.size > 3 && width + canvas.width_of(line.index, index) > column.width * 0.35)
            index.size -= 0.5; // long names of axes
        canvas.text({column.x + width, y + 1.5}, line.index, index);
        const bool signed_value = !line.key.starts_with('G');
        canvas.text({value_right, y},
                    micrometres(line.value_mm, deviation_decimals(certificate), signed_value),
                    value, Align::right);
        canvas.text({u_left, y}, uncertainty_text(certificate, line.key), small);
        canvas.paragraph({column.x, y + 3}, column.width, line.words, {6.5, false, grey}, 1);
        y += row;
    }
    return y - 8 - column.y;
}

std::string temperature_note(const CircularCertificate& certificate) {
    const auto& correction = certificate.parameters.correction_mm;
    if (!correction) return "F and D as measured, not at 20 °C.";
    return "F and D at 20 °C; they contain " +
           micrometres(*correction, deviation_decimals(certificate), true) + " µm for it.";
}

/// @returns the height that it took
double draw_column(Canvas& canvas, PageBox column, const CircularCertificate& certificate) {
    double y = column.y + draw_figures(canvas, column, certificate) + 2;
    const auto tell = [&](const std::string& words) {
        y += canvas.paragraph({column.x, y}, column.width, words, note_style).height + 2;
    };
    const bool external = certificate.measured.test.source == SignalSource::external;
    tell("G by the minimum zone" +
         (external ? "; " + radial_centre_text(certificate) + ". " + temperature_note(certificate)
                   : std::string{"."}));
    for (const std::string& reason : reasons_not_evaluated(certificate))
        tell(reason);
    const auto& both = certificate.parameters.G_b;
    if (both && !both->ring.control_points.empty() && y + 70 < column.bottom()) {
        canvas.text({column.x, y + 12}, "Control points of G(b)", {7, true});
        draw_control_points(canvas, {column.x, y + 15, column.width, 0}, certificate, *both);
    }
    return y - column.y;
}

/// Those that weigh most.
std::vector<CauseContribution> largest_causes(const CircularCertificate& certificate) {
    constexpr std::size_t most = 5;
    constexpr double least_mm = 5e-6; // prints as 0.01 µm
    std::vector<CauseContribution> causes;
    for (const CauseContribution& cause : certificate.diagnosis.ranking)
        if (cause.significant && cause.G_mm >= least_mm && causes.size() < most)
            causes.push_back(cause);
    return causes;
}

constexpr double bar_row = 10.5, bars_head = 14;

/// As many as have room above `reserved` points; all of them stand on the page of the diagnosis.
void draw_largest_causes(Sheet& sheet, const CircularCertificate& certificate, double reserved) {
    auto causes = largest_causes(certificate);
    const double rows = (sheet.remaining() - reserved - bars_head) / bar_row;
    if (rows < 1) return;
    while (static_cast<double>(causes.size()) > rows)
        causes.pop_back();
    if (causes.empty()) return;
    Canvas& canvas = sheet.canvas();
    constexpr double name_room = 128, bar_room = 230;
    double y = sheet.y() + 8;
    canvas.text(
        {Sheet::left, y},
        "What the form comes from: G of each cause alone (diagnosis; not part of ISO 230-4)",
        {7, true});
    for (const CauseContribution& cause : causes) {
        y += bar_row;
        const double length = bar_room * cause.G_mm / causes.front().G_mm;
        const double bar = Sheet::left + name_room;
        canvas.paragraph({Sheet::left, y - 6.8}, name_room - 6,
                         circular::title_of(cause, certificate.measured.axes), {7}, 1);
        canvas.fill({bar, y - 5.6, length, 5.6}, bar_colour);
        canvas.text({bar + length + 5, y},
                    micrometres(cause.G_mm, deviation_decimals(certificate)) + " µm", {7});
    }
    sheet.advance(bars_head + bar_row * static_cast<double>(causes.size()));
}

std::vector<std::string> notes_of(const CircularCertificate& certificate) {
    std::vector<std::string> notes;
    std::string missing;
    for (const MissingTerm& term : certificate.missing)
        missing += (missing.empty() ? "" : "; ") + term.words;
    if (!missing.empty())
        notes.push_back("Preliminary: the uncertainty budget lacks " + missing + ".");
    if (certificate.measured.taken_elsewhere)
        notes.emplace_back("The readings were not taken by this station: they come from a case "
                           "file.");
    return notes;
}

std::vector<StatedField> evidence_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const bool elsewhere = measured.taken_elsewhere;
    return {{elsewhere ? "Case" : "Run", stated(measured.run.run_id)},
            {elsewhere ? "Case file SHA-256" : "Run file SHA-256", stated(certificate.file_sha256)},
            {"Result SHA-256", stated(certificate.result_digest)},
            {"Software", "axiscal, version " + stated(measured.run.software_version)}};
}

double notes_height(Canvas& canvas, const CircularCertificate& certificate) {
    double height = 0;
    for (const std::string& words : notes_of(certificate))
        if (!words.empty())
            height += canvas.measure_paragraph(Sheet::width, words, {7.5, true}).height + 2;
    return height;
}

/// What stands between plot and signatures.
double height_below(Canvas& canvas, const CircularCertificate& certificate) {
    const auto causes = static_cast<double>(largest_causes(certificate).size());
    return legend_of_both_senses + (causes > 0 ? bars_head + bar_row * causes : 0) +
           notes_height(canvas, certificate) + 10;
}

} // namespace

std::vector<StatedField> draw_circular_front_page(Sheet& sheet,
                                                  const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const bool elsewhere = measured.taken_elsewhere;
    draw_front_title(sheet, {elsewhere ? "Report of a circular test" : "Calibration certificate",
                             measured.run.statements.state, subject_of(certificate),
                             answer_of(certificate)});
    auto shortened = draw_identity(sheet, certificate);
    draw_front_instruments(sheet, measured.run.instruments, iso_date_of(measured), shortened);
    sheet.advance(6);
    Canvas& canvas = sheet.canvas();
    constexpr double largest = 296;
    const double room = sheet.remaining() - signature_height - height_below(canvas, certificate);
    const PageBox plot{Sheet::left, sheet.y(), width_of_both_senses, std::min(room, largest)};
    const PolarView view = polar_view_of_both(certificate);
    draw_polar_plot(canvas, plot, view);
    const double legend = draw_polar_legend(canvas, plot, view);
    const double column = plot.right() + column_gap;
    const double column_height = draw_column(
        canvas, {column, plot.y, Sheet::right - column, plot.height + legend}, certificate);
    sheet.advance(std::max(plot.height + legend, column_height) + 4);
    draw_largest_causes(sheet, certificate, signature_height + notes_height(canvas, certificate));
    for (const std::string& words : notes_of(certificate))
        sheet.text(words, {7.5, true, backward_vermilion});
    draw_signatures(sheet, measured.run.statements, evidence_of(certificate));
    return shortened;
}

} // namespace axiscal
