#include "analysis/probing/probing_delay.hpp"

#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"

#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

Result<bool> flag_of(const json& object, const std::string& key, const std::string& field) {
    if (!object.contains(key)) return false;
    if (!object.at(key).is_boolean())
        return refuse(Fault::bad_case, field, "must be true or false");
    return object.at(key).get<bool>();
}

/// Coordinates along the direction, from whole points: q = sum u_a X_a.
Result<std::vector<double>> along_direction(const json& array,
                                            const std::array<double, 3>& direction,
                                            const std::string& field) {
    AXISCAL_TRY(const Rows points, rows_of(array, field));
    const double length = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                                    direction[2] * direction[2]);
    if (!(length > 1e-100)) return refuse(Fault::bad_case, field, "needs a direction");
    std::vector<double> along;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].size() != 3)
            return refuse(Fault::bad_case, indexed(field, i), "must be [x,y,z]");
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum += direction[axis] / length * points[i][axis];
        along.push_back(sum);
    }
    return along;
}

Result<ProbingSeries> series_of(const json& object, const std::string& field) {
    AXISCAL_CHECK(check_object(
        object, field,
        {"direction", "approach_mm", "trigger_mm", "trigger_points_mm", "reference", "symbol"}));
    ProbingSeries series;
    AXISCAL_TRY(const std::vector<double> direction,
                numbers_at(object, "direction", field + ".direction"));
    if (direction.size() != 3)
        return refuse(Fault::bad_case, field + ".direction", "must be three numbers");
    series.direction = {direction[0], direction[1], direction[2]};
    AXISCAL_TRY(series.approach_mm, numbers_at(object, "approach_mm", field + ".approach_mm"));
    const std::string points = field + ".trigger_points_mm";
    if (!object.contains("trigger_points_mm")) {
        AXISCAL_TRY(series.trigger_mm, numbers_at(object, "trigger_mm", field + ".trigger_mm"));
    } else if (object.contains("trigger_mm")) {
        return refuse(Fault::bad_case, points, "cannot stand beside trigger_mm");
    } else {
        AXISCAL_TRY(series.trigger_mm,
                    along_direction(object.at("trigger_points_mm"), series.direction, points));
    }
    AXISCAL_TRY(series.reference, flag_of(object, "reference", field + ".reference"));
    if (object.contains("symbol")) {
        AXISCAL_TRY(series.symbol, text_of(object, "symbol", field + ".symbol"));
    }
    return series;
}

Result<ProbingDelayCase> stated_probing(const json& object) {
    AXISCAL_CHECK(
        check_object(object, "", {"analysis", "feed_mm_per_min", "series", "required_touches"}));
    ProbingDelayCase stated;
    AXISCAL_TRY(stated.feed_mm_per_min, number_at(object, "feed_mm_per_min", "feed_mm_per_min"));
    AXISCAL_TRY(const double required,
                number_or(object, "required_touches", "required_touches", 1));
    if (!(required >= 1 && required <= 1e6) || required != std::floor(required))
        return refuse(Fault::bad_case, "required_touches", "must be a whole number above 0");
    stated.required_touches = static_cast<std::size_t>(required);
    AXISCAL_TRY(const json* list, member(object, "series", "series"));
    if (!list->is_array()) return refuse(Fault::bad_case, "series", "must be an array");
    for (std::size_t i = 0; i < list->size(); ++i) {
        AXISCAL_TRY(ProbingSeries series, series_of((*list)[i], indexed("series", i)));
        stated.series.push_back(std::move(series));
    }
    return stated;
}

void add_reasons(const ProbingDelay& result, ordered_json& out) {
    ordered_json reasons = ordered_json::object();
    if (!result.standard_deviation_mm) reasons["standard_deviation_mm"] = "one touch has no spread";
    if (!result.period_ms) reasons["period_ms"] = result.no_period;
    if (!result.reference && !result.net_variation_mm)
        reasons["net_variation_mm"] =
            result.reference_repeatability_mm
                ? "the reference repeatability is larger than the variation"
                : "no series of this direction is marked as reference";
    out["not_evaluated"] = std::move(reasons);
}

ordered_json series_to_json(const ProbingDelay& result) {
    ordered_json out;
    out["symbol"] = result.symbol;
    out["direction"] = result.unit_direction;
    out["touches"] = result.touches;
    out["reference"] = result.reference;
    out["variation_mm"] = result.variation_mm;
    out["variation_ms"] = result.variation_ms;
    const auto add = [&](const char* key, const auto& value) {
        if (value) out[key] = *value;
    };
    add("standard_deviation_mm", result.standard_deviation_mm);
    add("period_ms", result.period_ms);
    add("period_standard_uncertainty_ms", result.period_standard_uncertainty_ms);
    add("tooth_slope", result.tooth_slope);
    add("tooth_residual_mm", result.tooth_residual_mm);
    add("reference_repeatability_mm", result.reference_repeatability_mm);
    add("net_variation_mm", result.net_variation_mm);
    add_reasons(result, out);
    return out;
}

} // namespace

Result<ordered_json> probing_delay_case(const json& object) {
    AXISCAL_TRY(const ProbingDelayCase stated, stated_probing(object));
    AXISCAL_TRY(const auto results, evaluate_probing_delay(stated));
    ordered_json out;
    out["format"] = "axiscal.result/1";
    out["analysis"] = "probing_delay";
    out["standard"] = "ISO 230-10 clause 6.9, counts, steps and symbols reconstructed";
    out["feed_mm_per_min"] = stated.feed_mm_per_min;
    out["feed_mm_per_ms"] = stated.feed_mm_per_min / 60000;
    for (const ProbingDelay& result : results)
        out["series"].push_back(series_to_json(result));
    out["remarks"] = {
        "what varies is the delay; its constant part is in the effective stylus diameter",
        "480 mm/min is 8 mm/s, 0.008 mm a millisecond: the source's mm/us is a slip of units",
        "net_variation_mm is for information only"};
    return out;
}

} // namespace axiscal
