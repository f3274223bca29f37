#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/squareness/squareness_pages.hpp"
#include "acquisition/documents/squareness/squareness_wording.hpp"

namespace axiscal {
namespace {

const char* square_term_on_paper(SquarenessTerm term) {
    switch (term) {
    case SquarenessTerm::factor: return "Factor of the optics";
    case SquarenessTerm::mirror: return "Form of the bisecting mirror";
    case SquarenessTerm::square: return "Error of the square";
    case SquarenessTerm::mount: return "Mirror and square against each other";
    case SquarenessTerm::resolution: return "Least step of a reading";
    case SquarenessTerm::environment: break;
    }
    return "Environment";
}

void draw_squareness_terms(Sheet& sheet, const SquarenessBudget& budget) {
    std::vector<TableRow> rows;
    for (const SquarenessContribution& part : budget.contributions)
        rows.push_back({square_term_on_paper(part.term),
                        uncertainty_on_paper(part.u_rad * um_per_m_of_rad),
                        formula_on_paper(part.formula)});
    rows.push_back({"U = " + fixed(budget.coverage, 0) + " u",
                    budget.expanded_rad
                        ? uncertainty_on_paper(*budget.expanded_rad * um_per_m_of_rad)
                        : "not evaluated",
                    "root of the sum of squares"});
    sheet.table({{"u of the squareness from", "", Align::left},
                 {"Least squares", "µm/m"},
                 {"Formula", "", Align::left, true}},
                rows);
}

void draw_legend_of_square(Sheet& sheet, const SquarenessResult& result) {
    std::string words =
        "Of the slopes of the least squares lines. f: the factor; a: the limit of the mirror's "
        "form "
        "over a length M, times M²; L: the length of a line; x: its positions; Q: the sum of the "
        "squares of their distances from their mean; q: the least step; s: the scatter of the "
        "readings; N: readings in each mean; w: the weight of a line, 1, by reversal 1/2. Every "
        "term is derived here from the distributions of ISO/TR 230-9; no annex of ISO 230-1 gives "
        "a budget.";
    if (result.found.by_reversal)
        words += " By reversal the squareness is the mean of both positions of the square: its own "
                 "error is no part of it. The mirror's form is, in both positions alike.";
    if (result.budget.by_scatter)
        words += " The readings scatter more than E_VE says: their s is taken.";
    sheet.text(words, note_style);
    sheet.text(
        "Does not apply: dead path, expansion of the axes, uncertainty of the laser for each "
        "metre. Not in it: roll of the prism, pitch and yaw of the axes, the offset between "
        "the places of both lines.",
        note_style);
}

} // namespace

void draw_squareness_uncertainty(Sheet& sheet, const SquarenessResult& result) {
    sheet.new_page();
    draw_conformity(sheet, result.conformity, squareness_name_on_paper);
    sheet.heading("Measurement uncertainty", 120);
    const std::string missing = missing_on_paper(result.budget.not_stated);
    if (!missing.empty())
        sheet.text("U is not evaluated: the budget lacks " + missing + ".", {7.5, true});
    draw_squareness_terms(sheet, result.budget);
    draw_legend_of_square(sheet, result);
}

} // namespace axiscal
