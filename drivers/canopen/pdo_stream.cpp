#include "drivers/canopen/pdo_stream.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t most_held = 32;
constexpr int follow = 64; ///< a frame's delay moves the clock by a 64th of it

/// Later than this a frame may mean that one is missing.
Duration suspicious(Duration period) {
    return period * 7 / 10;
}

} // namespace

PdoStream::PdoStream(Duration period)
    : period_{period} {}

void PdoStream::restart() {
    due_.reset();
    held_.clear();
    number_ = dropped_ = 0;
}

void PdoStream::lose(std::uint64_t samples) {
    lost_ += samples;
    number_ += samples;
    *due_ += period_ * static_cast<std::int64_t>(samples);
}

PdoStream::Numbered PdoStream::number(const PdoArrival& arrival) {
    const Duration delay = arrival.at - *due_;
    // What was held up says nothing about the device's clock.
    *due_ += delay < Duration::zero() ? delay : std::min(delay, suspicious(period_)) / follow;
    Numbered numbered{arrival, ++number_, *due_};
    *due_ += period_;
    return numbered;
}

std::vector<PdoStream::Numbered> PdoStream::settle() {
    std::vector<Numbered> settled;
    settled.reserve(held_.size());
    for (const PdoArrival& arrival : std::exchange(held_, {}))
        settled.push_back(number(arrival));
    return settled;
}

std::vector<PdoStream::Numbered> PdoStream::finish() {
    if (!held_.empty()) lose(static_cast<std::uint64_t>((least_delay_ + period_ / 2) / period_));
    return settle();
}

std::vector<PdoStream::Numbered> PdoStream::take(const PdoArrival& arrival) {
    if (!due_) {
        due_ = arrival.at;
        dropped_ = arrival.dropped;
    }
    std::vector<Numbered> settled;
    if (const std::uint64_t dropped = arrival.dropped - std::exchange(dropped_, arrival.dropped)) {
        settled = settle(); // what was late before it was late for this reason
        lose(dropped);
    }
    const Duration delay = arrival.at - *due_ - period_ * static_cast<std::int64_t>(held_.size());
    least_delay_ = held_.empty() ? delay : std::min(least_delay_, delay);
    held_.push_back(arrival);
    const bool caught_up = delay <= suspicious(period_);
    if (!caught_up && held_.size() < most_held) return settled;
    auto rest = caught_up ? settle() : finish();
    settled.insert(settled.end(), std::make_move_iterator(rest.begin()),
                   std::make_move_iterator(rest.end()));
    return settled;
}

} // namespace axiscal
