#include "acquisition/capture/min_max_pyramid.hpp"

#include <algorithm>

namespace axiscal {
namespace {

MinMax joined(const MinMax& a, const MinMax& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

} // namespace

MinMaxPyramid::MinMaxPyramid(std::size_t stretches)
    : most_{std::max<std::size_t>(2, stretches + stretches % 2)} {
    stretches_.reserve(most_);
}

void MinMaxPyramid::push(double value) {
    ++samples_;
    if (!stretches_.empty() && in_last_ < width_) {
        ++in_last_;
        stretches_.back() = joined(stretches_.back(), {value, value});
        return;
    }
    if (stretches_.size() == most_) join_neighbours();
    stretches_.push_back({value, value});
    in_last_ = 1;
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
