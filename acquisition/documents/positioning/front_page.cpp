#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/plots.hpp"
#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// "A = 16.4 µm ± 2.4 µm"; E where A needs more approaches than there were.
std::string main_figure(const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const auto& budget = certificate.uncertainty.budget;
    const auto both = parameters_of_both_directions(certificate.result.parameters);
    const auto one_way = parameters_of_one_direction(certificate.result.parameters);
    for (const std::string_view wanted : {"A", "E", "A_forward", "E_forward"})
        for (const auto* lines : {&both, &one_way})
            for (const ParameterLine& line : *lines) {
                if (line.key != wanted || !line.value) continue;
                const auto* known = budget ? budget->find(line.key) : nullptr;
                const std::string unit = " " + units.deviation;
                return std::string{line.symbol} + " = " + units.of_deviation(line.value) + unit +
                       (known ? " ± " + fixed_up(known->expanded, units.deviation_decimals) + unit
                              : ", U not evaluated");
            }
    return "no figure";
}

FrontAnswer answer_of(const Certificate& certificate) {
    const Statements& said = certificate.run.statements;
    // Of others' readings it is known when this paper was made, not when they were taken.
    const std::string date = (certificate.run.imported ? "issued " : "") + certificate.issued_on;
    return {"Axis " + stated(said.axis) + ", " + machine_in_answer(said), date,
            certificate.completeness.partial()
                ? "PARTIAL: no verdict"
                : verdict_on_paper(certificate.conformity, positioning_symbol),
            main_figure(certificate)};
}

/// The file of another program says nothing of it.
std::string cycle_text(const RunRecord& run) {
    return run.imported ? "cycle not stated" : std::string{name_of(run.plan.cycle)} + " cycle";
}

void draw_title(Sheet& sheet, const Certificate& certificate) {
    const bool bidirectional = !certificate.deviations.backward().empty();
    const RunPlan& plan = certificate.run.plan;
    const bool partial = certificate.completeness.partial();
    draw_front_title(
        sheet, {partial ? "PARTIAL RESULT, no certificate" : "Calibration certificate",
                certificate.run.statements.state,
                (plan.axis_kind == AxisKind::rotary ? "Rotary" : "Linear") +
                    std::string{" positioning, "} + certificate.result.standard + ", k = " +
                    fixed(certificate.result.cover_factor, 0) + ": " + cycle_text(certificate.run) +
                    ", " + std::to_string(certificate.deviations.targets().size()) +
                    " targets, n = " + std::to_string(certificate.result.approaches) +
                    (certificate.result.approaches == 1 ? " approach" : " approaches") +
                    (bidirectional ? " in each direction" : " in the forward direction only"),
                answer_of(certificate)});
}

std::string axis_text(const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const auto [low, high] = std::ranges::minmax(certificate.deviations.targets());
    return stated(certificate.run.statements.axis) + ", targets " + units.of_position(low) +
           " to " + units.of_position(high) + " " + units.position;
}

std::vector<StatedField> draw_identity(Sheet& sheet, const Certificate& certificate) {
    const auto& imported = certificate.run.imported;
    const std::string measured =
        imported ? stated(imported->measured)
                 : measured_span(certificate.started_utc, certificate.finished_utc);
    auto fields = identity_fields(certificate.run.statements,
                                  {measured, certificate.issued_on, certificate.next_due});
    fields.push_back({"Axis", axis_text(certificate)});
    fields.push_back(
        certificate.run.rotary
            ? StatedField{"Run-out of the set-up", stated(certificate.run.rotary->run_out)}
            : StatedField{"Reference temperature",
                          imported ? "not stated" : "20 °C; all values hold there"});
    if (certificate.completeness.partial()) // they have no number, and nothing falls due
        std::erase_if(fields, [](const StatedField& field) {
            return field.key == "Certificate number" || field.key == "Next calibration due";
        });
    auto shortened = sheet.fields(fields, 2, 2);
    sheet.advance(5);
    return shortened;
}

std::vector<ParameterLine> evaluated(std::vector<ParameterLine> lines) {
    std::erase_if(lines, [](const ParameterLine& line) { return !line.value; });
    return lines;
}

void append_cells(TableRow& row,
                  const std::vector<ParameterLine>& lines,
                  std::size_t i,
                  const PaperUnits& units,
                  const RunUncertainty& uncertainty) {
    if (i >= lines.size()) {
        row.insert(row.end(), 4, "");
        return;
    }
    row.emplace_back(lines[i].symbol);
    row.emplace_back(lines[i].words);
    row.push_back(units.of_deviation(lines[i].value));
    const auto* known = uncertainty.budget ? uncertainty.budget->find(lines[i].key) : nullptr;
    row.push_back(known ? "± " + fixed_up(known->expanded, units.deviation_decimals)
                        : "U not evaluated");
}

std::string uncertainty_head(const RunUncertainty& uncertainty) {
    if (!uncertainty.budget || uncertainty.budget->parameters.empty()) return "Uncertainty";
    return "± U (k = " + fixed(uncertainty.budget->coverage, 0) + ")";
}

