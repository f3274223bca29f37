#pragma once
// What a perfect measurement of the straightness of the simulated machine would find. Pure.

#include "scenario.hpp"
#include "truth.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace axiscal::simulate {

/// Straightness of a line against three references, um; positions in mm, rising, at least two.
struct TrueStraightness {
    double end_points_um = 0, least_squares_um = 0, minimum_zone_um = 0;
};
/// Largest minus smallest distance from the line through the ends, from the line of least squares
/// (normal equations), and the least of any line: one that is parallel to a pair of points.
TrueStraightness straightness_of(const std::vector<double>& positions_mm,
                                 const std::vector<double>& deviations_um);

/// As truth_of(), of a scenario with [straightness].
nlohmann::json straightness_truth_of(const Scenario& scenario, const TruthPlan& plan);

} // namespace axiscal::simulate
