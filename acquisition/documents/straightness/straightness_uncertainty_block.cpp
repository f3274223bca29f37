#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_pages.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

const char* term_on_paper(StraightnessTerm term) {
    switch (term) {
    case StraightnessTerm::factor: return "Factor of the optics";
    case StraightnessTerm::mirror: return "Form of the bisecting mirror";
    case StraightnessTerm::angle: return "Each angle";
    case StraightnessTerm::base: return "Base of the foot";
    case StraightnessTerm::resolution: return "Least step of a reading";
    case StraightnessTerm::environment: break;
    }
    return "Environment";
}

/// Of the mean line: a row a term, a column a reference line.
void draw_straightness_terms(Sheet& sheet, const BudgetedLine& line) {
    const auto& all = line.budget.by_reference;
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < all.front().contributions.size(); ++i) {
        const StraightnessContribution& part = all.front().contributions[i];
        TableRow cells{term_on_paper(part.term)};
        for (const StraightnessUncertainty& against : all)
            cells.push_back(uncertainty_on_paper(against.contributions[i].u_um));
        cells.push_back(formula_on_paper(part.formula));
        rows.push_back(std::move(cells));
    }
    TableRow combined{"U = " + fixed(line.budget.coverage, 0) + " u"};
    for (const StraightnessUncertainty& against : all)
        combined.push_back(against.expanded_um ? uncertainty_on_paper(*against.expanded_um)
                                               : "not evaluated");
    combined.emplace_back("root of the sum of squares");
    rows.push_back(std::move(combined));
    sheet.table({{"u of the straightness from", "", Align::left},
                 {"End points", "µm"},
                 {"Least squares", "µm"},
                 {"Minimum zone", "µm"},
                 {"Formula", "", Align::left, true}},
                rows);
}

void draw_legend_of_terms(Sheet& sheet, const StraightnessResult& result) {
    std::string words =
        "P: the straightness; f: the factor; a: the limit of the mirror's form over a length M, "
        "times M²; L: the measured length; b: the base of the foot; q: the least step; s: the "
        "scatter of the readings; N: readings in each mean; w and g: how P changes with the "
        "deviation at a target, or behind a step. Every term is derived here from the "
        "distributions of ISO/TR 230-9; no annex of ISO 230-1 gives a budget.";
    if (result.mean().budget.by_scatter)
        words += " The readings scatter more than E_VE says: their s is taken.";
    sheet.text(words, note_style);
    sheet.text("Does not apply: dead path, expansion of the axis (below 1e-4 of P), uncertainty of "
               "the laser for each metre, slope of the optics, which every reference takes out.",
               note_style);
}

/// Whether the closed form stands where the readings are what they are.
void draw_trials_of_straightness(Sheet& sheet, const StraightnessResult& result) {
    const auto closed_um = independent_u_um(result);
    if (!result.tried || !closed_um) return;
    const TriedFigure& tried = result.tried->by_reference[static_cast<std::size_t>(main_reference)];
    constexpr double told_from = 0.2;
    std::string words = "What errs at each reading by itself, in " +
                        std::to_string(result.tried->trials) + " trials (seed " +
                        std::to_string(result.tried->seed) +
                        "): u = " + uncertainty_on_paper(tried.u_um) + " µm, by the closed form " +
                        uncertainty_on_paper(*closed_um) + " µm.";
    if (std::fabs(tried.u_um - *closed_um) > told_from * *closed_um)
        words += " They part by more than 20 %: a line as straight as its noise is found less "
                 "straight than it is, and its u is smaller. U is by the closed form.";
    sheet.text(words, note_style);
}

void draw_slopes(Sheet& sheet, const StraightnessResult& result) {
    constexpr double um_per_m = 1e6;
    std::vector<TableRow> rows;
    for (const BudgetedLine& line : result.lines) {
        TableRow cells{std::string{line.name}};
        for (const LineReference reference : line_references)
            cells.push_back(fixed(line_against(line.found.against, reference).slope * um_per_m, 2));
        rows.push_back(std::move(cells));
    }
    sheet.heading("Slope of the lines");
    sheet.table({{"Line", "", Align::left},
                 {"End points", "µm/m"},
                 {"Least squares", "µm/m"},
                 {"Minimum zone", "µm/m"}},
                rows);
    sheet.text("The slope is that of this set-up between optics and axis, no property of the axis.",
               note_style);
}

} // namespace

void draw_straightness_uncertainty(Sheet& sheet, const StraightnessResult& result) {
    sheet.new_page();
    draw_conformity(sheet, result.conformity, straightness_name_on_paper);
    sheet.heading("Measurement uncertainty", 120);
    const std::string missing = missing_on_paper(result.mean().budget.not_stated);
    if (!missing.empty())
        sheet.text("U is not evaluated: the budget lacks " + missing + ".", {7.5, true});
    draw_straightness_terms(sheet, result.mean());
    draw_legend_of_terms(sheet, result);
    draw_trials_of_straightness(sheet, result);
    draw_slopes(sheet, result);
}

} // namespace axiscal