/// What is missing for U, and where a stated target of U is not kept.
void draw_uncertainty_notes(Sheet& sheet, const Certificate& certificate) {
    constexpr TextStyle warning{7.5, true, backward_vermilion};
    std::string missing, exceeded;
    if (certificate.run.imported) return; // said above the figures
    for (const MissingTerm& term : certificate.uncertainty.missing)
        missing += (missing.empty() ? "" : "; ") + term.words;
    if (!missing.empty())
        sheet.text("Preliminary: the uncertainty budget lacks " + missing + ".", warning);
    const auto& budget = certificate.uncertainty.budget;
    if (!budget) return;
    if (!budget->parameters.empty())
        sheet.text("U: expanded uncertainty; its budget stands under \"Measurement uncertainty\".",
                   {7, false, grey});
    const PositioningParameters& parameters = certificate.result.parameters;
    for (const auto& lines :
         {parameters_of_both_directions(parameters), parameters_of_one_direction(parameters)})
        for (const ParameterLine& line : evaluated(lines)) {
            const auto* known = budget->find(line.key);
            const auto* target = target_uncertainty_of(certificate.run, line.key);
            if (known && target &&
                known->expanded > in_budget_units(certificate.run, target->limit))
                exceeded += (exceeded.empty() ? "" : ", ") + std::string{line.symbol};
        }
    if (!exceeded.empty())
        sheet.text("U is above its stated target U_T for " + exceeded + ".", warning);
}

/// What stands first among the remarks, where nobody can overlook it.
void draw_partial_notes(Sheet& sheet, const Certificate& certificate) {
    for (const std::string& words :
         remarks_on_completeness(certificate.run, certificate.completeness))
        sheet.text(words, {7.5, true, backward_vermilion});
    if (const auto& imported = certificate.run.imported)
        sheet.text("Imported, readings by others: " + imported->file + ". No U follows from them.",
                   {7.5, true, backward_vermilion});
}

void draw_parameters(Sheet& sheet, const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const auto both = evaluated(parameters_of_both_directions(certificate.result.parameters));
    const auto one_way = evaluated(parameters_of_one_direction(certificate.result.parameters));
    std::vector<TableRow> rows(std::max(both.size(), one_way.size()));
    std::vector<TableColumn> columns;
    for (const auto* half : {&both, &one_way}) {
        if (half->empty()) continue; // a reduced list has no second half
        if (!columns.empty()) {
            columns.push_back({"", ""}); // a gap between the halves
            for (TableRow& row : rows)
                row.emplace_back();
        }
        columns.insert(columns.end(),
                       {{"", "", Align::left},
                        {"Parameter", "", Align::left},
                        {"Value, " + units.deviation, "", Align::right},
                        {uncertainty_head(certificate.uncertainty), "", Align::left}});
        for (std::size_t i = 0; i < rows.size(); ++i)
            append_cells(rows[i], *half, i, units, certificate.uncertainty);
    }
    sheet.advance(3);
    sheet.table(columns, rows, 7.5);
    sheet.advance(-1);
    for (const std::string& reason : reasons_not_evaluated(certificate.result))
        sheet.text(reason, {7.5, true});
    draw_uncertainty_notes(sheet, certificate);
}

void draw_sign_rule(Sheet& sheet, const Certificate& certificate) {
    std::string words =
        "Sign: deviation = actual − target; positive where the axis went too far towards + of its "
        "coordinate. Forward (↑) approaches come from smaller coordinates, backward (↓) from "
        "larger.";
    if (!certificate.deviations.backward().empty())
        words += " Reversal B\u1d62 and its mean B\u0304 = mean forward minus mean backward: "
                 "negative where each approach stops short (lost motion).";
    sheet.text(words, {7, false, grey});
}

} // namespace

std::vector<StatedField> draw_front_page(Sheet& sheet, const Certificate& certificate) {
    draw_title(sheet, certificate);
    auto shortened = draw_identity(sheet, certificate);
    draw_front_instruments(sheet, certificate.run.instruments, run_date_of(certificate.run),
                           shortened);
    draw_partial_notes(sheet, certificate);
    draw_parameters(sheet, certificate);
    draw_sign_rule(sheet, certificate);
    constexpr double largest_plot = 340;
    sheet.advance(6);
    const double room = sheet.remaining() - signature_height - 4;
    const PageBox plot{Sheet::left, sheet.y(), Sheet::width, std::min(room, largest_plot)};
    draw_deviation_plot(sheet.canvas(), plot, certificate);
    draw_signatures(sheet, certificate.run.statements,
                    {{"Run", stated(certificate.run.run_id)},
                     {"Run file SHA-256", stated(certificate.run_file_sha256)},
                     {"Result SHA-256", stated(certificate.result_digest)},
                     {"Software", "axiscal, version " + stated(certificate.run.software_version)}},
                    certificate.run.imported ? traced_by_nobody : traced_by_instruments);
    return shortened;
}

} // namespace axiscal
