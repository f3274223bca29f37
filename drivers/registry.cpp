#include "drivers/registry.hpp"

#include "drivers/environment/environment_dracal_vcp.hpp"
#include "drivers/environment/modbus_instrument.hpp"
#include "drivers/laser/laser_umd.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace axiscal {
namespace {

constexpr std::array drivers{
    InstrumentDriver{"umd", "uMD0/uMD1/uMD2 laser or scale counter, serial ASCII", make_umd},
    InstrumentDriver{"dracal-vcp", "Dracal VCP air sensor (P, T, RH), serial ASCII",
                     make_dracal_vcp},
    InstrumentDriver{"modbus", "any Modbus sensor with a profile, RTU or TCP", make_modbus},
};

/// Levenshtein distance: how many letters to change, add or drop.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

template <class Names> std::string list_of(const Names& names) {
    std::string text;
    for (const auto& entry : names)
        text += (text.empty() ? "" : ", ") + std::string{entry.name};
    return text;
}

void check_channel(const Instrument& instrument, const ChannelConfig& wanted, Settings& options) {
    const auto& channels = instrument.channels();
    const auto found = std::ranges::find(channels, wanted.channel, &Channel::name);
    if (found == channels.end()) {
        options.refuse("channel", "\"" + wanted.channel +
                                      "\" is no channel of this instrument; it has " +
                                      list_of(channels));
        return;
    }
    const bool settled = found->medium != Medium::none && wanted.medium;
    if (settled && *wanted.medium != found->medium)
        options.refuse("channel", "\"" + wanted.channel + "\" measures " +
                                      (found->medium == Medium::air ? "air, not material"
                                                                    : "material, not air"));
}

} // namespace

std::span<const InstrumentDriver> instrument_drivers() {
    return drivers;
}

Result<const InstrumentDriver*> find_driver(std::string_view name) {
    const auto found = std::ranges::find(drivers, name, &InstrumentDriver::name);
    if (found != drivers.end()) return &*found;
    const auto nearest = std::ranges::min_element(
        drivers, {}, [name](const InstrumentDriver& row) { return distance(name, row.name); });
    std::string reason = "there is no driver \"" + std::string{name} + "\"";
    if (distance(name, nearest->name) <= nearest->name.size() / 2)
        reason += "; did you mean \"" + std::string{nearest->name} + "\"?";
    return fail(Fault::unknown_instrument, reason + " Drivers: " + list_of(drivers));
}

std::vector<std::unique_ptr<Instrument>>
make_instruments(const std::vector<InstrumentConfig>& configs, std::vector<Settings>& options) {
    std::vector<std::unique_ptr<Instrument>> instruments;
    for (std::size_t i = 0; i < configs.size(); ++i) {
        const auto driver = find_driver(configs[i].driver);
        if (!driver) {
            options[i].refuse("driver", driver.error().detail);
            instruments.push_back(nullptr);
            continue;
        }
        auto instrument = (*driver)->make(configs[i], options[i]);
        for (const ChannelConfig& channel : configs[i].channels)
            check_channel(*instrument, channel, options[i]);
        instruments.push_back(std::move(instrument));
    }
    return instruments;
}

} // namespace axiscal
