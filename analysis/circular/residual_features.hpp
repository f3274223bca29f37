#pragma once
// What stays of a circle when its named causes are taken out, and what it tells. Pure.

#include "analysis/circular/seen_points.hpp"

#include <array>
#include <optional>
#include <vector>

namespace axiscal::circular {

/// Residual of every point of a trace, in its order.
struct ResidualTrace {
    const SeenTrace* trace = nullptr;
    std::vector<double> residual_mm;
    /// Fitted backlash of the two axes: a reversal's own step is this plus that of the residual.
    std::array<double, 2> backlash_mm{};
};

/// One axis turning round, in one sense.
struct Reversal {
    Sense sense = Sense::ccw;
    int axis = 0; ///< 0: the first, at 0 and 180 deg; 1: the second, at 90 and 270 deg
    double at_deg = 0;
    /// Outward step on crossing: the fitted backlash and what lines through [-12, -2] and [2, 12]
    /// deg of the residual add to it at this place.
    double step_mm = 0, step_standard_uncertainty_mm = 0;
    /// Largest residual within 10 deg after the crossing, signed, inward negative; width at half
    /// height. Lost motion that is taken up while the drive comes back from its turn is no spike:
    /// it is taken out where it explains the readings better than a step at the crossing does.
    /// Significant: above five times the scatter away from the reversals.
    double spike_mm = 0, spike_width_deg = 0, spike_width_ms = 0;
    bool spike_significant = false;
};

/// Step of the residual where one axis hands the lead to the other: 45, 135, 225, 315 deg.
struct ChangeOver {
    Sense sense = Sense::ccw;
    double at_deg = 0;
    double step_mm = 0; ///< outward on crossing in the direction of travel
    double standard_uncertainty_mm = 0;
    bool significant = false; ///< above four standard uncertainties
};

/// Residual above 0.5 per degree (minus its mean over 2 deg), more than 10 deg from every reversal.
/// Contains the noise of the readings.
struct Vibration {
    double rms_mm = 0, peak_to_valley_mm = 0;
};

struct ResidualScale {
    double rms_mm = 0;        ///< more than 10 deg from every reversal
    double negligible_mm = 0; ///< below this, rounding
};
ResidualScale scale_of(const std::vector<ResidualTrace>& traces, double nominal_radius_mm);

/// Crossings with at least three readings on either side.
std::vector<Reversal> find_reversals(const std::vector<ResidualTrace>& traces,
                                     const ResidualScale& scale,
                                     double nominal_radius_mm,
                                     double feed_mm_per_s);
std::vector<ChangeOver> find_change_overs(const std::vector<ResidualTrace>& traces,
                                          const ResidualScale& scale);

/// None where the readings stand more than 0.5 deg apart.
std::optional<Vibration> find_vibration(const std::vector<ResidualTrace>& traces);

/// Periodic error of one axis (screw pitch, scale): A c cos(2 pi R c / p + phi) for the first axis,
/// with s in place of c for the second.
struct CyclicError {
    int axis = 0;
    double pitch_mm = 0, amplitude_mm = 0, phase_rad = 0;
    double pitch_standard_uncertainty_mm = 0, amplitude_standard_uncertainty_mm = 0;
};

/// The strongest periodic error of `axis` in the residual, to the resolution of the search; none
/// where chance would give one as strong in more than one of 10 000 searches, where it explains
/// less than a tenth of the residual, or where lobes even in angle explain more. Pitches from 2 R /
/// 3 down to four readings a period (at 45 deg) and 400 periods.
std::optional<CyclicError> search_cyclic(const std::vector<ResidualTrace>& traces,
                                         int axis,
                                         double nominal_radius_mm,
                                         const ResidualScale& scale);

/// Lobes even in angle: chatter at a fixed rate, a loose set-up, a form of the instrument; no error
/// of an axis, whose period would follow its travel.
struct Lobes {
    int per_turn = 0; ///< four at least: three and fewer are causes with names
    double amplitude_mm = 0;
};

/// The strongest lobes of the residual, by the same measure as search_cyclic.
std::optional<Lobes> find_lobes(const std::vector<ResidualTrace>& traces,
                                const ResidualScale& scale);

} // namespace axiscal::circular
