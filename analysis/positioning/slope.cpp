#include "analysis/positioning/slope.hpp"

#include "analysis/positioning/sums.hpp"

#include <cmath>

namespace axiscal {
namespace {

double mean_deviation(const PositionRow& row) {
    return row.mean ? *row.mean : row.mean_forward;
}

double least_squares_slope(const std::vector<double>& targets, const std::vector<double>& means) {
    const double target_mean = mean_of(targets), mean = mean_of(means);
    double products = 0, squares = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double step = targets[i] - target_mean;
        products += step * (means[i] - mean);
        squares += step * step;
    }
    return products / squares;
}

} // namespace

std::optional<MeanSlope> slope_of_means(const std::vector<PositionRow>& rows) {
    if (rows.size() < 2) return std::nullopt;
    std::vector<double> targets, means;
    for (const PositionRow& row : rows) {
        targets.push_back(row.target);
        means.push_back(mean_deviation(row));
    }
    const auto [first, last] = std::ranges::minmax_element(rows, {}, &PositionRow::target);
    MeanSlope slope;
    slope.of_both_directions = rows.front().mean.has_value();
    slope.end_points =
        (mean_deviation(*last) - mean_deviation(*first)) / (last->target - first->target);
    slope.least_squares = least_squares_slope(targets, means);
    if (!std::isfinite(slope.end_points) || !std::isfinite(slope.least_squares))
        return std::nullopt;
    return slope;
}

} // namespace axiscal
