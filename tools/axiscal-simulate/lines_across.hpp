#pragma once
// Lines of the motion across an axis, and what can be wrong of a measured one: for the truths of
// straightness and squareness. Positions in mm, rising, at least two; deviations in um. Pure.

#include "scenario.hpp"
#include "truth.hpp"

#include <cmath>
#include <vector>

namespace axiscal::simulate {

using LineAcross = std::vector<double>;

/// Largest minus smallest of y - slope x.
double width_along(const LineAcross& x, const LineAcross& y, double slope);
double mean_of_line(const LineAcross& values);

/// um/mm. Of the least zone the line is parallel to a pair of points.
double slope_of_end_points(const LineAcross& x, const LineAcross& y);
double slope_of_least_squares(const LineAcross& x, const LineAcross& y);
double slope_of_least_zone(const LineAcross& x, const LineAcross& y);

/// What the places add up to about their mean: of the least-squares line.
struct SpreadOfPlaces {
    double squares = 0;   ///< sum of (x - mean)^2, mm^2
    double distances = 0; ///< sum of |x - mean|, mm
};
SpreadOfPlaces spread_of(const LineAcross& x);

/// The motion after approaches from below (+1) or from above (-1); 0 is the mean of both.
/// @param across  scenario_across()
LineAcross motion_across(const Scenario& across, const LineAcross& x, int direction);
LineAcross form_of_mirror(const ErrorScenario& mirror, const LineAcross& x);

/// What the bounds are made of, um.
struct AcrossTerms {
    double sigma = 0, z = 0, count = 0, drift = 0, mirror = 0;
    /// Wrong by this much at every target, at most.
    [[nodiscard]] double everywhere() const { return count + drift + mirror; }
    /// @param readings  in each mean
    [[nodiscard]] double noise(double readings) const { return z * sigma / std::sqrt(readings); }
};
/// `mirror` stays 0.
AcrossTerms terms_across(const Scenario& scenario, const Scenario& across, const TruthPlan& plan);

} // namespace axiscal::simulate
