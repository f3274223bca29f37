#include "analysis/drift/drift.hpp"

#include "analysis/checked_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace axiscal {
namespace {

double u_of_range(double range) {
    return range / (2 * std::sqrt(3.0));
}

/// Indices whose readings fall (or rise) from front to back: the front is the extreme of the
/// window. Each sample enters and leaves once.
template <class Before> class ExtremeOfWindow {
public:
    explicit ExtremeOfWindow(const std::vector<double>& readings)
        : readings_{readings} {}
    void push(std::size_t index) {
        while (!indices_.empty() && !Before{}(readings_[indices_.back()], readings_[index]))
            indices_.pop_back();
        indices_.push_back(index);
    }
    void forget_before(std::size_t index) {
        while (indices_.front() < index)
            indices_.pop_front();
    }
    [[nodiscard]] double value() const { return readings_[indices_.front()]; }

private:
    const std::vector<double>& readings_;
    std::deque<std::size_t> indices_;
};

double largest_time(const DriftSeries& series) {
    return std::max(std::fabs(series.times.front()), std::fabs(series.times.back()));
}

} // namespace

DriftRange total_range(const DriftSeries& series) {
    const auto [low, high] = std::ranges::minmax(series.readings);
    return {high - low, 0, series.readings.size() - 1, u_of_range(high - low)};
}

DriftRange largest_window_range(const DriftSeries& series, double window) {
    const double slack = 8 * std::numeric_limits<double>::epsilon() * largest_time(series);
    ExtremeOfWindow<std::greater<>> high{series.readings};
    ExtremeOfWindow<std::less<>> low{series.readings};
    DriftRange largest;
    std::size_t first = 0;
    for (std::size_t last = 0; last < series.readings.size(); ++last) {
        high.push(last);
        low.push(last);
        while (series.times[last] - series.times[first] > window + slack)
            ++first;
        high.forget_before(first);
        low.forget_before(first);
        const double range = high.value() - low.value();
        if (range > largest.range) largest = {range, first, last, u_of_range(range)};
    }
    return largest;
}

std::optional<double> least_squares_slope(const DriftSeries& series) {
    const std::size_t count = series.times.size();
    if (count < 2) return std::nullopt;
    const double first_t = series.times.front(), first_x = series.readings.front();
    double mean_t = 0, mean_x = 0, tt = 0, tx = 0; // all against the first sample
    for (std::size_t i = 0; i < count; ++i) {
        mean_t += (series.times[i] - first_t) / static_cast<double>(count);
        mean_x += (series.readings[i] - first_x) / static_cast<double>(count);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double from_mean = series.times[i] - first_t - mean_t;
        tt += from_mean * from_mean;
        tx += from_mean * (series.readings[i] - first_x - mean_x);
    }
    return tx / tt;
}

std::optional<double> change_at(const DriftSeries& series, double time) {
    const auto& t = series.times;
    const auto& x = series.readings;
    if (!(time >= t.front() && time <= t.back())) return std::nullopt;
    const auto after =
        static_cast<std::size_t>(std::ranges::lower_bound(t, time) - t.begin()); // t[after] >= time
    if (t[after] == time) return x[after] - x.front();
    const std::size_t before = after - 1;
    const double share = (time - t[before]) / (t[after] - t[before]);
    return x[before] - x.front() + share * (x[after] - x[before]);
}

Result<void> check_series(const DriftSeries& series, const std::string& name, std::size_t fewest) {
    AXISCAL_CHECK(check_rising(series.times, name + ".time"));
    AXISCAL_CHECK(check_case_numbers(series.readings, name + ".readings"));
    if (series.readings.size() != series.times.size())
        return refuse(Fault::bad_case, name + ".readings",
                      "has " + std::to_string(series.readings.size()) + " readings for " +
                          std::to_string(series.times.size()) + " times");
    if (series.readings.size() < fewest)
        return refuse(Fault::bad_case, name + ".readings",
                      "needs at least " + std::to_string(fewest) + " readings");
    return {};
}

Result<DriftSeries>
tilt_between(const DriftSeries& first, const DriftSeries& second, double distance) {
    AXISCAL_CHECK(check_positive(distance, "distance"));
    if (first.times != second.times)
        return refuse(Fault::bad_case, "channels", "must be sampled at the same times");
    DriftSeries tilt{first.times, first.readings};
    for (std::size_t i = 0; i < tilt.readings.size(); ++i)
        tilt.readings[i] = (first.readings[i] - second.readings[i]) / distance;
    return tilt;
}

} // namespace axiscal
