#include "analysis/conformity/tolerances.hpp"

#include "analysis/conformity/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// Travels are written in decimals.
constexpr double rounding = 1e-6;

/// Why the rule decides nothing; empty: it does.
std::string why_undecided(DecisionRule rule, const FigureToJudge& figure) {
    if (rule == DecisionRule::none) return "no decision rule is stated";
    if (rule != DecisionRule::simple && !figure.expanded_uncertainty) return "U not evaluated";
    return {};
}

JudgedFigure
judge_one(const FigureToJudge& figure, const ToleranceLimit* limit, DecisionRule rule) {
    JudgedFigure judged;
    judged.parameter = figure.parameter;
    judged.value = figure.value;
    judged.expanded_uncertainty = figure.expanded_uncertainty;
    if (limit) {
        judged.limit = limit->limit;
        judged.travel_up_to = limit->travel_up_to;
    }
    if (!figure.value) {
        judged.reason = "the figure was not evaluated";
        return judged;
    }
    if (!limit) {
        judged.reason = "the travel is longer than every band";
        return judged;
    }
    const double value = std::fabs(*figure.value);
    judged.comparison = value <= limit->limit ? "within_limit" : "beyond_limit";
    judged.reason = why_undecided(rule, figure);
    if (!judged.reason.empty()) return judged;
    judged.guard_band =
        guard_band_of(rule, figure.expanded_uncertainty.value_or(0), figure.coverage);
    judged.verdict = name_of(verdict_of(value, limit->limit, *judged.guard_band));
    return judged;
}

} // namespace

const ToleranceLimit*
limit_for(const std::vector<ToleranceLimit>& limits, std::string_view parameter, double travel) {
    const ToleranceLimit* best = nullptr;
    for (const ToleranceLimit& limit : limits) {
        if (limit.parameter != parameter) continue;
        if (limit.travel_up_to && travel > *limit.travel_up_to + rounding) continue;
        const bool nearer =
            !best || (limit.travel_up_to &&
                      (!best->travel_up_to || *limit.travel_up_to < *best->travel_up_to));
        if (nearer) best = &limit;
    }
    return best;
}

std::vector<JudgedFigure> judge_figures(const std::vector<ToleranceLimit>& limits,
                                        const std::vector<FigureToJudge>& figures,
                                        double travel,
                                        DecisionRule rule) {
    std::vector<JudgedFigure> judged;
    for (const ToleranceLimit& limit : limits) {
        if (std::ranges::find(judged, limit.parameter, &JudgedFigure::parameter) != judged.end())
            continue;
        const auto figure = std::ranges::find(figures, limit.parameter, &FigureToJudge::parameter);
        judged.push_back(
            judge_one(figure == figures.end() ? FigureToJudge{limit.parameter, {}, {}} : *figure,
                      limit_for(limits, limit.parameter, travel), rule));
    }
    return judged;
}

std::string_view overall_verdict(std::span<const JudgedFigure> judged) {
    for (const std::string_view worst : {"fail", "not_provable", "not_evaluated", "pass"})
        if (std::ranges::find(judged, worst, &JudgedFigure::verdict) != judged.end()) return worst;
    return {};
}

} // namespace axiscal
