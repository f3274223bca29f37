#pragma once
// The last minutes of one channel, ordered by time; gaps and lost zeros are known.

#include "acquisition/capture/sample_ring.hpp"
#include "acquisition/capture/summary_levels.hpp"
#include "drivers/sample.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace axiscal {

/// Loop-bound. push() moves no other sample. Memory is bounded by `capacity` samples; the oldest go
/// first, by age (`depth`) or by number. Spans are valid until the next push(). What a span amounts
/// to is known without walking over its samples.
class SampleHistory {
public:
    struct Limits {
        Duration depth = std::chrono::minutes{5};
        std::size_t capacity = 600'000; ///< 5 minutes at 2 kHz
    };
    SampleHistory()
        : SampleHistory{Limits{}} {}
    explicit SampleHistory(Limits limits)
        : limits_{limits}
        , samples_{limits.capacity + 1} {}

    /// A sample older than its predecessor is dropped and counted: order is what a search relies
    /// on. Bad samples are kept: they are evidence.
    void push(const Sample& sample);

    [[nodiscard]] std::span<const Sample> all() const { return samples_.all(); }
    /// Samples with begin <= at <= end.
    [[nodiscard]] std::span<const Sample> between(MonotonicTime begin, MonotonicTime end) const;
    /// Of a part of all().
    [[nodiscard]] SampleSummary summary_of(std::span<const Sample> part) const;
    /// The largest block of fewer than `levels` levels at the end of a part of all(), if any.
    [[nodiscard]] SummaryLevels::Block last_block_of(std::span<const Sample> part,
                                                     std::size_t levels) const;
    [[nodiscard]] std::optional<Sample> newest() const;
    /// Nothing that was pushed at or after `instant` has been dropped for its age or number.
    [[nodiscard]] bool reaches_back_to(MonotonicTime instant) const;

    [[nodiscard]] std::uint64_t disordered() const { return disordered_; }
    /// Places where the instrument's own numbering left out samples.
    [[nodiscard]] std::uint64_t gaps() const { return gaps_; }

private:
    void forget_old(MonotonicTime oldest_wanted);
    [[nodiscard]] std::size_t number_of(std::span<const Sample> part) const;

    Limits limits_;
    SampleRing samples_;
    SummaryLevels summaries_;
    std::size_t forgotten_ = 0; ///< samples before the first of all()
    std::uint64_t disordered_ = 0, gaps_ = 0;
    std::optional<MonotonicTime> newest_forgotten_, began_at_;
};

/// Longest time without a sample inside [begin, end], its ends included. Empty: the whole span.
Duration longest_silence(const SampleSummary& samples, MonotonicTime begin, MonotonicTime end);

} // namespace axiscal
