#include "analysis/drift/settling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axiscal {
namespace {

/// Count, means and centred second moments of some samples; two of them merge without loss
/// (Chan, Golub and LeVeque 1983).
struct Moments {
    double count = 0, mean_t = 0, mean_x = 0, tt = 0, tx = 0;
};

Moments merged(const Moments& a, const Moments& b) {
    if (a.count == 0) return b;
    if (b.count == 0) return a;
    const double count = a.count + b.count, share = b.count / count;
    const double dt = b.mean_t - a.mean_t, dx = b.mean_x - a.mean_x;
    return {count, a.mean_t + dt * share, a.mean_x + dx * share,
            a.tt + b.tt + dt * dt * a.count * share, a.tx + b.tx + dt * dx * a.count * share};
}

/// A queue of samples that knows the moments of all it holds, by two stacks: what leaves was
/// summed from the other side, so nothing is ever subtracted.
class MomentQueue {
public:
    void push(double t, double x) {
        arriving_.push_back({1, t, x, 0, 0});
        of_arriving_ = merged(of_arriving_, arriving_.back());
    }
    void pop() {
        if (leaving_.empty()) turn_over();
        leaving_.pop_back();
    }
    [[nodiscard]] Moments all() const {
        return leaving_.empty() ? of_arriving_ : merged(leaving_.back(), of_arriving_);
    }

private:
    void turn_over() {
        for (; !arriving_.empty(); arriving_.pop_back())
            leaving_.push_back(leaving_.empty() ? arriving_.back()
                                                : merged(arriving_.back(), leaving_.back()));
        of_arriving_ = {};
    }

    std::vector<Moments> arriving_, leaving_; ///< leaving_.back(): moments of all that leave
    Moments of_arriving_;
};

double slack_of(const DriftSeries& series) {
    return 8 * std::numeric_limits<double>::epsilon() *
           std::max(std::fabs(series.times.front()), std::fabs(series.times.back()));
}

/// The first sample from which on all readings lie within `band`.
std::size_t first_within(const DriftSeries& series, double band) {
    const auto& x = series.readings;
    std::size_t first = x.size() - 1;
    double low = x[first], high = x[first];
    while (first > 0) {
        low = std::min(low, x[first - 1]);
        high = std::max(high, x[first - 1]);
        if (high - low > band) break;
        --first;
    }
    return first;
}

/// The first sample such that every window that begins at or after it is flat enough; empty
/// where no window begins after the last steep one.
std::optional<std::size_t> first_flat(const std::vector<WindowSlope>& slopes, double limit) {
    if (slopes.empty()) return std::nullopt;
    for (std::size_t i = slopes.size(); i-- > 0;)
        if (std::fabs(slopes[i].slope) > limit) {
            const std::size_t first = slopes[i].first + 1;
            return slopes.back().first >= first ? std::optional{first} : std::nullopt;
        }
    return 0;
}

} // namespace

std::vector<WindowSlope> window_slopes(const DriftSeries& series, double window) {
    const double slack = slack_of(series);
    const auto& t = series.times;
    std::vector<WindowSlope> slopes;
    MomentQueue queue;
    std::size_t first = 0;
    for (std::size_t last = 0; last < t.size(); ++last) {
        queue.push(t[last], series.readings[last]);
        for (; t[last] - t[first] > window + slack; ++first)
            queue.pop();
        const bool whole = t[last] - t.front() >= window - slack;
        const Moments moments = queue.all();
        if (whole && last > first) slopes.push_back({first, last, moments.tx / moments.tt});
    }
    return slopes;
}

std::optional<WindowSlope> steepest_window(const DriftSeries& series, double window) {
    const auto slopes = window_slopes(series, window);
    const auto steepest = std::ranges::max_element(
        slopes, {}, [](const WindowSlope& slope) { return std::fabs(slope.slope); });
    if (steepest == slopes.end()) return std::nullopt;
    return *steepest;
}

std::optional<std::size_t> settled_from(const DriftSeries& series, const SettlingRule& rule) {
    std::size_t first = 0;
    if (rule.band) first = first_within(series, *rule.band);
    if (rule.slope) {
        const auto flat = first_flat(window_slopes(series, rule.window), *rule.slope);
        if (!flat) return std::nullopt;
        first = std::max(first, *flat);
    }
    const double held = series.times.back() - series.times[first];
    if (held < rule.window - slack_of(series)) return std::nullopt;
    return first;
}

} // namespace axiscal
