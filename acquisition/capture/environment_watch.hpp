#pragma once
// The latest good reading of each environment channel, with its age. A stale or absent value can
// never pass as a number: there is no way to ask for a value without a limit of age.

#include "analysis/quantity/result.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

enum class EnvironmentRole : std::uint8_t {
    air_temperature,
    air_pressure,
    air_humidity,
    material_temperature,
    scale_temperature ///< of the scale that measures the axis
};
std::string_view name_of(EnvironmentRole role); ///< "air temperature"

struct WatchedChannel {
    EnvironmentRole role = EnvironmentRole::air_temperature;
    std::string name, place; ///< for sentences: "material 2", "table left"
};

struct FreshReading {
    double value = 0; ///< as taken, in stored_unit_of(kind)
    MonotonicTime at;
    Duration age;
};

/// Loop-bound.
class EnvironmentWatch {
public:
    explicit EnvironmentWatch(std::vector<WatchedChannel> channels);

    /// `channel` is the place in the list given to the constructor. A bad sample voids the good
    /// one before it: the sensor itself says that it does not know.
    void take(std::size_t channel, const Sample& sample);

    /// Empty when nothing good came last, when it is older than `limit`, or when it claims to come
    /// from the future.
    [[nodiscard]] std::optional<FreshReading>
    fresh(std::size_t channel, MonotonicTime now, Duration limit) const;
    /// Mean of the fresh channels of a role; empty unless every channel of that role is fresh.
    [[nodiscard]] std::optional<double>
    fresh_mean(EnvironmentRole role, MonotonicTime now, Duration limit) const;
    /// @errors Fault::environment_stale naming the first channel that is not fresh, its place and
    /// its age.
    [[nodiscard]] Result<void> check(MonotonicTime now, Duration limit) const;

    [[nodiscard]] const std::vector<WatchedChannel>& channels() const { return channels_; }

private:
    std::vector<WatchedChannel> channels_;
    std::vector<std::optional<Sample>> latest_;
};

} // namespace axiscal
