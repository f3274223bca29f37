#pragma once
// A few doubles side by side, in registers of the baseline processor: arithmetic lane by lane,
// each lane rounded as a double alone would be.

#include <cmath>
#include <cstddef>
#include <cstring>

namespace axiscal::circle {

/// One register. For many sums at a time, which want every register there is.
class Pair {
public:
    static constexpr std::size_t lanes = 2;

    Pair(double value = 0)
        : both_{value, value} {} // as in 2 * pair
    static Pair load(const double* from) {
        Pair out;
        std::memcpy(&out.both_, from, sizeof out.both_);
        return out;
    }

    friend Pair operator+(Pair a, Pair b) { return Pair{a.both_ + b.both_}; }
    friend Pair operator-(Pair a, Pair b) { return Pair{a.both_ - b.both_}; }
    friend Pair operator*(Pair a, Pair b) { return Pair{a.both_ * b.both_}; }
    friend Pair operator/(Pair a, Pair b) { return Pair{a.both_ / b.both_}; }
    friend Pair smaller(Pair a, Pair b) { return Pair{a.both_ < b.both_ ? a.both_ : b.both_}; }
    friend Pair larger(Pair a, Pair b) { return Pair{a.both_ > b.both_ ? a.both_ : b.both_}; }
    friend Pair root(Pair a) { return Pair{Both{std::sqrt(a.both_[0]), std::sqrt(a.both_[1])}}; }

    [[nodiscard]] double operator[](std::size_t lane) const { return both_[lane]; }
    void add_to_lane(std::size_t lane, double value) { both_[lane] += value; }
    [[nodiscard]] double sum() const { return both_[0] + both_[1]; }

private:
    typedef double Both __attribute__((vector_size(2 * sizeof(double))));
    explicit Pair(Both both)
        : both_{both} {}
    Both both_;
};

/// Two registers. For few sums, of which each would wait for its last addition.
class Four {
public:
    static constexpr std::size_t lanes = 4;

    Four(double value = 0)
        : low_{value}
        , high_{value} {}
    static Four load(const double* from) { return {Pair::load(from), Pair::load(from + 2)}; }

    friend Four operator+(Four a, Four b) { return {a.low_ + b.low_, a.high_ + b.high_}; }
    friend Four operator-(Four a, Four b) { return {a.low_ - b.low_, a.high_ - b.high_}; }
    friend Four operator*(Four a, Four b) { return {a.low_ * b.low_, a.high_ * b.high_}; }
    friend Four smaller(Four a, Four b) {
        return {smaller(a.low_, b.low_), smaller(a.high_, b.high_)};
    }
    friend Four larger(Four a, Four b) {
        return {larger(a.low_, b.low_), larger(a.high_, b.high_)};
    }

    [[nodiscard]] double operator[](std::size_t lane) const {
        return lane < 2 ? low_[lane] : high_[lane - 2];
    }
    void add_to_lane(std::size_t lane, double value) {
        lane < 2 ? low_.add_to_lane(lane, value) : high_.add_to_lane(lane - 2, value);
    }
    [[nodiscard]] double sum() const { return low_.sum() + high_.sum(); }

private:
    Four(Pair low, Pair high)
        : low_{low}
        , high_{high} {}
    Pair low_, high_;
};

inline double root(double value) {
    return std::sqrt(value);
}

} // namespace axiscal::circle
