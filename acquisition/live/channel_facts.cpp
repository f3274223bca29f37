#include "acquisition/live/channel_facts.hpp"

#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "config/station_config.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace axiscal {
namespace {

/// Beyond this age a sample of such a channel is no value.
Duration oldest_of(ChannelKind kind, const StationConfig& config) {
    if (kind == ChannelKind::displacement || kind == ChannelKind::angle) return laser_limit;
    if (kind == ChannelKind::strength) return strength_limit;
    return config.axis.air.oldest;
}

} // namespace

ChannelView ChannelFacts::view(const StationChannel& channel, MonotonicTime now) const {
    ChannelView view;
    view.instrument = channel.instrument_name;
    view.channel = channel.name;
    view.name = channel.shown;
    view.place = channel.place;
    view.unit = stored_unit_of(channel.kind);
    view.kind = channel.kind;
    view.medium = channel.medium;
    view.due_on = channel.calibration.due_on;
    const std::vector<int> environment = roles_.environment();
    if (channel.id == roles_.laser || channel.id == roles_.autocollimator)
        view.role = "axis";
    else if (channel.id == roles_.ballbar)
        view.role = "ballbar";
    else if (std::ranges::find(environment, channel.id) != environment.end())
        view.role = "environment";
    view.used = !view.role.empty();
    const Duration oldest = oldest_of(channel.kind, config_);
    view.stale_after_s = seconds_of(oldest);
    const auto& sample = readings_.latest(channel.id);
    if (!sample) return view;
    const Duration age = now - sample->at;
    const bool stale = age > oldest;
    view.age_s = seconds_of(age);
    view.quality = stale ? "stale" : std::string{name_of(sample->quality())};
    if (!stale) view.value = sample->value();
    return view;
}

SensorFacts ChannelFacts::sensor(int id, MonotonicTime now) const {
    const StationChannel& channel = instruments_.channels()[static_cast<std::size_t>(id)];
    const ChannelView seen = view(channel, now);
    SensorFacts facts;
    facts.name = channel.instrument_name + "/" + channel.name;
    facts.kind = channel.kind;
    facts.medium = channel.medium;
    facts.on_scale = std::ranges::find(roles_.scale, id) != roles_.scale.end();
    facts.as_sent = channel.correction == 0 && channel.calibration.corrections.empty();
    facts.fresh = seen.value.has_value();
    facts.quality = seen.quality;
    facts.log = &readings_.log_of(id);
    return facts;
}

std::vector<SensorFacts> ChannelFacts::environment(MonotonicTime now) const {
    std::vector<SensorFacts> facts;
    const std::vector<int> channels = roles_.environment();
    facts.reserve(channels.size());
    for (const int id : channels)
        facts.push_back(sensor(id, now));
    return facts;
}

} // namespace axiscal
