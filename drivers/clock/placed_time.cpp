#include "drivers/clock/placed_time.hpp"

#include <algorithm>
#include <numbers>

namespace axiscal {
namespace {

/// Standard uncertainty of what lies anywhere within +-`half`.
Duration rectangular(Duration half) {
    return std::max(from_seconds(seconds_of(half) / std::numbers::sqrt3), Duration{1});
}

} // namespace

PlacedTime placed_between(MonotonicTime asked, MonotonicTime answered) {
    const Duration half = std::max(answered - asked, Duration{}) / 2;
    return {asked + half, rectangular(half)};
}

PlacedTime placed_at_end(MonotonicTime end, Duration oldest) {
    // The mean square of an age between 0 and `oldest` is oldest^2 / 3 as well.
    return {end, rectangular(std::max(oldest, Duration{}))};
}

Sample sample_at(int channel, const PlacedTime& placed, std::optional<double> value) {
    Sample sample = value ? Sample{channel, placed.at, *value}
                          : Sample::bad(channel, placed.at, Quality::absent);
    sample.time_uncertainty = placed.uncertainty;
    return sample;
}

} // namespace axiscal
