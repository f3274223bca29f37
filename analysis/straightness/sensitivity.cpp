#include "analysis/straightness/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace axiscal {
namespace {

/// The first of equal ones: rounding of a symmetric line decides nothing.
struct Extremes {
    std::size_t high = 0, low = 0;
};

Extremes extremes_of(const std::vector<double>& residuals) {
    const auto high = std::ranges::max_element(residuals);
    const auto low = std::ranges::min_element(residuals);
    return {static_cast<std::size_t>(high - residuals.begin()),
            static_cast<std::size_t>(low - residuals.begin())};
}

std::vector<double> of_end_points(const MeasuredLine& line, const ReferenceLine& reference) {
    const std::vector<double>& x = line.positions;
    const Extremes at = extremes_of(reference.residuals);
    std::vector<double> w(x.size(), 0);
    const double share = (x[at.high] - x[at.low]) / (x.back() - x.front());
    w[at.high] += 1;
    w[at.low] -= 1;
    w.front() += share;
    w.back() -= share;
    return w;
}

std::vector<double> of_least_squares(const MeasuredLine& line, const ReferenceLine& reference) {
    const std::vector<double>& x = line.positions;
    const Extremes at = extremes_of(reference.residuals);
    double mean = 0, squares = 0; // about the first position: a far origin costs no digits
    for (const double position : x)
        mean += (position - x.front()) / static_cast<double>(x.size());
    mean += x.front();
    for (const double position : x)
        squares += (position - mean) * (position - mean);
    std::vector<double> w;
    w.reserve(x.size());
    for (const double position : x)
        w.push_back(-(x[at.high] - x[at.low]) * (position - mean) / squares);
    w[at.high] += 1;
    w[at.low] -= 1;
    return w;
}

std::vector<double> of_minimum_zone(const MeasuredLine& line, const MinimumZone& zone) {
    const std::vector<double>& x = line.positions;
    std::vector<double> w(x.size(), 0);
    if (zone.control_points.size() != 3) return w;
    const std::size_t left = zone.control_points[0].index;
    const std::size_t middle = zone.control_points[1].index;
    const std::size_t right = zone.control_points[2].index;
    const double share = (x[middle] - x[left]) / (x[right] - x[left]);
    const double cosine = 1 / std::sqrt(1 + zone.line.slope * zone.line.slope);
    const double sign = zone.control_points[1].upper ? cosine : -cosine;
    w[middle] += sign;
    w[left] -= sign * (1 - share);
    w[right] -= sign * share;
    return w;
}

} // namespace

std::vector<double>
sensitivity_of(const MeasuredLine& line, const Straightness& found, LineReference reference) {
    if (line.positions.size() < 3) return std::vector<double>(line.positions.size(), 0);
    switch (reference) {
    case LineReference::end_points: return of_end_points(line, found.end_points);
    case LineReference::least_squares: return of_least_squares(line, found.least_squares);
    case LineReference::minimum_zone: break;
    }
    return of_minimum_zone(line, found.minimum_zone);
}

std::vector<double> sensitivity_to_steps(const std::vector<double>& sensitivity) {
    if (sensitivity.size() < 2) return {};
    std::vector<double> steps(sensitivity.size() - 1, 0);
    double behind = 0;
    for (std::size_t j = steps.size(); j-- > 0;) {
        behind += sensitivity[j + 1];
        steps[j] = behind;
    }
    return steps;
}

double sum_of_squares(const std::vector<double>& sensitivity) {
    double sum = 0;
    for (const double w : sensitivity)
        sum += w * w;
    return sum;
}

} // namespace axiscal
