#include "acquisition/capture/min_max_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace axiscal {
namespace {

MinMax joined(const MinMax& a, const MinMax& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

constexpr MinMax nothing{std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()};

/// Two numbers abreast and four such pairs in turn: a comparison need not wait for the one before.
MinMax range_of(std::span<const double> values) {
    using Pair = double __attribute__((vector_size(16)));
    constexpr std::size_t pairs = 4, step = 2 * pairs;
    std::array<Pair, pairs> low{}, high{};
    low.fill(Pair{nothing.low, nothing.low});
    high.fill(Pair{nothing.high, nothing.high});
    for (; values.size() >= step; values = values.subspan(step)) {
        for (std::size_t i = 0; i < pairs; ++i) {
            Pair pair;
            std::memcpy(&pair, values.data() + 2 * i, sizeof pair);
            low[i] = pair < low[i] ? pair : low[i];
            high[i] = pair > high[i] ? pair : high[i];
        }
    }
    MinMax range = nothing;
    for (std::size_t i = 0; i < step; ++i)
        range = joined(range, {low[i / 2][i % 2], high[i / 2][i % 2]});
    for (const double value : values)
        range = joined(range, {value, value});
    return range;
}

} // namespace

MinMaxPyramid::MinMaxPyramid(std::size_t stretches)
    : most_{std::max<std::size_t>(2, stretches + stretches % 2)} {
    stretches_.reserve(most_);
}

void MinMaxPyramid::push(std::span<const double> values) {
    while (!values.empty()) {
        if (stretches_.empty() || in_last_ == width_) open_stretch();
        const auto part = values.first(std::min<std::size_t>(values.size(), width_ - in_last_));
        stretches_.back() = joined(stretches_.back(), range_of(part));
        in_last_ += part.size();
        samples_ += part.size();
        values = values.subspan(part.size());
    }
}

void MinMaxPyramid::open_stretch() {
    if (stretches_.size() == most_) join_neighbours();
    stretches_.push_back(nothing);
    in_last_ = 0;
}

/// All stretches are full here, and their number is even.
void MinMaxPyramid::join_neighbours() {
    for (std::size_t i = 0; i < most_ / 2; ++i)
        stretches_[i] = joined(stretches_[2 * i], stretches_[2 * i + 1]);
    stretches_.resize(most_ / 2);
    width_ *= 2;
}

std::size_t MinMaxPyramid::joined_for(std::size_t most) const {
    const std::size_t wanted = std::max<std::size_t>(1, most);
    return std::max<std::size_t>(1, (stretches_.size() + wanted - 1) / wanted);
}

std::vector<MinMax> MinMaxPyramid::view(std::size_t most) const {
    const std::size_t share = joined_for(most);
    std::vector<MinMax> seen;
    seen.reserve(stretches_.size() / share + 1);
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
        if (i % share == 0)
            seen.push_back(stretches_[i]);
        else
            seen.back() = joined(seen.back(), stretches_[i]);
    }
    return seen;
}

} // namespace axiscal
