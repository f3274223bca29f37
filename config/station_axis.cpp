#include "config/station_readers.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

const InstrumentConfig* find_instrument(const StationConfig& config, const std::string& name) {
    const auto found = std::find_if(config.instruments.begin(), config.instruments.end(),
                                    [&](const auto& other) { return other.name == name; });
    return found == config.instruments.end() ? nullptr : &*found;
}

std::string unknown_instrument(const StationConfig& config, const std::string& name) {
    std::vector<std::string> names;
    std::string list;
    for (const InstrumentConfig& instrument : config.instruments) {
        if (instrument.name.empty()) continue; // refused already
        names.push_back(instrument.name);
        list += (list.empty() ? "" : ", ") + instrument.name;
    }
    const std::string near = nearest_word(name, names);
    return "no [[instrument]] has the name \"" + name + "\" (there are: " + list + ")" +
           (near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

constexpr std::string_view word_of(Medium medium) {
    return medium == Medium::air ? "air" : "material";
}

/// "laser/axis 1": a part to play and the medium that the part needs.
class RoleReader {
public:
    RoleReader(Settings table, const StationConfig& config)
        : table_{std::move(table)}
        , config_{config} {}

    /// The only channel that can play the part, where none is named.
    RoleConfig one_or_the_only(std::string_view key, Medium use) {
        return table_.has(key) ? one(key, use) : RoleConfig{{}, {}, true};
    }

    RoleConfig one(std::string_view key, Medium use) {
        const std::string written = table_.text(key);
        return table_.refused(key) ? RoleConfig{} : checked(key, written, use);
    }

    std::vector<RoleConfig> several(std::string_view key, Medium use) {
        std::vector<RoleConfig> roles;
        for (const std::string& written : table_.texts(key)) {
            roles.push_back(checked(key, written, use));
            const auto same = [&](const RoleConfig& other) {
                return other.instrument == roles.back().instrument &&
                       other.channel == roles.back().channel;
            };
            if (std::count_if(roles.begin(), roles.end(), same) > 1 && !table_.refused(key))
                table_.refuse(key, "\"" + written + "\" stands there twice: keep one");
        }
        return roles;
    }

private:
    RoleConfig checked(std::string_view key, const std::string& written, Medium use) {
        const auto slash = written.find('/');
        if (slash == 0 || slash == std::string::npos || slash + 1 == written.size()) {
            table_.refuse(key, "\"" + written +
                                   "\" names no channel: write \"instrument/channel\", "
                                   "for example \"air/air temperature\"");
            return {};
        }
        RoleConfig role{written.substr(0, slash), written.substr(slash + 1)};
        const InstrumentConfig* instrument = find_instrument(config_, role.instrument);
        if (!instrument) table_.refuse(key, unknown_instrument(config_, role.instrument));
        if (instrument) check_medium(key, *instrument, role, use);
        return role;
    }

    void check_medium(std::string_view key,
                      const InstrumentConfig& instrument,
                      const RoleConfig& role,
                      Medium use) {
        for (const ChannelConfig& channel : instrument.channels) {
            if (channel.channel != role.channel || !channel.medium || use == Medium::none) continue;
            if (*channel.medium == use) continue;
            table_.refuse(key, "\"" + role.instrument + "/" + role.channel +
                                   "\" is a channel of medium " +
                                   std::string{word_of(*channel.medium)} + " (line " +
                                   std::to_string(channel.line) + ") and cannot serve as " +
                                   std::string{word_of(use)} + ": name another sensor");
        }
    }

    Settings table_;
    const StationConfig& config_;
};

void read_material(Settings material, StationConfig& config) {
    MaterialSetup& setup = config.axis.material;
    const Expansion none, steepest = um_per_m_kelvin(100);
    setup.coefficient = material.expansion("coefficient", none, steepest);
    if (material.has("standard_uncertainty"))
        setup.standard_uncertainty = material.expansion("standard_uncertainty", none, steepest);
    setup.feedback = material.text("feedback", setup.feedback);
    const std::string form = material.choice("form", {"first_order", "exact"}, "first_order");
    setup.form = form == "exact" ? ExpansionForm::exact : ExpansionForm::first_order;
    if (!material.has("temperature")) {
        config.axis.material_temperature = {RoleConfig{{}, {}, true}};
        return;
    }
    config.axis.material_temperature =
        RoleReader{material, config}.several("temperature", Medium::material);
    const std::size_t sensors = config.axis.material_temperature.size();
    if (material.refused("temperature")) return;
    if (sensors == 0)
        material.refuse("temperature",
                        "names no sensor: without a material temperature nothing can be brought to "
                        "20 degC; name at least one, better two");
    if (sensors == 1)
        config.warnings.push_back({config.file, material.line_of("temperature"),
                                   "axis.material.temperature",
                                   std::string{single_material_sensor}});
}

void read_air(Settings air, StationConfig& config) {
    using namespace std::chrono_literals;
    AirSetup& setup = config.axis.air;
    const std::string formula = air.choice("formula", {"ciddor", "edlen"}, "ciddor");
    setup.formula = formula == "edlen" ? AirFormula::edlen : AirFormula::ciddor;
    const Ratio share = air.ratio("co2", ppm(0), ppm(20000), ppm(setup.co2_ppm));
    setup.co2_ppm = std::round(share.in(ppm)*1e6) / 1e6; // 450 ppm stays 450 exactly
    setup.oldest = air.duration("oldest", 1s, 1h, setup.oldest);
    RoleReader roles{air, config};
    config.axis.air_temperature = roles.one_or_the_only("temperature", Medium::air);
    config.axis.air_pressure = roles.one_or_the_only("pressure", Medium::air);
    config.axis.air_humidity = roles.one_or_the_only("humidity", Medium::air);
}

/// A scale counts true lengths: what a beam needs would be misread beside it, so each is named.
void refuse_beam_beside_scale(Settings axis) {
    for (const char* key : {"laser", "dead_path", "beam_walk", "beam_walk_travel", "air"})
        if (axis.has(key))
            axis.refuse(key, "belongs to a laser, and [axis.scale] says that a linear scale "
                             "measures this axis: leave one of them out");
}

void read_scale(Settings axis, StationConfig& config) {
    using namespace std::chrono_literals;
    refuse_beam_beside_scale(axis);
    Settings table = axis.table("scale");
    ScaleConfig scale;
    const Expansion none, steepest = um_per_m_kelvin(100);
    scale.setup.coefficient = table.expansion("coefficient", none, steepest);
    if (table.has("standard_uncertainty"))
        scale.setup.standard_uncertainty = table.expansion("standard_uncertainty", none, steepest);
    if (table.has("temperature_width"))
        scale.setup.temperature_width =
            table.temperature_difference("temperature_width", kelvin(0), kelvin(50));
    config.axis.air.oldest = table.duration("oldest", 1s, 1h, config.axis.air.oldest);
    RoleReader roles{table, config};
    config.axis.laser = roles.one("channel", Medium::none);
    scale.temperature = roles.several("temperature", Medium::material);
    if (scale.temperature.empty() && !table.refused("temperature"))
        table.refuse("temperature", "names no sensor: without its temperature a scale's lengths "
                                    "cannot be brought to 20 degC; name one that touches it");
    config.axis.scale = std::move(scale);
}

void read_beam(Settings axis, AxisConfig& config) {
    config.dead_path = axis.length("dead_path", mm(0), farthest);
    config.beam_walk = axis.length("beam_walk", mm(0), mm(100), mm(0));
    config.beam_walk_travel = axis.length("beam_walk_travel", mm(0), farthest, mm(0));
    const bool walks = config.beam_walk > mm(0), travels = config.beam_walk_travel > mm(0);
    if (walks && !travels && !axis.refused("beam_walk_travel"))
        axis.refuse("beam_walk", "needs beam_walk_travel: over which travel was the walk seen?");
    if (travels && config.beam_walk * 10 > config.beam_walk_travel)
        axis.refuse("beam_walk", "is more than a tenth of beam_walk_travel: align the beam first");
}

void read_sign(Settings axis, AxisConfig& config) {
    config.sign = static_cast<int>(axis.integer("sign", -1, 1));
    if (config.sign == 0 && !axis.refused("sign"))
        axis.refuse("sign", "is 1 when the laser's reading rises as the axis moves in its positive "
                            "direction, and -1 when it falls");
}

/// An angle does not expand, and both beams of its interferometer go the same dead path: material
/// sensors may be named to be recorded, air is asked for where wavelengths are counted.
void read_rotary(Settings axis, StationConfig& config) {
    const bool has_laser = axis.has("laser");
    if (has_laser) config.axis.laser = RoleReader{axis, config}.one("laser", Medium::none);
    Settings material = axis.table("material");
    if (material.has("temperature"))
        config.axis.material_temperature =
            RoleReader{material, config}.several("temperature", Medium::material);
    if (has_laser) read_air(axis.table("air"), config);
    config.axis.angle = read_angle(axis.table("angle"), has_laser, config);
}

} // namespace

void read_axis(Settings axis, AxisUnits units, StationConfig& config) {
    static const std::vector<std::string> letters{"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
    config.axis.name = axis.text("name");
    const bool letter =
        std::find(letters.begin(), letters.end(), config.axis.name) != letters.end();
    config.axis.program_axis = axis.choice("program_axis", letters,
                                           letter ? std::optional{config.axis.name} : std::nullopt);
    CycleConfig& cycle = config.cycle;
    cycle.travel_low = units.coordinate(axis, "travel_low", -farthest, farthest);
    cycle.travel_high = units.coordinate(axis, "travel_high", -farthest, farthest);
    cycle.feedback_pitch = units.optional_coordinate(axis, "feedback_pitch", um(0.1), metre(1));
    const bool read = !axis.refused("travel_low") && !axis.refused("travel_high");
    if (read && cycle.travel_low >= cycle.travel_high)
        axis.refuse("travel_high", "must lie above travel_low: exchange or correct the limits");
    read_sign(axis, config.axis);
    if (cycle.axis_kind == AxisKind::rotary) return read_rotary(axis, config);
    if (axis.has("scale")) {
        read_scale(axis, config);
        read_material(axis.table("material"), config);
        return;
    }
    read_beam(axis, config.axis);
    config.axis.laser = RoleReader{axis, config}.one_or_the_only("laser", Medium::none);
    read_material(axis.table("material"), config);
    read_air(axis.table("air"), config);
}

void read_machine_of_circles(Settings circular, StationConfig& config) {
    config.axis.name = circular.text("plane", "XY"); // read_circular() checks it
    if (circular.has("machine_expansion"))
        config.axis.material.coefficient =
            circular.expansion("machine_expansion", Expansion{}, um_per_m_kelvin(100));
    RoleReader roles{circular, config};
    if (circular.has("machine_temperature"))
        config.axis.material_temperature = roles.several("machine_temperature", Medium::material);
    if (circular.has("air_temperature"))
        config.axis.air_temperature = roles.one("air_temperature", Medium::air);
}

RoleConfig read_role(Settings& table, std::string_view key, const StationConfig& config) {
    return RoleReader{table, config}.one(key, Medium::none);
}

void read_ballbar(Settings root, StationConfig& config) {
    Settings ballbar = root.table("ballbar");
    const std::string sensor = ballbar.text("sensor", "");
    if (!sensor.empty()) config.ballbar = RoleReader{ballbar, config}.one("sensor", Medium::none);
}

} // namespace axiscal
