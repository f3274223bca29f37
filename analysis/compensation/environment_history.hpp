#pragma once
// What the sensors said at an instant, from the readings of a run. Pure.

#include "analysis/air/air_refraction.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/temperature.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Readings of a run, channel by channel. Each figure is the mean of the channels of its kind, each
/// interpolated linearly between the readings before and after; before the first and after the
/// last reading the nearest one holds. A channel without a medium stands beside the run and counts
/// in none of them.
/// `what` names the point in messages ("step 12").
/// @errors Fault::environment_stale when there is no such channel, or when a channel's nearer
/// reading is further than AirSetup::oldest; bad_run_file for a reading that is not a number.
class EnvironmentHistory {
public:
    explicit EnvironmentHistory(const RunRecord& run);

    /// Air temperature, pressure and humidity must be measured; CO2 is AirSetup's where it is not.
    [[nodiscard]] Result<AirState> air_at(MonotonicTime at, const std::string& what) const;
    [[nodiscard]] Result<Temperature> material_at(MonotonicTime at, const std::string& what) const;
    /// Of the scale that measures the axis (RunRecord::scale).
    [[nodiscard]] Result<Temperature> scale_at(MonotonicTime at, const std::string& what) const;

private:
    struct Channel {
        ChannelRecord record;
        std::vector<EnvironmentReading> readings; ///< by time
    };
    [[nodiscard]] Result<double>
    value_of(const Channel& channel, MonotonicTime at, const std::string& what) const;
    [[nodiscard]] Result<double> mean_of(const std::vector<Channel>& channels,
                                         const char* name,
                                         MonotonicTime at,
                                         const std::string& what) const;

    std::vector<Channel> air_temperature_, pressure_, humidity_, carbon_dioxide_, material_, scale_;
    Length vacuum_wavelength_;
    double stated_co2_ppm_;
    Duration oldest_;
};

} // namespace axiscal
