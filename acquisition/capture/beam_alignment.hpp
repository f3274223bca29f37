#pragma once
// The beam of the laser while it is aligned, and what was kept of it for the runs that follow.
// Pure.

#include "acquisition/capture/alignment_watch.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/alignment_record.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <string>

namespace axiscal {

class BeamAlignment {
public:
    /// Begins anew; what was kept before stays until it is replaced.
    void begin(Length travel, Length spread_limit, const ClockTie& now);
    void cancel() { watch_.reset(); }
    [[nodiscard]] bool running() const { return watch_.has_value(); }

    /// @param strength  the latest that the laser sent. It belongs to the reading that follows it,
    ///                  once: an instrument sends it a hundred times more seldom than the place,
    ///                  and an axis that moves has left that place by the next reading but one.
    void take(const Sample& sample, const std::optional<Sample>& strength);

    /// While it runs: distance from the nearest place, and whether the axis rests.
    [[nodiscard]] std::optional<Length> distance() const { return watch_->distance(); }
    [[nodiscard]] bool at_rest() const { return watch_->at_rest(); }
    /// While it runs. @param laser, serial  whose beam it is
    [[nodiscard]] AlignmentRecord
    so_far(const std::string& laser, const std::string& serial, std::int64_t utc_ns) const;

    /// Ends it. @param record  of so_far()
    /// @errors Fault::beam_lost without a good reading; Fault::refused for too short a way: it goes
    /// on then.
    Result<void> keep(AlignmentRecord record, std::optional<double> spot_offset_mm);
    /// The last one kept since the start.
    [[nodiscard]] const std::optional<AlignmentRecord>& kept() const { return kept_; }

private:
    std::optional<AlignmentWatch> watch_;
    std::int64_t since_utc_ns_ = 0;
    MonotonicTime placed_at_; ///< of the strength that was given a place last
    std::optional<AlignmentRecord> kept_;
};

} // namespace axiscal
