#include "acquisition/station/station_loader.hpp"

#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/rotary_plan.hpp"
#include "drivers/registry.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// Readings are corrected for air and must count wavelengths.
void check_laser(const Instrument& laser, const AxisConfig& axis, Settings root) {
    if (laser.optics()) return;
    root.table("axis").refuse("laser", "\"" + axis.laser.instrument +
                                           "\" gives true lengths, which must not be corrected for "
                                           "air: name an interferometer");
}

/// What is wrong with the whole although every key is right by itself.
void check_together(LoadedStation& station, Settings root) {
    std::vector<StationChannel> channels;
    for (std::size_t i = 0; i < station.instruments.size(); ++i) {
        if (!station.instruments[i]) return;
        auto more = station_channels(station.config.instruments[i], *station.instruments[i],
                                     static_cast<int>(i), static_cast<int>(channels.size()));
        std::ranges::move(more, std::back_inserter(channels));
    }
    if (auto roles = resolve_roles(station.config.axis, channels)) {
        station.roles = *std::move(roles);
        if (const auto laser = station.roles.laser) {
            const int seat = channels[static_cast<std::size_t>(*laser)].instrument;
            check_laser(*station.instruments[static_cast<std::size_t>(seat)], station.config.axis,
                        root);
        }
    } else
        root.refuse("axis", describe(roles.error()));
    if (station.config.ballbar) {
        if (const auto ballbar = resolve_ballbar(*station.config.ballbar, channels))
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

} // namespace

tl::expected<LoadedStation, std::vector<Refusal>> load_station(const std::string& path) {
    auto document = SettingsDocument::load(path);
    if (!document)
        return tl::unexpected(std::vector<Refusal>{{path, 0, "", document.error().detail}});
    LoadedStation station;
    station.config = read_station(*document);
    station.instruments =
        make_instruments(station.config.instruments, station.config.instrument_options);
    std::vector<Refusal> refusals = document->finish();
    if (refusals.empty()) {
        check_together(station, document->root());
        refusals = document->finish();
    }
    if (!refusals.empty()) return tl::unexpected(std::move(refusals));
    return station;
}

} // namespace axiscal
