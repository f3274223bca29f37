#include "analysis/setup/air_share.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace axiscal {
namespace {

/// Below this the air is too steady to tell whether a sensor follows it.
constexpr double telling_change_K = 0.03;
constexpr std::size_t fewest_readings = 10;

/// Residuals of a series about its own straight line, at its own times.
std::vector<double> residuals_of(const std::vector<double>& times,
                                 const std::vector<double>& readings) {
    const auto n = static_cast<double>(times.size());
    double mean_t = 0, mean_x = 0, tt = 0, tx = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        mean_t += times[i] / n, mean_x += readings[i] / n;
    for (std::size_t i = 0; i < times.size(); ++i) {
        tt += (times[i] - mean_t) * (times[i] - mean_t);
        tx += (times[i] - mean_t) * (readings[i] - mean_x);
    }
    const double slope = tt > 0 ? tx / tt : 0;
    std::vector<double> residuals;
    residuals.reserve(times.size());
    for (std::size_t i = 0; i < times.size(); ++i)
        residuals.push_back(readings[i] - mean_x - slope * (times[i] - mean_t));
    return residuals;
}

double value_at(const DriftSeries& series, double time) {
    const auto after = std::ranges::lower_bound(series.times, time);
    if (after == series.times.begin()) return series.readings.front();
    if (after == series.times.end()) return series.readings.back();
    const auto i = static_cast<std::size_t>(after - series.times.begin());
    const double share = (time - series.times[i - 1]) / (series.times[i] - series.times[i - 1]);
    return series.readings[i - 1] + share * (series.readings[i] - series.readings[i - 1]);
}

} // namespace

bool tells_no_share(const DriftSeries& series) {
    return series.times.size() < fewest_readings;
}

void AirShare::add_window(const DriftSeries& material_C, const DriftSeries& air_C) {
    if (tells_no_share(material_C) || tells_no_share(air_C)) return;
    std::vector<double> beside;
    beside.reserve(material_C.times.size());
    for (const double time : material_C.times)
        beside.push_back(value_at(air_C, time));
    const auto sensor = residuals_of(material_C.times, material_C.readings);
    const auto driver = residuals_of(material_C.times, beside);
    for (std::size_t i = 0; i < sensor.size(); ++i) {
        air_air_ += driver[i] * driver[i];
        air_material_ += driver[i] * sensor[i];
        material_material_ += sensor[i] * sensor[i];
    }
    n_ += sensor.size();
}

std::optional<double> AirShare::share(double least_correlation) const {
    if (n_ == 0 || material_material_ <= 0) return std::nullopt;
    if (std::sqrt(air_air_ / static_cast<double>(n_)) < telling_change_K) return std::nullopt;
    if (air_material_ / std::sqrt(air_air_ * material_material_) < least_correlation)
        return std::nullopt;
    return air_material_ / air_air_;
}

} // namespace axiscal
