#pragma once
// The sums that every evaluation of a deviation table shares. Fixed order, `+ - * /` alone.

#include <algorithm>
#include <vector>

namespace axiscal {

/// Mean, n >= 1. Re-based on the first value: equal values have exactly that mean, and long
/// coordinates cost no digits.
inline double mean_of(const std::vector<double>& values) {
    const double base = values.front();
    double sum = 0;
    for (const double value : values)
        sum += value - base;
    return base + sum / static_cast<double>(values.size());
}

/// Smallest and largest of what was put in; ask nothing of an empty one.
class Span {
public:
    void include(double low, double high) {
        low_ = empty_ ? low : std::min(low_, low);
        high_ = empty_ ? high : std::max(high_, high);
        empty_ = false;
    }
    void include(double value) { include(value, value); }
    [[nodiscard]] double width() const { return high_ - low_; }
    [[nodiscard]] double high() const { return high_; }
    [[nodiscard]] double low() const { return low_; }
    [[nodiscard]] bool empty() const { return empty_; }

private:
    bool empty_ = true;
    double low_ = 0, high_ = 0;
};

} // namespace axiscal
