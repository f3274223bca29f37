#include "acquisition/capture/sample_history.hpp"

#include <algorithm>

namespace axiscal {

void SampleHistory::push(const Sample& sample) {
    if (samples_.size() > 0) {
        const Sample& last = samples_.all().back();
        if (sample.at < last.at) {
            ++disordered_;
            return;
        }
        if (sample.epoch == last.epoch && last.device_count != 0 &&
            sample.device_count > last.device_count + 1)
            ++gaps_;
    }
    if (!began_at_) began_at_ = sample.at;
    samples_.push(sample);
    summaries_.push(sample);
    forget_old(sample.at - limits_.depth);
}

void SampleHistory::forget_old(MonotonicTime oldest_wanted) {
    for (;;) {
        const MonotonicTime oldest = samples_.all().front().at;
        const bool wanted = oldest >= oldest_wanted && samples_.size() <= limits_.capacity;
        if (wanted || samples_.size() == 1) return;
        newest_forgotten_ = oldest;
        samples_.pop();
        summaries_.forget_before(++forgotten_);
    }
}

std::span<const Sample> SampleHistory::between(MonotonicTime begin, MonotonicTime end) const {
    const auto alive = all();
    const auto low = std::lower_bound(alive.begin(), alive.end(), begin,
                                      [](const Sample& s, MonotonicTime t) { return s.at < t; });
    const auto high = std::upper_bound(low, alive.end(), end,
                                       [](MonotonicTime t, const Sample& s) { return t < s.at; });
    return {low, high};
}

std::size_t SampleHistory::number_of(std::span<const Sample> part) const {
    return forgotten_ + static_cast<std::size_t>(part.data() - all().data());
}

SampleSummary SampleHistory::summary_of(std::span<const Sample> part) const {
    SampleSummary whole;
    if (part.empty()) return whole;
    const std::size_t begin = number_of(part);
    for (std::size_t i = 0; i < part.size();) {
        const auto block = summaries_.beginning_at(begin + i, begin + part.size());
        const SampleSummary next = block.summary ? *block.summary : SampleSummary{part[i]};
        whole.append(next);
        i += next.n;
    }
    return whole;
}

SummaryLevels::Block SampleHistory::last_block_of(std::span<const Sample> part,
                                                  std::size_t levels) const {
    if (part.empty()) return {};
    const std::size_t begin = number_of(part);
    return summaries_.ending_at(begin, begin + part.size(), levels);
}

std::optional<Sample> SampleHistory::newest() const {
    return samples_.size() == 0 ? std::nullopt : std::optional{all().back()};
}

bool SampleHistory::reaches_back_to(MonotonicTime instant) const {
    if (!began_at_ || *began_at_ > instant) return false;
    return !newest_forgotten_ || *newest_forgotten_ < instant;
}

Duration longest_silence(const SampleSummary& samples, MonotonicTime begin, MonotonicTime end) {
    if (samples.n == 0) return end - begin;
    return std::max(
        {samples.longest_gap, Duration{samples.first_at - begin}, Duration{end - samples.last_at}});
}

} // namespace axiscal
