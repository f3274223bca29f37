#pragma once
// The fit behind the diagnosis: every named cause and every periodic error at once. Pure.

#include "analysis/circular/residual_features.hpp"
#include "analysis/circular/row_fit.hpp"

#include <vector>

namespace axiscal::circular {

struct Decomposition {
    std::vector<Cause> causes; ///< one for each of the first columns of the solution
    std::vector<CyclicError> cyclic;
    LinearSolution solution;
    bool masked = false; ///< readings within 4 deg of a reversal took no part
    double rms_mm = 0;   ///< scatter of the residuals, by the degrees of freedom
    /// mm; of the solution of least norm where causes are tied.
    [[nodiscard]] double value_of(Cause cause) const;
};

/// Fits the causes of the senses measured, then looks for one periodic error an axis and fits it
/// with them (Gauss-Newton over its pitch).
Decomposition
decompose(const std::vector<SeenTrace>& traces, double nominal_radius_mm, double feed_mm_per_s);

/// What the decomposition leaves. The traces must outlive it.
std::vector<ResidualTrace> residuals_of(const Decomposition& fitted,
                                        const std::vector<SeenTrace>& traces,
                                        double nominal_radius_mm,
                                        double feed_mm_per_s);

/// What one periodic error makes of a point, mm.
double effect_of(const CyclicError& cyclic, const Aspect& at, double nominal_radius_mm);

} // namespace axiscal::circular
