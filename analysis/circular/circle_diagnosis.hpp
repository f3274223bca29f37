#pragma once
// ISO 230-4: what a circle's form comes from. A linear decomposition of both traces into named
// causes, then what its residual shows: cyclic errors, spikes, steps, vibration. Pure.

#include "analysis/circular/cause.hpp"
#include "analysis/circular/circular_test.hpp"
#include "analysis/circular/residual_features.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct CauseEstimate {
    /// Absent where the data do not tell it from others (`CircleDiagnosis::not_separable`) or where
    /// its sense was not measured.
    std::optional<double> value;     ///< in the unit of its key
    double standard_uncertainty = 0; ///< by the scatter of the residuals, taken as independent
};

/// What one cause, or a group that the data do not split, does to the form.
struct CauseContribution {
    std::string cause;            ///< "squareness", "scale_mismatch", "cyclic_x", ...
    double peak_to_valley_mm = 0; ///< of its term, over the angles measured
    /// Range of its term without the circle that the term itself shifts (least squares, first
    /// order): what it adds to G of the worse sense, and to G(b). Contributions do not add up.
    double G_mm = 0, G_b_mm = 0;
    bool significant = true; ///< its value exceeds twice its standard uncertainty
    std::string words;       ///< one sentence
};

struct InseparableGroup {
    std::vector<circular::Cause> causes;
    double peak_to_valley_mm = 0; ///< of what they make together, which is known
};

/// A lag common to both axes makes the circle small, by R (F tau / R)^2 / 2. At one feed that
/// cannot be told from a scale error of both axes.
struct CommonLag {
    double radius_change_mm = 0;     ///< mean of both scale terms: R (ex + ey) / 2
    std::optional<double> longest_s; ///< the lag if the whole change were its work; none outward
};

struct CircleDiagnosis {
    std::array<CauseEstimate, circular::cause_count> causes;
    std::vector<InseparableGroup> not_separable;
    std::size_t rank = 0, columns = 0;
    double condition = 0; ///< of the columns scaled to one length
    double residual_rms_mm = 0;
    bool reversals_masked = false; ///< readings within 4 deg of a reversal were left out of the fit
    std::optional<CommonLag> common_lag;
    std::vector<circular::CyclicError> cyclic;
    std::optional<circular::Lobes> lobes;
    std::vector<circular::Reversal> reversals;
    std::vector<circular::ChangeOver> change_overs;
    std::optional<circular::Vibration> vibration;
    std::vector<CauseContribution> ranking; ///< by G_mm, largest first
    [[nodiscard]] const CauseEstimate& of(circular::Cause cause) const {
        return causes[static_cast<std::size_t>(cause)];
    }
};

/// Names of the two axes, for the words: "X" and "Y".
using AxisNames = std::array<std::string, 2>;

/// Linear least squares over all readings of both senses. Readings within 4 deg of a reversal are
/// left out when their scatter there exceeds twice that elsewhere (spikes). A cause that others can
/// replace exactly is not given but named; one sense alone does not tell squareness from lag
/// difference. Readings stand as measured: scales contain the expansion of bar and machine.
///
/// Recovers noise-free causes to 1e-9 of the largest deviation. First order: a centre offset e adds
/// e^2 / (2 R) of ellipse.
/// @errors those of check_circular_test.
Result<CircleDiagnosis> diagnose_circle(const CircularTest& test, const AxisNames& axes);

} // namespace axiscal
