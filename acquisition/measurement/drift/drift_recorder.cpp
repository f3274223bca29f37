#include "acquisition/measurement/drift/drift_recorder.hpp"

#include <algorithm>

namespace axiscal {

DriftRecorder::DriftRecorder(DriftSetup setup,
                             int watched,
                             std::uint32_t epoch,
                             MonotonicTime begin)
    : setup_{setup}
    , watched_{watched}
    , epoch_{epoch}
    , begin_{begin}
    , next_due_{begin + setup.interval} {}

std::optional<EnvironmentReading>
DriftRecorder::mean_of(MonotonicTime now, const SampleHistory& watched, const DriftLimits& limits) {
    const auto window = watched.between(now - limits.window, now);
    if (window.size() < static_cast<std::size_t>(limits.minimum_samples)) return std::nullopt;
    const SampleSummary found = watched.summary_of(window);
    const bool one_zero = !found.epoch_changed && found.last_epoch == epoch_;
    if (found.good < found.n || !one_zero) return std::nullopt;
    return EnvironmentReading{watched_, now - limits.window / 2, found.mean_m()};
}

std::vector<EnvironmentReading> DriftRecorder::take(MonotonicTime now,
                                                    const SampleHistory& watched,
                                                    std::span<const std::optional<Sample>> latest,
                                                    const DriftLimits& limits) {
    next_due_ += setup_.interval;
    if (const auto newest = watched.newest(); newest && newest->epoch != epoch_) zero_lost_ = true;
    std::vector<EnvironmentReading> readings;
    if (const auto mean = mean_of(now, watched, limits)) {
        low_m_ = taken_ == 0 ? mean->value : std::min(low_m_, mean->value);
        high_m_ = taken_ == 0 ? mean->value : std::max(high_m_, mean->value);
        ++taken_;
        readings.push_back(*mean);
    } else {
        ++missing_;
    }
    last_taken_.resize(latest.size(), begin_ - limits.oldest);
    for (std::size_t channel = 0; channel < latest.size(); ++channel) {
        const auto& sample = latest[channel];
        if (!sample || static_cast<int>(channel) == watched_) continue;
        const bool fresh = sample->at > last_taken_[channel] && now - sample->at <= limits.oldest;
        if (!fresh || !sample->value()) continue;
        last_taken_[channel] = sample->at;
        readings.push_back({static_cast<int>(channel), sample->at, *sample->value()});
    }
    return readings;
}

std::optional<Length> DriftRecorder::range() const {
    if (taken_ < 2) return std::nullopt;
    return metre(high_m_ - low_m_);
}

} // namespace axiscal
