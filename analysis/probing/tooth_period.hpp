#pragma once
// The period of a saw-tooth of which only a few points are known. Pure.

#include "analysis/quantity/result.hpp"

#include <optional>
#include <span>
#include <string>

namespace axiscal {

/// Readings X against approach distances a that follow, for slope s = +1 or -1,
///   X = c + s a + P n,   n whole,   all X within one tooth (largest - smallest <= P).
struct Tooth {
    double period = 0;               ///< P, in the unit of the readings
    double standard_uncertainty = 0; ///< of P, from the residuals; 0 at no residual
    double residual_rms = 0;         ///< of X about the tooth
    int slope = 1;                   ///< s
};

/// Scans P from 0.7 to 2 times the variation of X (less cannot hold the readings, more is seen in
/// less than half of a tooth and stays open), then fits c and P to the whole numbers so found.
/// Accepted only if the tooth explains nine tenths of the scatter of X, the chance that unrelated
/// readings fit as well is below 1e-3, and no second period fits as well. Readings that were
/// rounded to a common grid are weighed as such: unrelated ones on two or three levels fit many
/// lattices exactly.
/// Accuracy: `standard_uncertainty`; without noise a few 1e-16 of the approach distance a tooth.
/// The method is a reconstruction: the text of the standard that would state one is lost.
/// @errors Fault::bad_case without a field; the reason says what the readings lack.
Result<Tooth> find_tooth(std::span<const double> approach, std::span<const double> reading);

} // namespace axiscal
