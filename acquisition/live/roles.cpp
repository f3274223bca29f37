#include "acquisition/live/roles.hpp"

#include <algorithm>

namespace axiscal {
namespace {

struct Wanted {
    const char* role; ///< key of the station file
    ChannelKind kind;
    Medium medium;
};

std::string known_channels(const std::vector<StationChannel>& channels) {
    std::string list;
    for (const StationChannel& channel : channels)
        list += (list.empty() ? "" : ", ") + channel.instrument_name + "/" + channel.name;
    return list.empty() ? "none" : list;
}

Result<int>
find(const RoleConfig& role, const Wanted& wanted, const std::vector<StationChannel>& channels) {
    const std::string name = role.instrument + "/" + role.channel;
    for (const StationChannel& channel : channels) {
        if (channel.instrument_name != role.instrument || channel.name != role.channel) continue;
        if (channel.kind != wanted.kind)
            return fail(Fault::bad_configuration, std::string{wanted.role} + " = \"" + name +
                                                      "\" measures " +
                                                      std::string{name_of(channel.kind)} +
                                                      ", not " + std::string{name_of(wanted.kind)});
        if (wanted.medium != Medium::none && channel.medium != wanted.medium)
            return fail(Fault::wrong_medium,
                        std::string{wanted.role} + " = \"" + name + "\" has medium '" +
                            std::string{name_of(channel.medium)} + "' but must have '" +
                            std::string{name_of(wanted.medium)} + "'");
        return channel.id;
    }
    return fail(Fault::bad_configuration, std::string{wanted.role} + " = \"" + name +
                                              "\" does not exist; there are " +
                                              known_channels(channels));
}

/// All that could play the part, those apart that play another.
std::vector<RoleConfig> candidates(const Wanted& wanted,
                                   const std::vector<RoleConfig>& taken,
                                   const std::vector<StationChannel>& channels) {
    std::vector<RoleConfig> found;
    for (const StationChannel& channel : channels) {
        const bool of_kind = channel.kind == wanted.kind &&
                             (wanted.medium == Medium::none || channel.medium == wanted.medium);
        const bool free = std::ranges::none_of(taken, [&](const RoleConfig& other) {
            return other.instrument == channel.instrument_name && other.channel == channel.name;
        });
        if (of_kind && free) found.push_back({channel.instrument_name, channel.name});
    }
    return found;
}

std::string listed(const std::vector<RoleConfig>& roles) {
    std::string list;
    for (const RoleConfig& role : roles)
        list += (list.empty() ? "\"" : ", \"") + role.instrument + "/" + role.channel + '"';
    return list;
}

/// A sensor of its own goes before one that the laser brings along and that may not be connected.
std::vector<RoleConfig> without_those_of(const std::string& laser, std::vector<RoleConfig> found) {
    std::vector<RoleConfig> own;
    for (const RoleConfig& one : found)
        if (one.instrument != laser) own.push_back(one);
    return own.empty() ? std::move(found) : own;
}

Result<void> name_role(RoleConfig& role,
                       const Wanted& wanted,
                       const std::string& laser,
                       const std::vector<RoleConfig>& taken,
                       const std::vector<StationChannel>& channels) {
    if (!role.by_kind || !role.instrument.empty()) return {};
    const auto found = without_those_of(laser, candidates(wanted, taken, channels));
    if (found.size() == 1) {
        role = found.front();
        role.by_kind = true;
        return {};
    }
    const std::string what = std::string{wanted.role} + " is not named, and ";
    if (!found.empty())
        return fail(Fault::bad_configuration,
                    what + "several channels could be it: " + listed(found) + "; name one");
    return fail(Fault::bad_configuration,
                what + "no instrument has such a channel; there are " + known_channels(channels));
}

const char* reference_key(const AxisConfig& axis) {
    return axis.scale ? "axis.scale.channel" : "axis.laser";
}

/// A laser or scale counts from where it was switched on: a table by its reading would hit by
/// chance.
Result<void>
check_laser(int id, const std::string& key, const std::vector<StationChannel>& channels) {
    const auto laser = std::ranges::find(channels, id, &StationChannel::id);
    if (laser->calibration.corrections.empty() && laser->correction == 0) return {};
    return fail(Fault::bad_configuration,
                key + " = \"" + laser->instrument_name + "/" + laser->name +
                    "\" has corrections, but its length begins where it was switched on: leave "
                    "them out, and state what its certificate says as uncertainty = \"0.4 um/m\"");
}

Result<std::vector<int>> find_all(const std::vector<RoleConfig>& roles,
                                  const char* key,
                                  const std::vector<StationChannel>& channels) {
    std::vector<int> ids;
    for (const RoleConfig& role : roles) {
        AXISCAL_TRY(const int id,
                    find(role, {key, ChannelKind::temperature, Medium::material}, channels));
        ids.push_back(id);
    }
    return ids;
}

/// One sensor cannot be as warm as the scale and as the machine.
Result<void> check_apart(const StationRoles& roles, const std::vector<StationChannel>& channels) {
    for (const int id : roles.scale) {
        if (std::ranges::find(roles.material, id) == roles.material.end()) continue;
        const auto shared = std::ranges::find(channels, id, &StationChannel::id);
        return fail(Fault::bad_configuration,
                    "\"" + shared->instrument_name + "/" + shared->name +
                        "\" is named by axis.scale.temperature and by axis.material.temperature: "
                        "it touches one of them; give the other a sensor of its own");
    }
    return {};
}

} // namespace

std::vector<int> StationRoles::environment() const {
    std::vector<int> ids;
    for (const auto& id : {air_temperature, air_pressure, air_humidity})
        if (id) ids.push_back(*id);
    ids.insert(ids.end(), material.begin(), material.end());
    ids.insert(ids.end(), scale.begin(), scale.end());
    return ids;
}

std::vector<int> StationRoles::of_circles() const {
    std::vector<int> ids;
    if (air_temperature) ids.push_back(*air_temperature);
    ids.insert(ids.end(), material.begin(), material.end());
    if (bar_temperature && std::ranges::find(ids, *bar_temperature) == ids.end())
        ids.push_back(*bar_temperature);
    return ids;
}

Result<void> name_roles(AxisConfig& axis,
                        const std::vector<RoleConfig>& taken,
                        const std::vector<StationChannel>& channels) {
    const auto name = [&](RoleConfig& role, const Wanted& wanted) {
        return name_role(role, wanted, axis.laser.instrument, taken, channels);
    };
    AXISCAL_CHECK(name(axis.laser, {"axis.laser", ChannelKind::displacement, Medium::none}));
    AXISCAL_CHECK(name(axis.air_temperature,
                       {"axis.air.temperature", ChannelKind::temperature, Medium::air}));
    AXISCAL_CHECK(
        name(axis.air_pressure, {"axis.air.pressure", ChannelKind::pressure, Medium::air}));
    AXISCAL_CHECK(
        name(axis.air_humidity, {"axis.air.humidity", ChannelKind::humidity, Medium::air}));
    const bool all = axis.material_temperature.size() == 1 &&
                     axis.material_temperature[0].by_kind &&
                     axis.material_temperature[0].instrument.empty();
    const Wanted material{"axis.material.temperature", ChannelKind::temperature, Medium::material};
    if (!all) return {};
    axis.material_temperature = candidates(material, taken, channels);
    for (RoleConfig& role : axis.material_temperature)
        role.by_kind = true;
    return {};
}

Result<StationRoles> resolve_roles(const AxisConfig& axis,
                                   const std::vector<StationChannel>& channels) {
    StationRoles roles;
    const bool alone = axis.laser.instrument.empty(); // a ballbar, or an autocollimator
    const bool without_air = alone || axis.scale;
    const auto fill = [&](std::optional<int>& id, const RoleConfig& role,
                          const Wanted& wanted) -> Result<void> {
        if (without_air && role.instrument.empty()) return {};
        AXISCAL_TRY(id, find(role, wanted, channels));
        return {};
    };
    AXISCAL_CHECK(fill(roles.laser, axis.laser,
                       {reference_key(axis), ChannelKind::displacement, Medium::none}));
    if (roles.laser) {
        AXISCAL_CHECK(check_laser(*roles.laser, reference_key(axis), channels));
    }
    if (axis.angle && !axis.angle->autocollimator.instrument.empty()) {
        const Wanted face{"axis.angle.autocollimator", ChannelKind::angle, Medium::none};
        AXISCAL_TRY(roles.autocollimator, find(axis.angle->autocollimator, face, channels));
    }
    AXISCAL_CHECK(fill(roles.air_temperature, axis.air_temperature,
                       {"axis.air.temperature", ChannelKind::temperature, Medium::air}));
    AXISCAL_CHECK(fill(roles.air_pressure, axis.air_pressure,
                       {"axis.air.pressure", ChannelKind::pressure, Medium::air}));
    AXISCAL_CHECK(fill(roles.air_humidity, axis.air_humidity,
                       {"axis.air.humidity", ChannelKind::humidity, Medium::air}));
    AXISCAL_TRY(roles.material,
                find_all(axis.material_temperature, "axis.material.temperature", channels));
    if (axis.scale) {
        AXISCAL_TRY(roles.scale,
                    find_all(axis.scale->temperature, "axis.scale.temperature", channels));
    }
    AXISCAL_CHECK(check_apart(roles, channels));
    if (roles.material.empty() && !alone && !axis.angle)
        return fail(Fault::bad_configuration, "axis.material.temperature names no sensor; the axis "
                                              "cannot be brought to 20 degC without one");
    return roles;
}

Result<int> resolve_ballbar(const RoleConfig& ballbar,
                            const StationRoles& axis,
                            const std::vector<StationChannel>& channels) {
    AXISCAL_TRY(
        const int id,
        find(ballbar, {"ballbar.sensor", ChannelKind::displacement, Medium::none}, channels));
    if (id != axis.laser) return id;
    return fail(Fault::bad_configuration,
                "ballbar.sensor = \"" + ballbar.instrument + "/" + ballbar.channel +
                    "\" measures the axis, too: a reading goes one way; use a station file "
                    "without [axis] for the circles");
}

Result<int> resolve_bar_temperature(const RoleConfig& sensor,
                                    const std::vector<StationChannel>& channels) {
    return find(sensor, {"ballbar.temperature", ChannelKind::temperature, Medium::material},
                channels);
}

} // namespace axiscal
