#pragma once
// The lowest and highest reading of each stretch of a stream, for viewing. Pure.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace axiscal {

struct MinMax {
    double low = 0, high = 0;
    bool operator==(const MinMax&) const = default;
};

/// Two comparisons a sample; memory does not grow: when every stretch is taken, neighbours are
/// joined and each then stands for twice as many samples.
class MinMaxPyramid {
public:
    /// @param stretches  at least 2, even: as many are kept at most, and half as many at least once
    ///                   there are enough samples.
    explicit MinMaxPyramid(std::size_t stretches = 4096);

    /// Numbers, no NaN. As quick as reading them when many come at once.
    void push(std::span<const double> values);
    void push(double value) { push({&value, 1}); }
    [[nodiscard]] std::uint64_t samples() const { return samples_; }
    /// Samples that one stretch stands for; the last may hold fewer.
    [[nodiscard]] std::uint64_t samples_a_stretch() const { return width_; }
    /// At most `most` stretches that cover the whole stream in order, none cut in two.
    [[nodiscard]] std::vector<MinMax> view(std::size_t most) const;
    /// Samples that each stretch of such a view stands for; the last may hold fewer.
    [[nodiscard]] std::uint64_t samples_of_each(std::size_t most) const {
        return width_ * joined_for(most);
    }

private:
    void open_stretch();
    void join_neighbours();
    /// How many stretches a view of at most `most` joins into one.
    [[nodiscard]] std::size_t joined_for(std::size_t most) const;

    std::size_t most_;
    std::uint64_t width_ = 1, samples_ = 0, in_last_ = 0;
    std::vector<MinMax> stretches_;
};

} // namespace axiscal
