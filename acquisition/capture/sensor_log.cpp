#include "acquisition/capture/sensor_log.hpp"

#include <algorithm>

namespace axiscal {

void SensorLog::take(const Sample& sample) {
    constexpr int kept_readings = 600;
    const auto value = sample.value();
    if (!value || (!readings_.empty() && sample.at <= readings_.back().at)) return;
    const Duration spacing = depth_ / kept_readings;
    const bool close =
        readings_.size() > 1 && sample.at - readings_[readings_.size() - 2].at < spacing;
    if (!close)
        readings_.push_back({sample.at, *value});
    else if (keep_ == Keep::newest || *value < readings_.back().value)
        readings_.back() = {sample.at, *value};
    while (readings_.size() > 2 && readings_[1].at <= sample.at - depth_)
        readings_.pop_front();
}

std::size_t SensorLog::unbroken_from(Duration window, MonotonicTime now) const {
    std::size_t first = readings_.size();
    for (MonotonicTime next = now; first > 0 && next - readings_[first - 1].at <= window / 2;)
        next = readings_[--first].at;
    return first;
}

DriftSeries SensorLog::last(Duration window, MonotonicTime now) const {
    DriftSeries series;
    const MonotonicTime begin = now - window;
    for (std::size_t i = unbroken_from(window, now); i < readings_.size(); ++i) {
        const Reading& reading = readings_[i];
        const bool before = i + 1 < readings_.size() && readings_[i + 1].at <= begin;
        if (before || reading.at > now) continue;
        series.times.push_back(seconds_of(reading.at - begin));
        series.readings.push_back(reading.value);
    }
    return series;
}

Duration SensorLog::covered(Duration window, MonotonicTime now) const {
    const std::size_t first = unbroken_from(window, now);
    return first < readings_.size() ? now - readings_[first].at : Duration{};
}

std::optional<double> SensorLog::lowest() const {
    if (readings_.empty()) return std::nullopt;
    return std::ranges::min_element(readings_, {}, &Reading::value)->value;
}

std::optional<double> SensorLog::newest() const {
    return readings_.empty() ? std::nullopt : std::optional{readings_.back().value};
}

} // namespace axiscal
