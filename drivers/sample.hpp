#pragma once
// What an instrument hands up: a value with its time, its source and its quality. Pure data.

#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace axiscal {

enum class Quality : std::uint8_t {
    good,
    signal_error, ///< the instrument flags the value (phase error, slew)
    beam_lost,    ///< no measuring or reference signal
    absent,       ///< sensor not connected, out of range
};
std::string_view name_of(Quality quality);

/// A channel of one instrument, as its driver declares it. `channel` numbers are per instrument.
struct Channel {
    std::string name; ///< "axis 1", "air temperature", "contact 2"
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
};

/// One reading. The number can be had only through `value()`, which is empty unless it is good:
/// a stale or absent value can never pass as a number.
class Sample {
public:
    Sample() = default;
    Sample(int of_channel,
           MonotonicTime when,
           double stored_value,
           std::uint64_t count = 0,
           std::uint32_t zero_epoch = 0)
        : at{when}
        , device_count{count}
        , channel{of_channel}
        , epoch{zero_epoch}
        , value_{stored_value}
        , quality_{std::isfinite(stored_value) ? Quality::good : Quality::absent} {}
    static Sample bad(int of_channel,
                      MonotonicTime when,
                      Quality why,
                      std::uint64_t count = 0,
                      std::uint32_t zero_epoch = 0) {
        Sample sample{of_channel, when, 0.0, count, zero_epoch};
        sample.quality_ = why;
        return sample;
    }
    /// In stored_unit_of(kind): m, degC, Pa, %, ppm, arcsec. Displacement: of an interferometer vacuum
    /// wavelengths (n = 1), of a gauge or ballbar the length itself.
    [[nodiscard]] std::optional<double> value() const {
        return quality_ == Quality::good ? std::optional{value_} : std::nullopt;
    }
    [[nodiscard]] Quality quality() const { return quality_; }
    /// The same reading of another channel number, `correction` added to its number.
    [[nodiscard]] Sample corrected(int of_channel, double correction) const {
        Sample sample = *this;
        sample.channel = of_channel;
        sample.value_ += correction;
        return sample;
    }

    MonotonicTime at{};
    Duration time_uncertainty{};    ///< u(t) of `at`, standard; 0 where the driver states none
    std::uint64_t device_count = 0; ///< the instrument's own sample number, 0 if none
    int channel = 0;
    std::uint32_t epoch = 0; ///< rises whenever an incremental counter lost its zero

private:
    double value_ = 0;
    Quality quality_ = Quality::absent;
};

} // namespace axiscal
