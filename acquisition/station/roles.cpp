#include "acquisition/station/roles.hpp"

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
