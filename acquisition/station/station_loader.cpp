#include "acquisition/station/station_loader.hpp"

#include "acquisition/measurement/measurement_kind.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/rotary_plan.hpp"
#include "analysis/positioning/chosen_standards.hpp"
#include "drivers/registry.hpp"
#include "drivers/shared_wires.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace axiscal {
namespace {

Result<std::string> text_of_tape(const std::string& path) {
    std::error_code error; // a folder, a pipe or a device would be read for ever
    const bool is_file = std::filesystem::is_regular_file(path, error);
    std::ifstream file{path, std::ios::binary};
    if (!is_file || !file)
        return fail(Fault::bad_configuration,
                    "cannot read " + path +
                        ": is the file there, and may the user of axiscald read it and enter its "
                        "folder?");
    return std::string{std::istreambuf_iterator<char>{file}, {}};
}

Result<Tape> tape_of(const InstrumentConfig& config) {
    AXISCAL_TRY(const InstrumentDriver* const driver, find_driver(config.driver));
    if (!driver->no_tape.empty())
        return fail(Fault::bad_configuration, std::string{driver->no_tape});
    AXISCAL_TRY(const std::string text, text_of_tape(config.tape));
    AXISCAL_TRY(Tape tape, parse_tape(text));
    const auto made_with = tape.header.find("driver");
    if (made_with != tape.header.end() && made_with->second != config.driver)
        return fail(Fault::bad_configuration, config.tape + " is a tape for the driver \"" +
                                                  made_with->second + "\", not for \"" +
                                                  config.driver + "\"");
    return tape;
}

/// Before anything is opened, so that `axiscal check-config` tells what is wrong with a tape.
void load_tapes(LoadedStation& station) {
    for (std::size_t i = 0; i < station.instruments.size(); ++i) {
        const InstrumentConfig& config = station.config.instruments[i];
        Settings& options = station.config.instrument_options[i];
        if (!station.instruments[i] || config.tape.empty() || options.refused("tape")) continue;
        auto tape = tape_of(config);
        if (tape)
            station.tapes.emplace(config.name, *std::move(tape));
        else
            options.refuse("tape", tape.error().detail);
    }
}

/// Of a kind that reads none finish() refuses each key.
void read_kind_sections(StationConfig& config) {
    for (KindSection& section : config.kind_sections) {
        const MeasurementKind& row = kind_row(section.kind);
        if (row.read != nullptr) section.config = row.read(section.table, config);
    }
}

/// Readings of a laser are corrected for air and must count wavelengths, those of a scale are
/// corrected for its own expansion and must be lengths.
void check_reference(const Instrument& reference, const AxisConfig& axis, Settings root) {
    const std::string name = "\"" + axis.laser.instrument + "\"";
    if (axis.scale && !reference.resolution())
        root.table("axis").table("scale").refuse(
            "channel", name + " is no linear scale, for it states no resolution: name an "
                              "instrument with `resolution`, or the laser as axis.laser");
    if (axis.scale || reference.optics()) return;
    root.table("axis").refuse("laser", name + " gives true lengths, which must not be corrected "
                                              "for air: name an interferometer, or name a linear "
                                              "scale in [axis.scale] instead");
}

void check_targets(LoadedStation& station, Settings root) {
    if (station.config.circles_alone()) return;
    if (auto passes = plan_passes(station.config.cycle, 0))
        station.passes = *std::move(passes);
    else
        root.refuse("cycle", describe(passes.error()));
    if (!station.config.axis.angle) return;
    for (const RunPlan& plan : station.passes)
        if (auto fits = check_rotary_plan(plan, station.config.axis.angle->setup); !fits)
            root.refuse("cycle", describe(fits.error()));
}

/// Nothing that the plan of the targets is made of has been refused.
bool targets_are_known(const std::vector<Refusal>& refusals) {
    constexpr std::array sources{"axis", "axis.kind", "axis.travel_low", "axis.travel_high",
                                 "axis.feedback_pitch"};
    return std::none_of(refusals.begin(), refusals.end(), [&](const Refusal& refusal) {
        return refusal.key.starts_with("cycle") || refusal.key.starts_with("axis.angle") ||
               std::find(sources.begin(), sources.end(), refusal.key) != sources.end();
    });
}

/// Channels that the station file gives another part than those of the axis.
std::vector<RoleConfig> other_parts(const StationConfig& config) {
    std::vector<RoleConfig> taken;
    if (config.ballbar) taken.push_back(*config.ballbar);
    if (config.circular && config.circular->bar_temperature)
        taken.push_back(*config.circular->bar_temperature);
    if (config.axis.scale)
        taken.insert(taken.end(), config.axis.scale->temperature.begin(),
                     config.axis.scale->temperature.end());
    return taken;
}

bool has_material_by_kind(const AxisConfig& axis) {
    return !axis.material_temperature.empty() && axis.material_temperature.front().by_kind;
}

/// What is wrong with the whole although every key is right by itself.
void check_standards(const LoadedStation& station, Settings certificate) {
    constexpr std::size_t most = 3; // side by side on one page
    const auto& names = station.config.standards;
    for (auto name = names.begin(); name != names.end(); ++name)
        if (std::find(names.begin(), name, *name) != name)
            return certificate.refuse("standards",
                                      "\"" + *name + "\" stands there twice: keep one");
    if (names.size() > most)
        return certificate.refuse("standards", "has more than three: they stand side by side");
    if (const auto chosen = chosen_standards(names); !chosen)
        certificate.refuse("standards", chosen.error().detail);
}

void check_together(LoadedStation& station, Settings root) {
    check_standards(station, root.table("certificate"));
    std::vector<StationChannel> channels;
    for (std::size_t i = 0; i < station.instruments.size(); ++i) {
        if (!station.instruments[i]) return;
        auto more = station_channels(station.config.instruments[i], *station.instruments[i],
                                     static_cast<int>(i), static_cast<int>(channels.size()));
        std::ranges::move(more, std::back_inserter(channels));
    }
    const bool all_material = has_material_by_kind(station.config.axis);
    if (auto named = name_roles(station.config.axis, other_parts(station.config), channels); !named)
        return root.refuse("axis", describe(named.error()));
    if (all_material && station.config.axis.material_temperature.size() == 1)
        station.config.warnings.push_back({station.config.file, root.table("axis").line(),
                                           "axis.material.temperature",
                                           std::string{single_material_sensor}});
    if (auto roles = resolve_roles(station.config.axis, channels)) {
        station.roles = *std::move(roles);
        if (const auto laser = station.roles.laser) {
            const int seat = channels[static_cast<std::size_t>(*laser)].instrument;
            check_reference(*station.instruments[static_cast<std::size_t>(seat)],
                            station.config.axis, root);
        }
    } else
        root.refuse("axis", describe(roles.error()));
    if (station.config.ballbar) {
        if (const auto ballbar = resolve_ballbar(*station.config.ballbar, station.roles, channels))
            station.roles.ballbar = *ballbar;
        else
            root.refuse("ballbar", describe(ballbar.error()));
    }
    if (station.config.circular && station.config.circular->bar_temperature) {
        if (const auto bar =
                resolve_bar_temperature(*station.config.circular->bar_temperature, channels))
            station.roles.bar_temperature = *bar;
        else
            root.refuse("ballbar", describe(bar.error()));
    }
    check_targets(station, root);
}

/// Judged together once every key is right by itself; the targets as soon as theirs are.
std::vector<Refusal> refusals_of(SettingsDocument& document, LoadedStation& station) {
    std::vector<Refusal> refusals = document.finish();
    if (refusals.empty()) {
        check_together(station, document.root());
        return document.finish();
    }
    if (targets_are_known(refusals)) check_targets(station, document.root());
    std::ranges::move(document.finish(), std::back_inserter(refusals));
    std::stable_sort(refusals.begin(), refusals.end(),
                     [](const Refusal& a, const Refusal& b) { return a.line < b.line; });
    return refusals;
}

} // namespace

tl::expected<LoadedStation, std::vector<Refusal>> load_station(const std::string& path) {
    auto document = SettingsDocument::load(path);
    if (!document)
        return tl::unexpected(std::vector<Refusal>{{path, 0, "", document.error().detail}});
    LoadedStation station;
    station.config = read_station(*document);
    station.instruments =
        make_instruments(station.config.instruments, station.config.instrument_options);
    refuse_shared_wires(station.config.instruments, station.config.instrument_options,
                        station.config.trigger.serial_path);
    load_tapes(station);
    read_kind_sections(station.config);
    std::vector<Refusal> refusals = refusals_of(*document, station);
    if (!refusals.empty()) return tl::unexpected(std::move(refusals));
    return station;
}

} // namespace axiscal
