#include "acquisition/capture/sample_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal {

Duration open_between(Duration u_of_first, Duration u_of_second) {
    constexpr Duration bus_turns = std::chrono::milliseconds{2};
    const double half_widths_s =
        std::numbers::sqrt3 * (seconds_of(u_of_first) + seconds_of(u_of_second));
    return std::max(bus_turns, from_seconds(half_widths_s));
}

double speed_of_jump(Duration between, double jump_m) {
    constexpr double floor_m = 20e-6;
    const double beyond_m = std::abs(jump_m) - floor_m;
    return beyond_m > 0 ? beyond_m / seconds_of(between) : 0;
}

SampleSummary::SampleSummary(const Sample& sample)
    : n{1}
    , first_at{sample.at}
    , last_at{sample.at}
    , first_bad{sample.quality()}
    , first_epoch{sample.epoch}
    , last_epoch{sample.epoch}
    , beam_lost{sample.quality() == Quality::beam_lost} {
    const auto reading = sample.value();
    if (!reading) return;
    good = 1;
    first_good_at = last_good_at = sample.at;
    first_good_u = last_good_u = sample.time_uncertainty;
    first_good_m = last_good_m = low_m = high_m = *reading;
}

void SampleSummary::append(const SampleSummary& next) {
    if (next.n == 0) return;
    if (n == 0) {
        *this = next;
        return;
    }
    longest_gap = std::max({longest_gap, next.longest_gap, Duration{next.first_at - last_at}});
    epoch_changed |= next.epoch_changed || next.first_epoch != last_epoch;
    beam_lost |= next.beam_lost;
    if (first_bad == Quality::good) first_bad = next.first_bad;
    if (next.good > 0) append_good(next);
    n += next.n;
    last_at = next.last_at;
    last_epoch = next.last_epoch;
}

void SampleSummary::append_good(const SampleSummary& next) {
    if (good == 0) {
        first_good_at = next.first_good_at;
        first_good_u = next.first_good_u;
        first_good_m = last_good_m = low_m = high_m = next.first_good_m;
    }
    const double jump_m = good == 0 ? 0 : next.first_good_m - last_good_m;
    const Duration between =
        next.first_good_at - last_good_at + open_between(last_good_u, next.first_good_u);
    fastest_jump = std::max({fastest_jump, next.fastest_jump, speed_of_jump(between, jump_m)});
    fall_m = std::max({fall_m, next.fall_m, high_m - next.low_m});
    rise_m = std::max({rise_m, next.rise_m, next.high_m - low_m});
    low_m = std::min(low_m, next.low_m);
    high_m = std::max(high_m, next.high_m);
    // The sums of `next` are about its own first sample; about this one's they grow by the shift.
    const double count = static_cast<double>(next.good);
    const double t = seconds_of(next.first_good_at - first_good_at);
    const double r = next.first_good_m - first_good_m;
    sum_tt_ += next.sum_tt_ + t * (2 * next.sum_t_ + count * t);
    sum_tr_ += next.sum_tr_ + t * (next.sum_r_ + count * r) + r * next.sum_t_;
    sum_t_ += next.sum_t_ + count * t;
    sum_r_ += next.sum_r_ + count * r;
    last_good_at = next.last_good_at;
    last_good_u = next.last_good_u;
    last_good_m = next.last_good_m;
    good += next.good;
}

double SampleSummary::mean_m() const {
    return good > 0 ? first_good_m + sum_r_ / static_cast<double>(good) : 0;
}

double SampleSummary::slope() const {
    if (good == 0) return 0;
    const double count = static_cast<double>(good);
    const double spread_t = sum_tt_ - sum_t_ * sum_t_ / count;
    return spread_t > 0 ? (sum_tr_ - sum_t_ * sum_r_ / count) / spread_t : 0;
}

bool SampleSummary::lost_count(Speed fastest) const {
    return epoch_changed || beam_lost || (fastest.si() > 0 && fastest_jump > fastest.si());
}

SampleSummary summary_of(std::span<const Sample> samples) {
    SampleSummary all;
    for (const Sample& sample : samples)
        all.append(SampleSummary{sample});
    return all;
}

} // namespace axiscal
