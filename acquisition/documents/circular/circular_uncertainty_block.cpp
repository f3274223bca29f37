// The uncertainty budget of a circular test as a reader checks it. Micrometres.

#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

std::string of_length(double u_mm) {
    return uncertainty_on_paper(u_mm * um_per_mm);
}

struct TermOnPaper {
    const char *term, *name, *counts;
};
constexpr std::array terms{
    TermOnPaper{"device", "Transducer over the range of one test", "G, F"},
    TermOnPaper{"repeatability", "Repeatability", "G, F, D"},
    TermOnPaper{"environment", "Drift E_VE", "G, F, D"},
    TermOnPaper{"calibration", "Calibration of the bar's length", "F, D"},
    TermOnPaper{"machine_temperature", "Temperature of the machine", "F, D"},
    TermOnPaper{"bar_temperature", "Temperature of the bar", "F, D"},
    TermOnPaper{"machine_expansion", "Expansion coefficient of the machine", "F, D"},
    TermOnPaper{"bar_expansion", "Expansion coefficient of the bar", "F, D"},
    TermOnPaper{"centre", "Set-up centre", "F about it"}};

void draw_terms(Sheet& sheet, const CircularCertificate& certificate) {
    const CircularBudget& budget = *certificate.budget;
    std::vector<TableRow> rows;
    for (const TermOnPaper& term : terms) {
        const auto known =
            std::ranges::find(budget.contributions, term.term, &CircularContribution::term);
        if (known == budget.contributions.end())
            rows.push_back({term.name, certificate.needs(term.term) ? "not stated" : "not needed",
                            "–", term.counts, "–"});
        else
            rows.push_back({term.name, of_length(known->u_mm), formula_on_paper(known->formula),
                            term.counts, footnote_sign(known->status)});
    }
    sheet.table({{"Term", "", Align::left},
                 {"u", "µm"},
                 {"Formula", "", Align::left, true},
                 {"Counts in", "", Align::left},
                 {"Note", "", Align::left}},
                rows, 7);
    for (const CircularContribution& known : budget.contributions)
        if (!known.source.empty())
            sheet.text("E_VE is the range of the drift test " + known.source + ".", note_style);
}

void draw_figure_uncertainties(Sheet& sheet, const CircularCertificate& certificate) {
    std::vector<TableRow> rows;
    for (const CircularFigureLine& line : figure_lines(certificate)) {
        const CircularFigureUncertainty* known = certificate.uncertainty_of(line.key);
        if (!known) {
            rows.push_back({line.symbol + " " + line.index, "not evaluated", "–", "–"});
            continue;
        }
        rows.push_back({line.symbol + " " + line.index, of_length(known->u_mm),
                        known->monte_carlo_u_mm ? of_length(*known->monte_carlo_u_mm) : "–",
                        of_length(known->expanded_mm)});
    }
    sheet.table({{"Figure", "", Align::left},
                 {"u by formula", "µm"},
                 {"u simulated", "µm"},
                 {"U = " + compact_number(certificate.budget->coverage) + " u", "µm"}},
                rows, 7);
}

} // namespace

void draw_circular_uncertainty(Sheet& sheet, const CircularCertificate& certificate) {
    const auto& budget = certificate.budget;
    sheet.heading("Measurement uncertainty", budget ? 150 : 30);
    if (!budget) {
        std::string missing;
        for (const MissingTerm& term : certificate.missing)
            missing += (missing.empty() ? "" : "; ") + term.words;
        sheet.text("Not evaluated: the budget lacks " + missing + ".", {7.5});
        return;
    }
    sheet.text("n = " + std::to_string(budget->runs) +
                   (budget->runs == 1 ? " circle" : " circles") +
                   " of each sense. u(G) = √(u² transducer + (u² repeatability + u² drift) / n); "
                   "u(D) adds calibration, temperatures and expansion and leaves the transducer "
                   "out; u(F) is both together, about the set-up centre with its own u.",
               {7.5});
    draw_terms(sheet, certificate);
    draw_figure_uncertainties(sheet, certificate);
    std::string words = "The terms above hold 1/√n already. Full widths are those of rectangular "
                        "distributions (JCGM 100, 4.3.7). U is rounded up on page 1.";
    if (has_footnote_sign(budget->contributions)) words += " " + std::string{footnote_of_derived};
    if (budget->trials > 0)
        words += " u simulated: " + std::to_string(budget->trials) +
                 " trials that disturb every reading and evaluate anew (JCGM 101); drift runs "
                 "along the trace there and comes out smaller.";
    sheet.text(words, note_style);
}

} // namespace axiscal
