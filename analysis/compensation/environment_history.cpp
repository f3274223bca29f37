#include "analysis/compensation/environment_history.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace axiscal {
namespace {

std::string in_seconds(Duration duration) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f s", seconds_of(duration));
    return text;
}

double
interpolate(const EnvironmentReading& left, const EnvironmentReading& right, MonotonicTime at) {
    if (right.at == left.at) return right.value;
    const double share = static_cast<double>((at - left.at).count()) /
                         static_cast<double>((right.at - left.at).count());
    return left.value + (right.value - left.value) * share;
}

} // namespace

EnvironmentHistory::EnvironmentHistory(const RunRecord& run)
    : vacuum_wavelength_{run.laser.vacuum_wavelength}
    , stated_co2_ppm_{run.air.co2_ppm}
    , oldest_{run.air.oldest} {
    const auto shelf_of = [&](const ChannelRecord& record) -> std::vector<Channel>* {
        if (sits_on_scale(run, record.id)) return &scale_;
        const bool in_air = record.medium == Medium::air;
        switch (record.kind) {
        case ChannelKind::temperature:
            if (record.medium == Medium::material) return &material_;
            return in_air ? &air_temperature_ : nullptr;
        case ChannelKind::pressure: return in_air ? &pressure_ : nullptr;
        case ChannelKind::humidity: return in_air ? &humidity_ : nullptr;
        case ChannelKind::carbon_dioxide: return in_air ? &carbon_dioxide_ : nullptr;
        case ChannelKind::displacement:
        case ChannelKind::strength:
        case ChannelKind::angle: return nullptr;
        }
        return nullptr;
    };
    for (const ChannelRecord& record : run.channels) {
        auto* shelf = shelf_of(record);
        if (!shelf) continue;
        Channel channel{record, {}};
        std::ranges::copy_if(run.environment, std::back_inserter(channel.readings),
                             [&](const auto& reading) { return reading.channel == record.id; });
        std::ranges::stable_sort(channel.readings, {}, &EnvironmentReading::at);
        shelf->push_back(std::move(channel));
    }
}

Result<double> EnvironmentHistory::value_of(const Channel& channel,
                                            MonotonicTime at,
                                            const std::string& what) const {
    const std::string name = what + ": channel '" + channel.record.name + "'";
    const auto& readings = channel.readings;
    if (readings.empty())
        return fail(Fault::environment_stale, name + " has no reading in this run");
    auto right = std::ranges::lower_bound(readings, at, {}, &EnvironmentReading::at);
    if (right == readings.end()) --right;
    auto left = right == readings.begin() || right->at < at ? right : std::prev(right);
    const auto distance = [at](const EnvironmentReading& reading) {
        return reading.at < at ? at - reading.at : reading.at - at;
    };
    const Duration nearer = std::min(distance(*left), distance(*right));
    if (nearer > oldest_)
        return fail(Fault::environment_stale, name + " has its nearest reading " +
                                                  in_seconds(nearer) + " away; the limit is " +
                                                  in_seconds(oldest_));
    const double value = left == right ? left->value : interpolate(*left, *right, at);
    if (!std::isfinite(value))
        return fail(Fault::bad_run_file, name + " holds a reading that is not a number");
    return value;
}

Result<double> EnvironmentHistory::mean_of(const std::vector<Channel>& channels,
                                           const char* name,
                                           MonotonicTime at,
                                           const std::string& what) const {
    if (channels.empty())
        return fail(Fault::environment_stale, what + ": the run has no channel of " + name +
                                                  "; name one in the station file");
    double sum = 0;
    for (const Channel& channel : channels) {
        AXISCAL_TRY(const double value, value_of(channel, at, what));
        sum += value;
    }
    return sum / static_cast<double>(channels.size());
}

Result<AirState> EnvironmentHistory::air_at(MonotonicTime at, const std::string& what) const {
    AXISCAL_TRY(const double celsius, mean_of(air_temperature_, "air temperature", at, what));
    AXISCAL_TRY(const double pressure_Pa, mean_of(pressure_, "air pressure", at, what));
    AXISCAL_TRY(const double humidity_percent, mean_of(humidity_, "air humidity", at, what));
    AirState air{Temperature::celsius(celsius), pascal(pressure_Pa), percent(humidity_percent),
                 vacuum_wavelength_, stated_co2_ppm_};
    if (!carbon_dioxide_.empty()) {
        AXISCAL_TRY(air.co2_ppm, mean_of(carbon_dioxide_, "CO2", at, what));
    }
    return air;
}

Result<Temperature> EnvironmentHistory::material_at(MonotonicTime at,
                                                    const std::string& what) const {
    AXISCAL_TRY(const double celsius, mean_of(material_, "material temperature", at, what));
    return Temperature::celsius(celsius);
}

Result<Temperature> EnvironmentHistory::scale_at(MonotonicTime at, const std::string& what) const {
    AXISCAL_TRY(const double celsius, mean_of(scale_, "scale temperature", at, what));
    return Temperature::celsius(celsius);
}

} // namespace axiscal
