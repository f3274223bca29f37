#include "analysis/positioning/tolerances.hpp"

#include "analysis/uncertainty/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// Travels are written in decimals.
constexpr double rounding = 1e-6;

JudgedFigure judge_one(const FigureToJudge& figure, const ToleranceLimit* limit) {
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
    if (!figure.expanded_uncertainty)
        judged.reason = "U not evaluated";
    else
        judged.verdict = name_of(verdict_of(value, limit->limit, *figure.expanded_uncertainty));
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
                                        double travel) {
    std::vector<JudgedFigure> judged;
    for (const ToleranceLimit& limit : limits) {
        if (std::ranges::find(judged, limit.parameter, &JudgedFigure::parameter) != judged.end())
            continue;
        const auto figure = std::ranges::find(figures, limit.parameter, &FigureToJudge::parameter);
        judged.push_back(
            judge_one(figure == figures.end() ? FigureToJudge{limit.parameter, {}, {}} : *figure,
                      limit_for(limits, limit.parameter, travel)));
    }
    return judged;
}

} // namespace axiscal
