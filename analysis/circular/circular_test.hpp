#pragma once
// One circular test: the readings of a bar or of the feedback signals along a programmed circle,
// in one or both senses. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/circular_setup.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace axiscal {

/// What made the readings. Figures of the two are never mixed: ISO 230-4 keeps G, G(b), F and D for
/// an instrument outside the machine; what the machine's own feedback signals give is called G_f.
enum class SignalSource : std::uint8_t { external, feedback };

struct CircularTrace {
    Sense sense = Sense::ccw;
    /// Nominal angle of each reading: 0 on the first + axis, counter-clockwise positive for both
    /// senses, any number of turns.
    std::vector<double> angle_rad;
    std::vector<double> radial_deviation_mm; ///< measured radius - nominal radius, outward positive
};

struct CircularTest {
    double nominal_radius_mm = 0;
    double feed_mm_per_s = 0; ///< along the path
    SignalSource source = SignalSource::external;
    std::vector<CircularTrace> traces; ///< one, or one of each sense
    [[nodiscard]] const CircularTrace* find(Sense sense) const;
};

/// @errors Fault::bad_case with the contract's field ("traces[1].angle_rad[7]"): radius or feed not
/// within 1e-6 ... 1e12, no trace, a sense twice, lists of different length, fewer than three
/// readings, what is not finite or beyond 1e12, angles beyond 10 000 rad, a deviation not smaller
/// than the radius.
Result<void> check_circular_test(const CircularTest& test);

/// How much of the circle the readings cover.
struct ArcCover {
    double arc_deg = 0; ///< 360 minus the widest gap between neighbouring angles
    /// No gap wider than 5 deg or twice the median step, whichever is more.
    bool full_circle = false;
};
ArcCover cover_of(std::span<const double> angle_rad);

/// Angle folded into [0, 2 pi).
double folded_angle(double angle_rad);

} // namespace axiscal
