#pragma once
// A still window reduced to what the run file keeps, and the proof that the axis came to it from
// the claimed side. Pure.

#include "acquisition/capture/sample_history.hpp"
#include "acquisition/capture/stillness.hpp"
#include "analysis/record/synchronisation.hpp"

#include <optional>
#include <vector>

namespace axiscal {

/// What the CNC claims about the way to the target.
struct ApproachClaim {
    Direction direction = Direction::positive;
    int sign = 1;        ///< LaserSetup::sign
    Length overrun;      ///< RunPlan::overrun
    MonotonicTime since; ///< end of the previous point's (or the datum's) window
};

struct Capture {
    MonotonicTime begin, end;
    Length mean; ///< vacuum wavelengths, sign as counted
    Length spread;
    double slope_um_per_s = 0;
    int n = 0;
    std::uint32_t epoch = 0;
    std::uint64_t device_count = 0; ///< of the last sample
    WindowSamples samples;
    std::optional<Synchronisation> synchronisation; ///< empty unless every sample has its u(t)
    /// How far the axis was seen to come from the claimed side. An error here does not spoil the
    /// reading (its place still tells what is wrong), but the point must be refused. 0 without a
    /// claim.
    Result<Length> approach_travel = Length{};
};

/// Lost motion that is allowed for: after a reversal the table follows later than the scale or
/// screw, so a move by the overrun is seen shortened. min(50 um, overrun/20). A machine with more
/// needs a longer overrun in its program.
Length lost_motion_allowance(Length overrun);

/// @errors Fault::beam_lost, datum_lost or implausible_jump when counting was interrupted since
/// the previous point; Fault::samples_lost when the window is no longer in the history.
Result<Capture> make_capture(const SampleHistory& history,
                             const StillWindow& window,
                             const std::optional<ApproachClaim>& claim,
                             const CaptureConfig& config);

/// The path is followed backwards from the rest, tracking its farthest point on the claimed side,
/// until it turns by more than max(overrun/20, spread at rest, 2 um): noise and servo ripple do not
/// turn it, a reversal does.
/// @return the travel; at least overrun - lost_motion_allowance(overrun).
/// @errors Fault::wrong_direction with the travel seen, and whether the axis came from the other
/// side or without an overrun; Fault::samples_lost when the readings end
/// (gap, bad value, history too short) before the travel was seen. Samples with consecutive device
/// numbers have no gap between them, however late they were read.
Result<Length> approach_travel(const SampleHistory& history,
                               const StillWindow& window,
                               const ApproachClaim& claim,
                               const CaptureConfig& config);

} // namespace axiscal
