#pragma once
// ISO 230-4: circular deviations G and G(b), radial deviations F, mean bidirectional radial
// deviation D. Pure.

#include "analysis/circle/circle_fit.hpp"
#include "analysis/circular/circular_test.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// From whose centre F is counted: that of the set-up, or of the least squares circle of the trace.
/// `automatic`: least squares on a full circle, set-up on an arc.
enum class RadialCentre : std::uint8_t { automatic, set_up, least_squares };
std::string_view name_of(RadialCentre centre);

/// The bar's and the machine's temperatures, for F and D at 20 degC.
struct BarExpansion {
    double bar_degC = 20, machine_degC = 20;
    double bar_alpha_per_K = 0, machine_alpha_per_K = 0;
    double bar_length_mm = 0; ///< calibrated length at 20 degC that the readings are relative to
};

/// What stands at 20 degC minus what was read, the same for every reading, first order:
///   L alpha_B (theta_B - 20) - R alpha_M (theta_M - 20)
/// (a warm bar reads short, a warm machine makes its circle large).
/// @errors Fault::bad_case, field "temperature.…": not finite, outside -100 ... 200 degC, an
/// expansion coefficient of 1e-3 per kelvin and more (it stands per kelvin, not in um/(m K)), a
/// length not above 0.
Result<double> correction_to_20C_mm(const BarExpansion& bar, double nominal_radius_mm);

/// A reading that a ring touches.
struct RingPoint {
    Sense sense = Sense::ccw;
    std::size_t index = 0; ///< of the reading in its trace, from 0
    ZoneSide side = ZoneSide::outer;
};

/// The narrowest ring: centre from the set-up's, radii minus the nominal one.
struct ZoneRing {
    double x_mm = 0, y_mm = 0;
    double outer_mm = 0, inner_mm = 0;
    std::vector<RingPoint> control_points; ///< what holds it: two to four
    bool beyond_set_up = false; ///< its centre lies farther than R from that of the set-up
};

/// A least squares circle: centre from the set-up's, radius minus the nominal one.
struct FittedCircle {
    double x_mm = 0, y_mm = 0, radius_mm = 0;
};

/// G of one sense, or G(b): width of the narrowest ring that holds the path(s).
struct CircularDeviation {
    double minimum_zone_mm = 0;
    double least_squares_mm = 0; ///< range of the radii about the least squares centre instead
    double gap_mm = 0;           ///< by how much at most a narrower ring can exist near by
    bool wide = false;           ///< width above 0.1 R: other optima may exist
    ZoneRing ring;
    FittedCircle fitted; ///< radius as read, not at 20 degC
};

struct RadialDeviation {
    double max_mm = 0, min_mm = 0; ///< signed, F_max and F_min
    RadialCentre centre = RadialCentre::set_up;
};

struct SenseFigures {
    ArcCover cover;
    CircularDeviation G;
    RadialDeviation F;
};

struct CircularParameters {
    std::optional<SenseFigures> ccw, cw;
    std::optional<CircularDeviation> G_b;
    std::optional<double> D_mm; ///< radius of the least squares circle of both paths - R, signed
    std::optional<double> D_condition;   ///< of that least squares fit
    ArcCover cover;                      ///< of all readings together
    std::optional<double> correction_mm; ///< contained in F and D; absent: they stand as read
    /// Contract keys ("G_cw", "D") that the data do not allow, with the reason.
    std::map<std::string, std::string> not_evaluated;
    [[nodiscard]] const std::optional<SenseFigures>& of(Sense sense) const;
};

/// Every figure that the traces allow. Feedback signals give G alone (G_f); F and D then stand
/// under not_evaluated. Every reading counts, reversal spikes too; no filter.
///
/// Radii about a centre are formed from the deviation and the nominal radius apart, so that a
/// nanometre at R = 0.5 m keeps six digits. Accuracy: 1e-13 R.
/// @errors those of check_circular_test and correction_to_20C_mm; field "f_centre" for least
/// squares over less than 90 deg, where centre and radius trade places; "traces[i]" for what has no
/// circle.
Result<CircularParameters> evaluate_circular(const CircularTest& test,
                                             RadialCentre f_centre = RadialCentre::automatic,
                                             const std::optional<BarExpansion>& bar = {});

} // namespace axiscal
