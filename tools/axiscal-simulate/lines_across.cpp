#include "lines_across.hpp"

#include "injected_process.hpp"
#include "laser_count.hpp"
#include "simulated_machine.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace axiscal::simulate {

double width_along(const LineAcross& x, const LineAcross& y, double slope) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < x.size(); ++i) {
        low = std::min(low, y[i] - slope * x[i]);
        high = std::max(high, y[i] - slope * x[i]);
    }
    return high - low;
}

double mean_of_line(const LineAcross& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double slope_of_end_points(const LineAcross& x, const LineAcross& y) {
    return (y.back() - y.front()) / (x.back() - x.front());
}

double slope_of_least_squares(const LineAcross& x, const LineAcross& y) {
    const double mean_x = mean_of_line(x), mean_y = mean_of_line(y);
    double products = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        products += (x[i] - mean_x) * (y[i] - mean_y);
    return products / spread_of(x).squares;
}

double slope_of_least_zone(const LineAcross& x, const LineAcross& y) {
    double best = slope_of_end_points(x, y), least = width_along(x, y, best);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            const double slope = (y[j] - y[i]) / (x[j] - x[i]), width = width_along(x, y, slope);
            if (width < least) best = slope, least = width;
        }
    return best;
}

SpreadOfPlaces spread_of(const LineAcross& x) {
    const double mean = mean_of_line(x);
    SpreadOfPlaces spread;
    for (const double place : x) {
        spread.squares += (place - mean) * (place - mean);
        spread.distances += std::abs(place - mean);
    }
    return spread;
}

LineAcross motion_across(const Scenario& across, const LineAcross& x, int direction) {
    const TrueErrors errors{across.errors};
    LineAcross line;
    for (const double target : x)
        line.push_back(errors.deviation_um(target, direction));
    return line;
}

LineAcross form_of_mirror(const ErrorScenario& mirror, const LineAcross& x) {
    const TrueErrors errors{mirror};
    LineAcross form;
    for (const double target : x)
        form.push_back(errors.pitch_um(target));
    return form;
}

AcrossTerms terms_across(const Scenario& scenario, const Scenario& across, const TruthPlan& plan) {
    const ErrorScenario& errors = across.errors;
    AcrossTerms terms;
    terms.sigma = std::hypot(
        capture_sigma_um(across),
        errors.vibration_um / (std::numbers::pi * scenario.truth.window_s * errors.vibration_hz));
    terms.z = std::sqrt(2.0 * std::log(2.0 * static_cast<double>(plan.targets_mm.size()) / 0.001));
    terms.count = count_um(scenario.laser) * scenario.straightness->factor;
    terms.drift = std::abs(errors.drift_um_per_hour) * scenario.truth.duration_s / 3600.0;
    return terms;
}

} // namespace axiscal::simulate
