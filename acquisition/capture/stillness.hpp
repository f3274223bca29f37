#pragma once
// Does the axis stand? Judged over a window of length samples: number, spread, slope, gaps,
// quality, one epoch. Pure.

#include "acquisition/capture/sample_history.hpp"
#include "config/station_config.hpp"

#include <optional>
#include <span>
#include <string>

namespace axiscal {

struct WindowStatistics {
    int n = 0; ///< good samples
    Length mean, spread;
    double slope_um_per_s = 0; ///< least squares; 0 for fewer than two instants
};

struct StillnessVerdict {
    bool still = false;
    Fault fault = Fault::none; ///< not_still, or what the samples themselves say
    std::string reason;        ///< one sentence; empty when still
    WindowStatistics statistics;
};

struct StillWindow {
    MonotonicTime begin, end;
    WindowStatistics statistics;
};

/// What a search found up to `now`: a window, a fault that waiting cannot heal (`failure`: beam
/// lost, zero lost, impossible jump), or neither yet, and then why not (`verdict`).
struct WindowSearch {
    std::optional<StillWindow> window;
    std::optional<Error> failure;
    StillnessVerdict verdict;
};

/// Over good samples only. Time and reading are re-based to the first sample, so that a slope of
/// 1 nm/s survives at 100 m.
WindowStatistics measure_window(std::span<const Sample> samples);

/// The longest silence a window may contain: twice its mean spacing at `minimum_samples`.
Duration largest_gap(const CaptureConfig& config);

/// Samples of [begin, end] against the limits of `config`. Empty windows are not still.
StillnessVerdict judge_window(std::span<const Sample> samples,
                              MonotonicTime begin,
                              MonotonicTime end,
                              const CaptureConfig& config);

/// Beam lost, zero lost (epoch change) or a jump that no axis makes, anywhere in `samples`; with
/// `fastest` = 0 jumps are not judged.
std::optional<Error> find_lost_count(std::span<const Sample> samples, Speed fastest);

/// The earliest still window of the configured length inside [from, now]: never a moment before
/// the trigger. Starts are tried on a grid of a twentieth of the window, anchored at `from`.
WindowSearch find_still_window(const SampleHistory& history,
                               MonotonicTime from,
                               MonotonicTime now,
                               const CaptureConfig& config);

/// The error to give when the deadline passed without a window.
Error give_up(const WindowSearch& search, Duration waited);

} // namespace axiscal
