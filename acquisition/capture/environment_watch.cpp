#include "acquisition/capture/environment_watch.hpp"

#include "acquisition/capture/wording.hpp"

#include <utility>

namespace axiscal {
namespace {

// Stamps are fitted device clocks: they may lead the loop's clock by a little, never by a second.
constexpr Duration clock_lead = std::chrono::seconds{1};

Error stale_error(const WatchedChannel& channel,
                  const std::optional<Sample>& sample,
                  MonotonicTime now,
                  Duration limit) {
    std::string what = std::string{name_of(channel.role)} + " '" + channel.name + "'";
    if (!channel.place.empty()) what += " (" + channel.place + ")";
    if (!sample)
        what += " has not been read yet";
    else if (!sample->value())
        what += " says '" + std::string{name_of(sample->quality())} + "'";
    else
        what += " is " + in_seconds(now - sample->at) + " old, the limit is " + in_seconds(limit);
    return Error{Fault::environment_stale, "The " + what + ".", {}, channel.name};
}

} // namespace

std::string_view name_of(EnvironmentRole role) {
    switch (role) {
    case EnvironmentRole::air_temperature: return "air temperature";
    case EnvironmentRole::air_pressure: return "air pressure";
    case EnvironmentRole::air_humidity: return "air humidity";
    case EnvironmentRole::material_temperature: return "material temperature";
    case EnvironmentRole::scale_temperature: return "scale temperature";
    }
    return "?";
}

EnvironmentWatch::EnvironmentWatch(std::vector<WatchedChannel> channels)
    : channels_{std::move(channels)}
    , latest_(channels_.size()) {}

void EnvironmentWatch::take(std::size_t channel, const Sample& sample) {
    if (channel >= latest_.size()) return;
    auto& latest = latest_[channel];
    if (!latest || sample.at >= latest->at) latest = sample;
}

std::optional<FreshReading>
EnvironmentWatch::fresh(std::size_t channel, MonotonicTime now, Duration limit) const {
    if (channel >= latest_.size() || !latest_[channel]) return std::nullopt;
    const auto& sample = *latest_[channel];
    const Duration age = now - sample.at;
    const auto value = sample.value();
    if (!value || age > limit || age < -clock_lead) return std::nullopt;
    return FreshReading{*value, sample.at, std::max(age, Duration{})};
}

std::optional<double>
EnvironmentWatch::fresh_mean(EnvironmentRole role, MonotonicTime now, Duration limit) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        if (channels_[i].role != role) continue;
        const auto reading = fresh(i, now, limit);
        if (!reading) return std::nullopt;
        sum += reading->value;
        ++count;
    }
    return count > 0 ? std::optional{sum / count} : std::nullopt;
}

Result<void> EnvironmentWatch::check(MonotonicTime now, Duration limit) const {
    for (std::size_t i = 0; i < channels_.size(); ++i)
        if (!fresh(i, now, limit))
            return tl::unexpected<Error>(stale_error(channels_[i], latest_[i], now, limit));
    return {};
}

} // namespace axiscal
