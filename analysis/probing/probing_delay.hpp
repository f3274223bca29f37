#pragma once
// Variation of the time delay of a touch probe (ISO 230-10 clause 6.9). Pure.
//
// The constant part of the delay between contact and latch is absorbed by the effective stylus
// diameter; what varies moves the trigger coordinate. Clause 6.9 is known to us in part: purpose
// and set-up are stated, counts, steps and symbols are reconstructed and therefore inputs. The feed
// of 480 mm/min is 8 mm/s, that is 0.008 mm a millisecond (the printed "mm/us" is a slip of units).

#include "analysis/quantity/result.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct ProbingSeries {
    std::array<double, 3> direction{}; ///< of approach; its length does not matter
    std::vector<double> approach_mm;   ///< distance from start to face, one a touch
    std::vector<double> trigger_mm;    ///< coordinate along the direction, one a touch
    bool reference = false; ///< touched from one and the same distance: E_0, no delay effect
    std::string symbol;     ///< empty: "E_TD,X", "E_TD,XY", ... by the axes that move (from memory)
};

struct ProbingDelayCase {
    double feed_mm_per_min = 0;
    std::size_t required_touches = 1; ///< the standard's own count is lost; 10 to 20 suggested
    std::vector<ProbingSeries> series;
};

struct ProbingDelay {
    std::string symbol;
    std::array<double, 3> unit_direction{};
    std::size_t touches = 0;
    bool reference = false;
    double variation_mm = 0; ///< largest - smallest trigger coordinate (E_TD, reconstructed)
    double variation_ms = 0; ///< the same over the feed
    std::optional<double> standard_deviation_mm;                     ///< two touches or more
    std::optional<double> period_ms, period_standard_uncertainty_ms; ///< saw-tooth, where found
    std::optional<int> tooth_slope; ///< +1: the reading grows with the approach distance
    std::optional<double> tooth_residual_mm;
    std::string no_period; ///< the reason where it was not found
    /// E_0: the largest variation of the reference series of the same direction.
    std::optional<double> reference_repeatability_mm;
    /// sqrt(E_TD^2 - E_0^2), for information; absent where E_0 is larger.
    std::optional<double> net_variation_mm;
};

/// Both go the same way; an oblique direction within rounding. Pure.
bool same_direction(const ProbingDelay& a, const ProbingDelay& b);

/// One result a series, in the same order.
/// @errors Fault::bad_case with the field: a feed not above 0, no series, lists empty or of
/// different length, fewer touches than required, a direction of length 0, numbers not finite or
/// above 1e12, a reference series whose approach distance varies by more than 1 um.
Result<std::vector<ProbingDelay>> evaluate_probing_delay(const ProbingDelayCase& stated);

} // namespace axiscal
