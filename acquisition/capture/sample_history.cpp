#include "acquisition/capture/sample_history.hpp"

#include <algorithm>

namespace axiscal {

void SampleHistory::push(const Sample& sample) {
    if (!samples_.empty()) {
        const Sample& last = samples_.back();
        if (sample.at < last.at) {
            ++disordered_;
            return;
        }
        if (sample.epoch != last.epoch)
            epoch_changed_at_ = sample.at;
        else if (last.device_count != 0 && sample.device_count > last.device_count + 1)
            ++gaps_;
    }
    if (!began_at_) began_at_ = sample.at;
    samples_.push_back(sample);
    forget_old();
}

void SampleHistory::forget_old() {
    const auto oldest_wanted = samples_.back().at - limits_.depth;
    while (samples_.size() - first_ > 1 &&
           (samples_[first_].at < oldest_wanted || samples_.size() - first_ > limits_.capacity)) {
        newest_forgotten_ = samples_[first_].at;
        ++first_;
    }
    // Compacting only when half is dead moves each sample at most once: O(1) amortised.
    if (first_ > 0 && first_ * 2 >= samples_.size()) {
        samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(first_));
        first_ = 0;
    }
}

std::span<const Sample> SampleHistory::all() const {
    return std::span{samples_}.subspan(first_);
}

std::span<const Sample> SampleHistory::between(MonotonicTime begin, MonotonicTime end) const {
    const auto alive = all();
    const auto low = std::lower_bound(alive.begin(), alive.end(), begin,
                                      [](const Sample& s, MonotonicTime t) { return s.at < t; });
    const auto high = std::upper_bound(low, alive.end(), end,
                                       [](MonotonicTime t, const Sample& s) { return t < s.at; });
    return {low, high};
}

std::optional<Sample> SampleHistory::newest() const {
    return samples_.empty() ? std::nullopt : std::optional{samples_.back()};
}

bool SampleHistory::reaches_back_to(MonotonicTime instant) const {
    if (!began_at_ || *began_at_ > instant) return false;
    return !newest_forgotten_ || *newest_forgotten_ < instant;
}

Duration longest_silence(std::span<const Sample> samples, MonotonicTime begin, MonotonicTime end) {
    auto previous = begin;
    Duration longest{};
    for (const auto& sample : samples) {
        longest = std::max(longest, Duration{sample.at - previous});
        previous = sample.at;
    }
    return std::max(longest, Duration{end - previous});
}

} // namespace axiscal
