#include "analysis/probing/probing_delay.hpp"

#include "analysis/probing/tooth_period.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr double largest = 1e12;

double span_of(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
}

Result<void> check_numbers(const std::vector<double>& values, const std::string& field) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!(std::fabs(values[i]) <= largest))
            return refuse(Fault::bad_case, field + "[" + std::to_string(i) + "]",
                          "is not finite or larger than 1e12");
    return {};
}

double length_of(const std::array<double, 3>& v) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

Result<void>
check_series(const ProbingSeries& series, std::size_t required, const std::string& field) {
    const std::size_t touches = series.trigger_mm.size();
    if (touches == 0) return refuse(Fault::bad_case, field + ".trigger_mm", "is empty");
    if (series.approach_mm.size() != touches)
        return refuse(Fault::bad_case, field + ".approach_mm", "must have one number a touch");
    if (touches < required)
        return refuse(Fault::bad_case, field + ".trigger_mm",
                      "has fewer touches than required_touches");
    AXISCAL_CHECK(check_numbers(series.approach_mm, field + ".approach_mm"));
    AXISCAL_CHECK(check_numbers(series.trigger_mm, field + ".trigger_mm"));
    AXISCAL_CHECK(
        check_numbers({series.direction.begin(), series.direction.end()}, field + ".direction"));
    if (!(length_of(series.direction) > 1e-100))
        return refuse(Fault::bad_case, field + ".direction", "must not have the length 0");
    if (series.reference && span_of(series.approach_mm) > 1e-3)
        return refuse(Fault::bad_case, field + ".approach_mm",
                      "must be constant in a reference series");
    return {};
}

std::string symbol_of(const ProbingSeries& series) {
    if (!series.symbol.empty()) return series.symbol;
    std::string axes;
    for (std::size_t i = 0; i < 3; ++i)
        if (series.direction[i] != 0) axes += static_cast<char>('X' + i);
    return (series.reference ? "E_0," : "E_TD,") + axes;
}

double standard_deviation(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double value : values)
        mean += (value - values[0]) / static_cast<double>(values.size());
    for (const double value : values)
        squares += (value - values[0] - mean) * (value - values[0] - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

void add_period(const ProbingSeries& series, double feed_mm_per_ms, ProbingDelay& result) {
    if (series.reference) {
        result.no_period = "the approach distance of a reference series does not vary";
        return;
    }
    const auto tooth = find_tooth(series.approach_mm, series.trigger_mm);
    if (!tooth) {
        result.no_period = tooth.error().detail;
        return;
    }
    result.period_ms = tooth->period / feed_mm_per_ms;
    result.period_standard_uncertainty_ms = tooth->standard_uncertainty / feed_mm_per_ms;
    result.tooth_slope = tooth->slope;
    result.tooth_residual_mm = tooth->residual_rms;
}

ProbingDelay evaluate(const ProbingSeries& series, double feed_mm_per_ms) {
    ProbingDelay result;
    result.symbol = symbol_of(series);
    const double length = length_of(series.direction);
    for (std::size_t i = 0; i < 3; ++i)
        result.unit_direction[i] = series.direction[i] / length;
    result.touches = series.trigger_mm.size();
    result.reference = series.reference;
    result.variation_mm = span_of(series.trigger_mm);
    result.variation_ms = result.variation_mm / feed_mm_per_ms;
    if (result.touches > 1) result.standard_deviation_mm = standard_deviation(series.trigger_mm);
    add_period(series, feed_mm_per_ms, result);
    return result;
}

void add_reference(const std::vector<ProbingDelay>& all, ProbingDelay& result) {
    for (const ProbingDelay& other : all)
        if (other.reference && same_direction(other, result))
            result.reference_repeatability_mm =
                std::max(result.reference_repeatability_mm.value_or(0), other.variation_mm);
    if (!result.reference_repeatability_mm) return;
    const double total = result.variation_mm, own = *result.reference_repeatability_mm;
    if (total >= own) result.net_variation_mm = std::sqrt((total - own) * (total + own));
}

} // namespace

bool same_direction(const ProbingDelay& a, const ProbingDelay& b) {
    double product = 0;
    for (std::size_t i = 0; i < 3; ++i)
        product += a.unit_direction[i] * b.unit_direction[i];
    return product > 1 - 1e-9;
}

Result<std::vector<ProbingDelay>> evaluate_probing_delay(const ProbingDelayCase& stated) {
    // below 1e-6 mm/min a millisecond has no meaning any more
    if (!(stated.feed_mm_per_min >= 1e-6 && stated.feed_mm_per_min <= largest))
        return refuse(Fault::bad_case, "feed_mm_per_min", "must be above 0");
    if (stated.series.empty()) return refuse(Fault::bad_case, "series", "is empty");
    const double feed_mm_per_ms = stated.feed_mm_per_min / 60000;
    std::vector<ProbingDelay> results;
    for (std::size_t i = 0; i < stated.series.size(); ++i) {
        AXISCAL_CHECK(check_series(stated.series[i], stated.required_touches,
                                   "series[" + std::to_string(i) + "]"));
        results.push_back(evaluate(stated.series[i], feed_mm_per_ms));
    }
    for (ProbingDelay& result : results)
        if (!result.reference) add_reference(results, result);
    return results;
}

} // namespace axiscal
