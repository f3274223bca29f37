#include "acquisition/capture/stream_chunker.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {

StreamChunker::StreamChunker(const StreamBlock& last, bool numbers_ran_on)
    : stream_{last.stream}
    , next_index_{last.index + 1}
    , interrupted_{true} {
    const auto in_block = static_cast<std::uint64_t>(std::max(last.samples, 1));
    const bool counted = numbers_ran_on && last.first_count != 0;
    last_ = Sample{0, last.end, 0.0, counted ? last.first_count + in_block - 1 : 0, 0};
}

std::optional<StreamChunk> StreamChunker::finish() {
    if (chunk_.value.empty()) return std::nullopt;
    StreamChunk full = std::exchange(chunk_, {});
    full.head.stream = stream_;
    full.head.index = next_index_++;
    return full;
}

/// Sets what stands before the next chunk, if this sample does not go on from the last.
void StreamChunker::look_for_hole(const Sample& sample) {
    if (!last_ || !before_.empty()) return;
    const bool skips = last_->device_count != 0 && sample.device_count > last_->device_count + 1;
    if (std::exchange(interrupted_, false)) {
        before_ = "interrupted";
        if (skips) missing_before_ = sample.device_count - last_->device_count - 1;
    } else if (sample.epoch != last_->epoch) {
        before_ = "epoch";
    } else if (skips) {
        before_ = "gap";
        missing_before_ = sample.device_count - last_->device_count - 1;
    }
    if (before_.empty()) return;
    ++gaps_;
    missing_ += missing_before_;
}

/// An instrument that numbers its samples may place one a little before the last: the number
/// counts. Without numbers it is dropped and counted.
bool StreamChunker::wanted(const Sample& sample) {
    if (!last_ || sample.at > last_->at) return true;
    if (sample.device_count != 0) return true;
    ++disordered_;
    return false;
}

std::optional<StreamChunk> StreamChunker::push(const Sample& sample) {
    const auto value = sample.value();
    if (!value) {
        if (before_.empty()) ++gaps_;
        before_ = std::exchange(interrupted_, false) ? "interrupted" : name_of(sample.quality());
        return finish();
    }
    if (!wanted(sample)) return std::nullopt;
    look_for_hole(sample);
    std::optional<StreamChunk> full;
    const bool old = !chunk_.at.empty() && sample.at - chunk_.at.front() >= longest;
    if (!before_.empty() || old || chunk_.value.size() >= most_samples) full = finish();
    if (chunk_.value.empty()) {
        chunk_.head.first_count = sample.device_count;
        chunk_.head.before = std::exchange(before_, {});
        chunk_.head.missing = std::exchange(missing_before_, 0);
        chunk_.head.time_uncertainty = sample.time_uncertainty;
    }
    Duration& largest = chunk_.head.time_uncertainty;
    const bool stated = largest > Duration{} && sample.time_uncertainty > Duration{};
    largest = stated ? std::max(largest, sample.time_uncertainty) : Duration{};
    Sample placed = sample;
    if (last_ && placed.at <= last_->at) placed.at = last_->at + Duration{1};
    chunk_.at.push_back(placed.at);
    chunk_.value.push_back(*value);
    last_ = placed;
    ++samples_;
    return full;
}

} // namespace axiscal
