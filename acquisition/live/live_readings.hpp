#pragma once
// What every channel reads now: of what measures the axis its last seconds, of the environment what
// is fresh, and whether it lies within the limits of the station file. Loop-bound.

#include "acquisition/capture/environment_watch.hpp"
#include "acquisition/capture/sample_history.hpp"
#include "acquisition/capture/sample_rate.hpp"
#include "acquisition/capture/sensor_log.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "config/station_config.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

class LiveReadings {
public:
    /// @param config  outlives this
    LiveReadings(const StationConfig& config,
                 const StationRoles& roles,
                 const std::vector<StationChannel>& channels);

    /// Of any channel, first of all.
    void take(const Sample& sample) { latest_[index_of(sample.channel)] = sample; }
    /// Of what measures the axis: laser, scale or autocollimator.
    void take_reference(const Sample& sample) { reference_.push(sample); }
    void take_bar(const Sample& sample) { bar_rate_.take(sample); }
    /// Of a sensor. @returns whether it is one of the environment
    bool take_sensor(const Sample& sample);
    void log(const Sample& sample) { logs_[index_of(sample.channel)].take(sample); }

    [[nodiscard]] const std::optional<Sample>& latest(int channel) const {
        return latest_[index_of(channel)];
    }
    [[nodiscard]] const std::vector<std::optional<Sample>>& latest() const { return latest_; }
    [[nodiscard]] const SampleHistory& reference() const { return reference_; }
    [[nodiscard]] const SensorLog& log_of(int channel) const { return logs_[index_of(channel)]; }
    [[nodiscard]] double bar_rate_hz() const { return bar_rate_.hz(); }

    /// @errors Fault::environment_stale naming the first channel that is not fresh.
    [[nodiscard]] Result<void> environment_is_fresh(MonotonicTime now) const;
    /// Empty unless every channel of that role is fresh.
    [[nodiscard]] std::optional<double> mean(EnvironmentRole role, MonotonicTime now) const;

    /// By how much more than 1 a reading is to be multiplied to be a distance at 20 degC: index of
    /// air and expansion of this moment.
    /// @errors as environment_is_fresh(); those of refractivity_of().
    [[nodiscard]] Result<double> scale_minus_1(MonotonicTime now, Length vacuum_wavelength) const;
    /// The last one known; for live positions only.
    [[nodiscard]] double last_scale_minus_1() const { return scale_; }
    void keep_scale(double minus_1) { scale_ = minus_1; }

    /// Compares the environment with its limits, once a second.
    /// @returns a sentence and its fault when it leaves them, and when it is back for good
    struct News {
        std::string sentence;
        Fault fault = Fault::none;
    };
    std::optional<News> judge_limits(const std::vector<SensorFacts>& sensors, MonotonicTime now);
    /// What lies outside, while it does.
    [[nodiscard]] const std::optional<Error>& outside() const { return outside_; }

private:
    static std::size_t index_of(int channel) { return static_cast<std::size_t>(channel); }
    [[nodiscard]] double
    strain(EnvironmentRole role, Expansion coefficient, MonotonicTime now) const;

    const StationConfig& config_;
    SampleHistory reference_;
    EnvironmentWatch watch_;
    std::vector<int> environment_;              ///< channels, in the order of watch_
    std::vector<std::optional<Sample>> latest_; ///< by channel
    std::vector<SensorLog> logs_;               ///< by channel; the laser's stays empty
    SampleRate bar_rate_;
    double scale_ = 0;
    std::optional<Error> outside_;
    MonotonicTime last_outside_{}; ///< when something last was
};

} // namespace axiscal
