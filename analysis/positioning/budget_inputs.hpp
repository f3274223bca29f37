#pragma once
// What the budget of a positioning run is made of, input by input. Pure.

#include "analysis/positioning/positioning_certificate.hpp"
#include "analysis/uncertainty/budget_input.hpp"

#include <vector>

namespace axiscal {

/// In the order of the budget's terms; of a rotary axis those of device and environment. What the
/// readings of the run show beside what was stated:
/// - width of the material's temperature: the largest difference of two material sensors at one
///   time, corrections included, readings of each taken linearly between. One sensor shows none;
/// - misalignment: gamma L of the cosine error that aligning the beam left (cosine_error.hpp);
/// - E_VE: the straight drift in time that the readings of the run show, less twice its standard
///   uncertainty;
/// - the least strength of the laser along the travel, where it was told when the beam was aligned;
/// - the distance from 20 degC is itself the largest |theta - 20| of the readings.
std::vector<BudgetInput> budget_inputs_of(const Certificate& certificate);

} // namespace axiscal
