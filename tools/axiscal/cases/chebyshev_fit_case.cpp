#include "analysis/separation/chebyshev_fit.hpp"

#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"

#include <cmath>

namespace axiscal {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

struct Case {
    std::vector<double> x, y;
    std::size_t degree = 1;
    AxisRange range;
};

Result<Case> stated_fit(const json& object) {
    AXISCAL_CHECK(check_object(object, "", {"analysis", "x", "y", "degree", "range"}));
    Case stated;
    AXISCAL_TRY(stated.x, numbers_at(object, "x", "x"));
    AXISCAL_TRY(stated.y, numbers_at(object, "y", "y"));
    AXISCAL_TRY(const double degree, number_at(object, "degree", "degree"));
    if (!(degree >= 1 && degree <= 32) || degree != std::floor(degree))
        return refuse(Fault::bad_case, "degree", "must be a whole number from 1 to 32");
    stated.degree = static_cast<std::size_t>(degree);
    if (!object.contains("range")) {
        if (stated.x.empty()) return refuse(Fault::bad_case, "x", "is empty");
        const auto [low, high] = std::ranges::minmax(stated.x);
        stated.range = {low, high};
        return stated;
    }
    AXISCAL_TRY(const std::vector<double> range, numbers_at(object, "range", "range"));
    if (range.size() != 2) return refuse(Fault::bad_case, "range", "must be [from, to]");
    stated.range = {range[0], range[1]};
    return stated;
}

} // namespace

Result<ordered_json> chebyshev_fit_case(const json& object) {
    AXISCAL_TRY(const Case stated, stated_fit(object));
    AXISCAL_TRY(const ChebyshevFit fit,
                fit_chebyshev(stated.x, stated.y, stated.degree, stated.range));
    ordered_json out;
    out["format"] = "axiscal.result/1";
    out["analysis"] = "chebyshev_fit";
    out["degree"] = stated.degree;
    out["range"] = {fit.range.from, fit.range.to};
    out["points"] = stated.x.size();
    out["first_kind"] = fit.first_kind;
    out["second_kind"] = fit.second_kind;
    out["method"] = fit.by_moments ? "moments" : "qr";
    out["rank"] = fit.rank;
    out["residual_rms"] = residual_rms(fit, stated.x, stated.y);
    out["not_evaluated"] = ordered_json::object();
    if (fit.gram_condition)
        out["gram_condition"] = *fit.gram_condition;
    else
        out["not_evaluated"]["gram_condition"] = "the points leave the degree open: singular";
    return out;
}

} // namespace axiscal
