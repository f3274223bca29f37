#pragma once
// What a stretch of samples amounts to, so that two neighbouring stretches make a third. Pure.

#include "drivers/sample.hpp"

#include <cstddef>
#include <span>

namespace axiscal {

/// Enough of consecutive samples for stillness, lost counts and the way to a target. Time and
/// reading of the line's sums are relative to the first good sample, so that a slope of 1 nm/s
/// survives at 100 m. Of no samples: all zero.
struct SampleSummary {
    SampleSummary() = default;
    explicit SampleSummary(const Sample& sample);

    /// Adds the samples that follow directly: constant time, however many they are.
    void append(const SampleSummary& next);

    [[nodiscard]] double spread_m() const { return high_m - low_m; }
    [[nodiscard]] double mean_m() const; ///< 0 without a good sample
    /// Least squares, m/s; 0 for fewer than two instants.
    [[nodiscard]] double slope() const;
    /// The beam lost, a zero lost (epoch change), or with `fastest` > 0 a jump that no axis makes.
    [[nodiscard]] bool lost_count(Speed fastest) const;

    std::size_t n = 0, good = 0;
    MonotonicTime first_at{}, last_at{};
    Duration longest_gap{}; ///< between two samples, good or bad
    Quality first_bad = Quality::good;
    std::uint32_t first_epoch = 0, last_epoch = 0;
    bool epoch_changed = false, beam_lost = false;

    // Of the good samples alone:
    MonotonicTime first_good_at{}, last_good_at{};
    Duration first_good_u{}, last_good_u{}; ///< u(t) of these two
    double first_good_m = 0, last_good_m = 0;
    double low_m = 0, high_m = 0;
    double fall_m = 0, rise_m = 0; ///< from an earlier one to a later one, at most
    double fastest_jump = 0;       ///< m/s beyond the floor below; 0: none is that large

private:
    void append_good(const SampleSummary& next);

    double sum_t_ = 0, sum_r_ = 0, sum_tt_ = 0, sum_tr_ = 0;
};

SampleSummary summary_of(std::span<const Sample> samples);

/// How much longer than the time between their stamps it may be between two readings: the half
/// widths, sqrt(3) u(t), of both rectangles (placed_time.hpp), and at least a bus turn each (1 ms
/// FTDI latency), by which stamps jitter whose u(t) is not stated.
Duration open_between(Duration u_of_first, Duration u_of_second);

/// The speed that a jump between two neighbouring good readings takes at least.
/// @param between  at most: the time between their stamps, and what those leave open
/// @returns 0 for less than 20 um, by which readings jump by noise without any motion
double speed_of_jump(Duration between, double jump_m);

} // namespace axiscal
