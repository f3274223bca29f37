#pragma once
// How a straightness changes with the deviation at each position. Pure.

#include "analysis/geometry/straightness.hpp"
#include "analysis/straightness/straightness_figures.hpp"

#include <vector>

namespace axiscal {

/// w_i = dP/dy_i of the straightness P against one reference, with those points the extremes that
/// are it now; one a position, dimensionless. With r_i the residuals, h and l the highest and the
/// lowest point, t_i = (x_i - x_1) / (x_m - x_1):
///   end points      w = e_h - e_l + (t_h - t_l) (e_1 - e_m)
///   least squares   w_i = [i = h] - [i = l] - (x_h - x_l) (x_i - xm) / sum (x - xm)^2
///   minimum zone    w = +-cos (e_c - (1 - t) e_a - t e_b), a and b on one line, c on the other
/// Every one has sum w = 0, sum w x = 0 (a shift and a slope of the line change nothing) and
/// sum w y = P. That the zone turns a little with the points is left out: below straightness over
/// length times the slope. First order: where several points compete for an extreme, P grows more
/// than w says (straightness_trials.hpp).
/// Two points: all 0. @param found  straightness_of(line)
std::vector<double>
sensitivity_of(const MeasuredLine& line, const Straightness& found, LineReference reference);

/// g_j = dP/dy of what is added to step j and to every position behind it: an angle of the foot.
/// One for each of the m - 1 steps: sum of w_i over the positions behind the step.
std::vector<double> sensitivity_to_steps(const std::vector<double>& sensitivity);

/// sum w^2 of either.
double sum_of_squares(const std::vector<double>& sensitivity);

} // namespace axiscal
