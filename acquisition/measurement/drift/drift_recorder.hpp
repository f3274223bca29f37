#pragma once
// Which readings of a drift test are taken, interval by interval. No I/O; time comes with the call.

#include "acquisition/capture/sample_history.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axiscal {

struct DriftLimits {
    Duration window{}; ///< the laser's or ballbar's reading is the mean over it, as a point's is
    Duration oldest{}; ///< of another channel: an older reading is no reading
    int minimum_samples = 2;
};

/// Loop-bound.
class DriftRecorder {
public:
    /// @param watched  the channel whose history is given to take(), of the laser or the ballbar;
    /// `epoch` of its counter now.
    DriftRecorder(DriftSetup setup, int watched, std::uint32_t epoch, MonotonicTime begin);

    /// The readings of this instant: the watched mean over the last window, all of it good and
    /// under one zero, else the interval is counted as missing; of every other channel what came
    /// since the last time.
    std::vector<EnvironmentReading> take(MonotonicTime now,
                                         const SampleHistory& watched,
                                         std::span<const std::optional<Sample>> latest,
                                         const DriftLimits& limits);

    [[nodiscard]] MonotonicTime next_due() const { return next_due_; }
    [[nodiscard]] MonotonicTime end() const { return begin_ + setup_.duration; }
    [[nodiscard]] bool is_over() const { return next_due_ > end(); }
    /// The counter lost its zero: what follows cannot be compared with what was taken.
    [[nodiscard]] bool zero_is_lost() const { return zero_lost_; }
    [[nodiscard]] int taken() const { return taken_; }
    [[nodiscard]] int missing() const { return missing_; }
    [[nodiscard]] int planned() const {
        return static_cast<int>(setup_.duration / setup_.interval);
    }
    /// Largest - smallest reading of what is watched so far; none before the second.
    [[nodiscard]] std::optional<Length> range() const;
    [[nodiscard]] const DriftSetup& setup() const { return setup_; }

private:
    [[nodiscard]] std::optional<EnvironmentReading>
    mean_of(MonotonicTime now, const SampleHistory& watched, const DriftLimits& limits);
    DriftSetup setup_;
    int watched_;
    std::uint32_t epoch_;
    MonotonicTime begin_, next_due_;
    std::vector<MonotonicTime> last_taken_; ///< by channel
    int taken_ = 0, missing_ = 0;
    double low_m_ = 0, high_m_ = 0;
    bool zero_lost_ = false;
};

} // namespace axiscal
