#pragma once
// What simulated sessions are drawn about: the measured one, as the session kernel takes it. Pure.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/uncertainty/budget.hpp"
#include "analysis/uncertainty/session_kernel.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace axiscal {

/// Of both directions; of a test from one side those of that side.
std::size_t number_of_readings(const RunAt20C& run);

/// The kernel draws the same n of every target and direction.
/// @errors Fault::bad_case "readings" that differ in number.
Result<void> check_equal_rows(const RunAt20C& run);

/// Rows of targets x approaches; `result` was evaluated from `run`. `length`: over which an error
/// grows to the whole, in the unit of the run; 0: the span of the targets. The environment is left
/// at 0.
SessionModel session_model_of(const RunAt20C& run, const PositioningResult& result, double length);

/// What turns a draw into an error: uniform draws have a width of one, normal ones a deviation of
/// one.
double factor_of_draw(double u, Distribution distribution);

struct EvaluatedFigures {
    std::array<double, figure_count> values{}; ///< 0 where the result has none
    std::vector<std::size_t> present;          ///< indices of those that it has
};
/// In the order of uncertain_parameters().
EvaluatedFigures evaluated_figures(const PositioningParameters& parameters);

} // namespace axiscal
