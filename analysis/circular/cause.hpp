#pragma once
// The named causes of a circle's form and how each looks: first order, in the project's signs.
// Pure.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace axiscal::circular {

/// One unknown of the decomposition. With c = cos, s = sin of the nominal angle, sg = +1 in
/// counter-clockwise and -1 in clockwise sense, sx = -sg sign(s) and sy = sg sign(c) the directions
/// in which the axes move, R the radius and F the feed, the radial deviation is the sum of
///
///   centre            a c + b s           a, b mm, a pair for each sense
///   scale             R (ex c^2 + ey s^2) ex, ey > 0: the axis travels too far
///   squareness        -beta R s c         beta rad > 0: the + axes enclose more than 90 deg
///   servo lag         sg F dtau s c       dtau s: lag of the first axis minus lag of the second
///   backlash X        -(Bx/2) sx c        Bx mm > 0: lost motion
///   backlash Y        -(By/2) sy s
///   lateral play X    -(Px/2) sx s        Px mm: the slide steps sideways when X reverses
///   lateral play Y    -(Py/2) sy c
///   straightness X    Sx s^3              Sx mm: bow over a travel of 2 R
///   straightness Y    Sy c^3
///
/// The sign of the squareness figure and the bow's definition are reconstructed (R); the ellipse,
/// the lobes and what changes with the sense are the source's (S). sign(0) = 0: a reading exactly
/// at a reversal stands half way.
enum class Cause : std::uint8_t {
    center_ccw_x,
    center_ccw_y,
    center_cw_x,
    center_cw_y,
    scale_x,
    scale_y,
    squareness,
    servo_lag_difference,
    backlash_x,
    backlash_y,
    lateral_play_x,
    lateral_play_y,
    straightness_x,
    straightness_y
};
inline constexpr std::size_t cause_count = 14;

/// Key in the contract: "squareness_rad"; of the centres, which stand as pairs there,
/// "center_ccw_mm[0]".
std::string_view key_of(Cause cause);

/// A reading as the decomposition takes it.
struct Aspect {
    double cosine = 0, sine = 0;
    double sense = 1; ///< +1 counter-clockwise, -1 clockwise
};

/// Radial deviation that each cause makes per unit, in the order of Cause.
std::array<double, cause_count>
effects_at(const Aspect& at, double nominal_radius_mm, double feed_mm_per_s);

} // namespace axiscal::circular
