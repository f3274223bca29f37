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

/// Over good samples only.
WindowStatistics statistics_of(const SampleSummary& samples);

/// The longest silence a window may contain: twice its mean spacing at `minimum_samples`.
Duration largest_gap(const CaptureConfig& config);

/// Samples of [begin, end] against the limits of `config`. Empty windows are not still. Costs no
/// walk over the samples.
StillnessVerdict judge_window(const SampleHistory& history,
                              MonotonicTime begin,
                              MonotonicTime end,
                              const CaptureConfig& config);

/// The first loss in `samples`, a part of history.all(): beam lost, zero lost (epoch change) or a
/// jump that no axis makes; with `fastest` = 0 jumps are not judged.
std::optional<Error>
find_lost_count(const SampleHistory& history, std::span<const Sample> samples, Speed fastest);

/// Looks, as often as it is asked, for the earliest still window of the configured length since
/// `from`: never a moment before the trigger. Starts are tried on a grid of a twentieth of the
/// window, anchored at `from`; one whose samples have all come is never tried again, so a look
/// costs the same however long the search goes on.
class StillWindowSearch {
public:
    StillWindowSearch(MonotonicTime from, const CaptureConfig& config);

    /// What was found up to `now`, which must not go back from look to look.
    WindowSearch look(const SampleHistory& history, MonotonicTime now);

private:
    [[nodiscard]] MonotonicTime
    start_after_silence(const SampleHistory& history, MonotonicTime begin, MonotonicTime now) const;

    CaptureConfig config_;
    Duration step_;
    MonotonicTime from_, next_; ///< next_: the first start not yet rejected for good
    StillnessVerdict rejected_; ///< of the last start before next_
};

/// The error to give when the deadline passed without a window.
Error not_still(const WindowSearch& search, Duration waited);

} // namespace axiscal
