#pragma once
// Nominal differential expansion and the laser interferometer, formula by formula. Reference
// temperature 20 degC (ISO 1). Pure; lengths of one function share one unit.

#include "analysis/quantity/result.hpp"

#include <optional>

namespace axiscal {

/// A body with its linear expansion: machine axis (its feedback element, else its screw) or the
/// scale or bar that measures it.
struct ThermalBody {
    double expansion_per_K = 0;
    double temperature_degC = 20;
};

/// alpha (theta - 20)
double thermal_strain(const ThermalBody& body);

/// A deviation at 20 degC in the two forms in use.
struct DeviationAt20C {
    double first_order = 0; ///< x - L (strain of machine - strain of instrument)
    double exact = 0;       ///< (L + x) (1 + instrument) / (1 + machine) - L, without cancellation
};

/// Deviation x = reading - L at distance L from the datum, taken with an instrument that itself
/// expands. A laser has strain 0. The forms differ by terms of second order: L s^2 and x s.
/// @errors Fault::bad_case: "machine" or "instrument" for a strain of -1 or below (nothing is
/// left of the body) or above 1, "distance"/"deviation" for NaN, infinities and beyond 1e12.
Result<DeviationAt20C> deviation_at_20C(double distance,
                                        double deviation,
                                        const ThermalBody& machine,
                                        const ThermalBody& instrument);

/// The set-up of an interferometer: what does not change from one count to the next.
struct InterferometerSetup {
    double vacuum_wavelength_nm = 632.9908;
    int passes = 2; ///< of the beam over the path: 2 with a corner cube, 4 with a plane mirror
    double n_minus_1_at_zero = 0;
    double dead_path_mm = 0;
    double beam_angle_rad = 0; ///< gamma, between beam and axis
    std::optional<ThermalBody> machine;
};

struct Displacement {
    double vacuum_mm = 0; ///< N lambda / passes
    double in_air_mm = 0; ///< N lambda / (passes n) + L_d (n_0 - n) / n, along the beam
    double cosine_mm = 0; ///< what the beam reads short: D / cos(gamma) - D, without cancellation
    double along_axis_mm = 0;
    std::optional<DeviationAt20C> at_20C; ///< displacement at 20 degC; without a machine absent
};

/// From the fractional fringe count since the counter was zeroed; it rises away from the
/// interferometer. From n (L_d + D) - n_0 L_d = N lambda / passes.
/// @errors Fault::bad_case with the key: numbers out of range, |gamma| above 0.5 rad, passes
/// other than 2 or 4, n - 1 outside -0.5..0.5.
Result<Displacement>
displacement_of(const InterferometerSetup& setup, double counts, double n_minus_1);

/// gamma of a beam whose return spot walks by e over the travel L: a retroreflector doubles the
/// walk, tan(gamma) = e / (2 L).
double beam_angle_of_walk(double walk, double travel);

/// Abbe error h tan(epsilon) of a measuring line that lies h beside the line that counts.
double abbe_error(double offset, double angle_rad);

} // namespace axiscal
