#include "config/station_readers.hpp"

#include <string>

namespace axiscal {
namespace {

/// The quantity's three keys: <name>_low, <name>_high, <name>_change_per_hour.
class BandReader {
public:
    BandReader(Settings table, const std::string& name)
        : table_{std::move(table)}
        , low_{name + "_low"}
        , high_{name + "_high"}
        , change_{name + "_change_per_hour"} {}

    EnvironmentBand temperature() {
        constexpr Temperature coldest = Temperature::celsius(-20),
                              hottest = Temperature::celsius(60);
        const auto limit = [&](const std::string& key) {
            return table_.temperature(key, coldest, hottest).in_celsius();
        };
        return band(limit, [&] {
            return table_.temperature_difference(change_, kelvin(0.01), kelvin(60)).in(kelvin);
        });
    }
    EnvironmentBand pressure() {
        const auto limit = [&](const std::string& key) {
            return table_.pressure(key, pascal(50'000), pascal(120'000)).in(pascal);
        };
        return band(limit,
                    [&] { return table_.pressure(change_, pascal(1), pascal(50'000)).in(pascal); });
    }
    EnvironmentBand humidity() {
        const auto limit = [&](const std::string& key) {
            return table_.ratio(key, percent(0), percent(100)).in(percent);
        };
        return band(limit,
                    [&] { return table_.ratio(change_, percent(0.1), percent(100)).in(percent); });
    }

private:
    template <class Limit, class Change>
    EnvironmentBand band(const Limit& limit, const Change& change) {
        EnvironmentBand band;
        if (table_.has(low_)) band.low = limit(low_);
        if (table_.has(high_)) band.high = limit(high_);
        if (table_.has(change_)) band.change_per_hour = change();
        const bool read = !table_.refused(low_) && !table_.refused(high_);
        if (read && band.low && band.high && *band.low >= *band.high)
            table_.refuse(high_, "does not lie above " + low_ + ": nothing could be measured");
        return band;
    }

    Settings table_;
    std::string low_, high_, change_;
};

} // namespace

EnvironmentLimits read_environment(Settings environment) {
    using namespace std::chrono_literals;
    EnvironmentLimits limits;
    limits.air_temperature = BandReader{environment, "air"}.temperature();
    limits.material_temperature = BandReader{environment, "material"}.temperature();
    limits.air_pressure = BandReader{environment, "pressure"}.pressure();
    limits.air_humidity = BandReader{environment, "humidity"}.humidity();
    limits.change_window = environment.duration("change_window", 1min, 2h, limits.change_window);
    return limits;
}

} // namespace axiscal
