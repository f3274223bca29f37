#pragma once
// What one sensor has shown lately: the pre-flight checks look back on it.

#include "analysis/drift/drift.hpp"
#include "drivers/sample.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace axiscal {

/// The last minutes of one sensor, thinned. Pure.
class SensorLog {
public:
    enum class Keep : std::uint8_t { newest, lowest }; ///< of readings that stand too close
    /// Some 600 readings within `depth`, and the last one before it.
    explicit SensorLog(Duration depth, Keep keep = Keep::newest)
        : depth_{depth}
        , keep_{keep} {}
    /// Bad readings are none; one older than its predecessor is dropped.
    void take(const Sample& sample);
    /// The readings that span the last `window`, the last one before it included, so that a sensor
    /// that is asked seldom spans it, too; none from before a break of more than half the window.
    /// Times are seconds since the window's beginning, that one's negative.
    [[nodiscard]] DriftSeries last(Duration window, MonotonicTime now) const;
    /// How long the sensor has been read without such a break until now; 0 without a reading.
    [[nodiscard]] Duration covered(Duration window, MonotonicTime now) const;
    [[nodiscard]] std::optional<double> lowest() const;
    [[nodiscard]] std::optional<double> newest() const;

private:
    struct Reading {
        MonotonicTime at;
        double value = 0;
    };
    /// The first reading after the last break.
    [[nodiscard]] std::size_t unbroken_from(Duration window, MonotonicTime now) const;

    Duration depth_;
    Keep keep_;
    std::deque<Reading> readings_;
};

} // namespace axiscal
