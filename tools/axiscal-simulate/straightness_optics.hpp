#pragma once
// A Wollaston prism before a bisecting mirror: what its interferometer counts of the motion across
// the axis. One thread.

#include "simulated_machine.hpp"

#include <cstdint>

namespace axiscal::simulate {

/// Of the second axis, um/m: with S the angle between the axes minus 90 degrees, a1 the slope of
/// the first line, e the error of the square and s = -1 where it is turned,
///     S = -atan a1 - atan a2 + s e
double slope_through_square_um_per_m(const SquarenessScenario& squareness);

/// The scenario of the motion across: its errors are those of [straightness.across], its noise is
/// another one, and nothing grows. Its slide stands where the drive is, plus the deviation; through
/// an optical square the motion has the slope of [squareness] beside its own.
Scenario scenario_across(const Scenario& scenario);

/// The deviation across moves both beams, one there and one back: the laser shows
///     D = sign (d + m) / factor
/// with d the deviation of the motion and m the form of the mirror where the prism stands; of a
/// mirror that is turned by 180 degrees about the beam m counts with the other sign.
class StraightnessOptics {
public:
    /// @param scenario  with [straightness]
    explicit StraightnessOptics(const Scenario& scenario);

    /// Optical cycles since the counter started; the next sample in order, as SimulatedMachine.
    double cycles(double drive_mm, double seconds, std::uint64_t sample);
    void zero_counter() { across_.zero_counter(); }

private:
    StraightnessScenario optics_;
    SimulatedMachine across_;
    TrueErrors mirror_;
};

} // namespace axiscal::simulate
