#include "config/station_readers.hpp"

namespace axiscal {

PreflightConfig read_preflight(Settings preflight) {
    using namespace std::chrono_literals;
    PreflightConfig config;
    config.soak_window = preflight.duration("soak_window", 0s, 2h, config.soak_window);
    config.soak_change = preflight.temperature_difference("soak_change", kelvin(0.001), kelvin(10),
                                                          config.soak_change);
    config.sensor_difference = preflight.temperature_difference(
        "sensor_difference", kelvin(0.01), kelvin(50), config.sensor_difference);
    config.air_share =
        preflight.ratio("air_share", percent(10), percent(100), percent(config.air_share * 100))
            .in(percent) /
        100;
    config.drift_window = preflight.duration("drift_window", 0s, 5min, config.drift_window);
    config.drift_limit = preflight.length("drift_limit", nm(1), mm(1), config.drift_limit);
    config.least_strength_percent =
        preflight
            .ratio("strength", percent(0), percent(100), percent(config.least_strength_percent))
            .in(percent);
    return config;
}

} // namespace axiscal
