#include "acquisition/documents/pdf/conformity_block.hpp"

#include "acquisition/documents/pdf/wording.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace axiscal {
namespace {

using SymbolOf = std::function<std::string(std::string_view)>;

struct VerdictWord {
    std::string_view verdict, word;
};
constexpr std::array verdict_words{VerdictWord{"pass", "PASS"}, VerdictWord{"fail", "FAIL"},
                                   VerdictWord{"not_provable", "NOT PROVABLE"},
                                   VerdictWord{"not_evaluated", "NO VERDICT"}};

std::string word_of(std::string_view verdict) {
    const auto* found = std::ranges::find(verdict_words, verdict, &VerdictWord::verdict);
    return std::string{found == verdict_words.end() ? "NO VERDICT" : found->word};
}

/// From the unit of the figures to that of paper: micrometres, seconds of arc, or um/m as it is.
double paper_factor(const std::string& unit) {
    if (unit == "mm") return 1000;
    return unit == "deg" ? 3600 : 1;
}

std::string paper_unit(const std::string& unit) {
    if (unit == "um/m") return "µm/m";
    return unit == "deg" || unit == "arcsec" ? "″" : "µm";
}

std::string rule_text(DecisionRule rule) {
    switch (rule) {
    case DecisionRule::none:
        return "No decision rule was agreed on: no verdict is stated (ISO/IEC 17025:2017, 7.8.6).";
    case DecisionRule::iso_14253_1_2017:
        return "Decision rule: ISO 14253-1:2017; pass and fail are each proven with a probability "
               "of 95 %, the guard band is 0.822 U (k = 2).";
    case DecisionRule::guard_U:
        return "Decision rule: guard band U (ISO 14253-1); pass: value + U does not exceed the "
               "limit; fail: value − U exceeds it.";
    case DecisionRule::simple:
        return "Decision rule: simple acceptance; the value is compared with the limit, its "
               "uncertainty is not taken into account.";
    }
    return {};
}

std::string reason_text(const JudgedFigure& figure) {
    return figure.reason.empty() ? std::string{} : ": " + figure.reason;
}

std::string band_text(const JudgedFigure& figure, const std::string& unit) {
    if (!figure.travel_up_to) return "any travel";
    return "travel to " + as_stated(*figure.travel_up_to) + (unit == "deg" ? "°" : " mm");
}

TableRow
row_of(const JudgedFigure& figure, const Conformity& conformity, const SymbolOf& symbol_of) {
    const double factor = paper_factor(conformity.unit);
    constexpr int decimals = 2;
    const auto on_paper = [&](const std::optional<double>& value) {
        return value ? fixed(*value * factor, decimals) : std::string{"–"};
    };
    const auto& U = figure.expanded_uncertainty;
    return {symbol_of(figure.parameter),
            on_paper(figure.value),
            U ? "± " + fixed_up(*U * factor, decimals) : "U not evaluated",
            on_paper(figure.limit),
            figure.limit ? band_text(figure, conformity.unit) : std::string{"–"},
            figure.guard_band ? fixed_up(*figure.guard_band * factor, decimals) : std::string{"–"},
            word_of(figure.verdict) + reason_text(figure)};
}

} // namespace

std::string verdict_on_paper(const std::optional<Conformity>& conformity,
                             const SymbolOf& symbol_of) {
    if (!conformity) return "No limits agreed: no verdict";
    constexpr int most_named = 4;
    const std::string word = word_of(conformity->verdict);
    if (conformity->verdict == "pass") return word;
    std::string names;
    int named = 0;
    for (const JudgedFigure& figure : conformity->figures) {
        if (figure.verdict != conformity->verdict || ++named > most_named) continue;
        names += (names.empty() ? "" : ", ") + symbol_of(figure.parameter);
    }
    return word + ": " + names + (named > most_named ? ", …" : "");
}

void draw_conformity(Sheet& sheet,
                     const std::optional<Conformity>& conformity,
                     const SymbolOf& symbol_of) {
    if (!conformity) return;
    const ToleranceRecord& agreed = conformity->agreed;
    sheet.heading("Limits and verdicts");
    const std::string unit = paper_unit(conformity->unit);
    std::vector<TableRow> rows;
    for (const JudgedFigure& figure : conformity->figures)
        rows.push_back(row_of(figure, *conformity, symbol_of));
    sheet.table({{"Figure", "", Align::left},
                 {"Value", unit},
                 {"Uncertainty", unit, Align::left},
                 {"Limit", unit},
                 {"holds for", "", Align::left},
                 {"Guard band", unit},
                 {"Verdict", "", Align::left, true}},
                rows);
    sheet.text("Limits: " + agreed.name + "; source: " + agreed.source + ". " +
                   rule_text(agreed.rule),
               note_style);
    if (agreed.to_be_checked)
        sheet.text("These limits were not compared with their source: to be checked.",
                   {7.5, true, backward_vermilion});
}

} // namespace axiscal
