#include "analysis/conformity/conformity.hpp"

#include "analysis/quantity/quantity.hpp"

#include <cmath>
#include <utility>

namespace axiscal {
namespace {

double share_of_limit(const JudgedFigure& figure) {
    if (!figure.value || !figure.limit) return 0;
    return (std::fabs(*figure.value) + figure.guard_band.value_or(0)) / *figure.limit;
}

/// How many units of the limits make one of the figures.
double limits_per(const std::string& unit, const std::string& of_limits) {
    if (unit == of_limits) return 1;
    if (unit == "um/m") return 1e-6 / arcsec.size; // limits in "arcsec"
    return unit == "deg" ? 3600 : 1000;
}

} // namespace

const JudgedFigure* Conformity::decisive() const {
    const JudgedFigure* found = nullptr;
    for (const JudgedFigure& figure : figures) {
        if (figure.verdict != verdict) continue;
        if (!found || share_of_limit(figure) > share_of_limit(*found)) found = &figure;
    }
    return found;
}

std::optional<Conformity> conformity_of(const std::optional<ToleranceRecord>& agreed,
                                        const std::vector<FigureToJudge>& figures,
                                        std::string unit,
                                        double travel) {
    if (!agreed) return std::nullopt;
    std::vector<ToleranceLimit> limits = agreed->limits;
    for (ToleranceLimit& limit : limits)
        limit.limit /= limits_per(unit, agreed->unit);
    Conformity conformity{*agreed, std::move(unit), {}, {}};
    conformity.figures = judge_figures(limits, figures, travel, agreed->rule);
    conformity.verdict = overall_verdict(conformity.figures);
    return conformity;
}

} // namespace axiscal
