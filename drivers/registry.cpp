#include "drivers/registry.hpp"

#include "config/measure.hpp"
#include "drivers/ballbar/ballbar_canopen_406.hpp"
#include "drivers/ballbar/ballbar_labjack_u6.hpp"
#include "drivers/environment/environment_canopen_404.hpp"
#include "drivers/environment/environment_dracal_usbtenki.hpp"
#include "drivers/environment/environment_dracal_vcp.hpp"
#include "drivers/environment/environment_ds18b20.hpp"
#include "drivers/environment/environment_temper.hpp"
#include "drivers/environment/environment_temper_serial.hpp"
#include "drivers/environment/environment_vaisala.hpp"
#include "drivers/environment/modbus_instrument.hpp"
#include "drivers/gauge/ascii_gauge.hpp"
#include "drivers/laser/laser_counter.hpp"
#include "drivers/laser/laser_ids.hpp"
#include "drivers/laser/laser_lasertex.hpp"
#include "drivers/laser/laser_umd.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace axiscal {
namespace {

constexpr std::string_view speaks_itself =
    "a Modbus line is shared by its instruments: play the tape on a wire, with axiscal replay "
    "--link "
    "PATH (RTU) or --port N (TCP), and name that wire in `link`";

constexpr std::array drivers{
    InstrumentDriver{"umd", "uMD0/uMD1/uMD2 laser or scale counter, serial ASCII", make_umd,
                     &umd_appearance},
    InstrumentDriver{"dracal-vcp", "Dracal VCP air sensor (P, T, RH), serial ASCII",
                     make_dracal_vcp, &dracal_vcp_appearance},
    InstrumentDriver{"ids3010", "attocube IDS3010 interferometer, JSON-RPC over TCP", make_ids,
                     &ids_appearance},
    InstrumentDriver{"lasertex", "Lasertex HPI-3D / Status Pro uLine-f1 laser, serial frames",
                     make_lasertex, &lasertex_appearance},
    InstrumentDriver{"counter", "laser or scale with A-quad-B on a counter of the Linux kernel",
                     make_counter, &counter_appearance},
    InstrumentDriver{"ds18b20", "DS18B20 contact thermometers, 1-Wire by the Linux kernel",
                     make_ds18b20, &ds18b20_appearance},
    InstrumentDriver{"vaisala", "Vaisala PTU300 or PTB330 air sensor, serial ASCII", make_vaisala,
                     &vaisala_appearance},
    InstrumentDriver{"ascii-gauge",
                     "HEIDENHAIN ND 28x, Mitutoyo, Sylvac gauges, ELCOMAT 3000, serial ASCII",
                     make_ascii_gauge, &ascii_gauge_appearance},
    InstrumentDriver{"dracal-usbtenki", "Dracal USBTenki air sensor (P, T, RH, probe), USB",
                     make_dracal_usbtenki, &dracal_usbtenki_appearance},
    InstrumentDriver{"temper", "PCsensor TEMPer temperature stick, USB HID", make_temper,
                     &temper_appearance},
    InstrumentDriver{"temper-serial", "PCsensor TEMPerX232 temperature stick, serial ASCII",
                     make_temper_serial, &temper_serial_appearance},
    InstrumentDriver{"labjack-u6", "ballbar: LVDT on a LabJack U6, streamed over USB",
                     make_labjack_u6, &labjack_u6_appearance},
    InstrumentDriver{"canopen-404", "JUMO CANtrans T and other CiA 404 thermometers on a CAN bus",
                     make_canopen_404, &canopen_404_appearance},
    InstrumentDriver{"canopen-406",
                     "ballbar or gauge: CiA 406 linear transducer (Temposonics) on a CAN bus",
                     make_canopen_406, &canopen_406_appearance},
    InstrumentDriver{"modbus", "any Modbus sensor with a profile, RTU or TCP", make_modbus,
                     &modbus_appearance, speaks_itself},
};

template <class Names> std::string list_of(const Names& names) {
    std::string text;
    for (const auto& entry : names)
        text += (text.empty() ? "" : ", ") + std::string{entry.name};
    return text;
}

/// Where one of these is refused the channels are not those that are meant.
bool channels_are_known(const Settings& options) {
    constexpr std::array decisive{"profile", "model", "axis", "sensors", "inputs"};
    return std::ranges::none_of(decisive, [&](const char* key) { return options.refused(key); });
}

std::string no_such_channel(const std::string& name, const std::vector<Channel>& channels) {
    std::vector<std::string> names(channels.size());
    std::ranges::transform(channels, names.begin(), &Channel::name);
    const std::string near = nearest_word(name, names);
    return "\"" + name + "\" is no channel of this instrument; it has " + list_of(channels) +
           (near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

void check_channel(const Instrument& instrument, const ChannelConfig& wanted, Settings& options) {
    const auto& channels = instrument.channels();
    const auto found = std::ranges::find(channels, wanted.channel, &Channel::name);
    if (found == channels.end()) {
        options.refuse("channel", no_such_channel(wanted.channel, channels));
        return;
    }
    const std::string stored{stored_unit_of(found->kind)};
    for (const std::string& unit :
         {wanted.correction_unit, wanted.table_unit, wanted.uncertainty_unit})
        if (!unit.empty() && unit != stored) {
            std::string reason = "\"" + wanted.channel + "\" counts in ";
            reason += stored;
            reason += ", and its correction or uncertainty is stated in ";
            reason += unit;
            options.refuse("channel", reason + ": write its unit");
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
    std::vector<std::string> names;
    names.reserve(std::size(drivers));
    for (const InstrumentDriver& row : drivers)
        names.emplace_back(row.name);
    std::string reason = "there is no driver \"" + std::string{name} + "\"";
    if (const std::string near = nearest_word(name, names); !near.empty())
        reason += "; did you mean \"" + near + "\"?";
    return fail(Fault::unknown_instrument, reason + " Drivers: " + list_of(drivers));
}

std::vector<std::unique_ptr<Instrument>>
make_instruments(const std::vector<InstrumentConfig>& configs, std::vector<Settings>& options) {
    std::vector<std::unique_ptr<Instrument>> instruments;
    for (std::size_t i = 0; i < configs.size(); ++i) {
        const auto driver = find_driver(configs[i].driver);
        if (!driver) {
            if (!options[i].refused("driver")) // missing
                options[i].refuse("driver", driver.error().detail);
            options[i].accept_rest(); // its own keys are told when the driver is right
            instruments.push_back(nullptr);
            continue;
        }
        auto instrument = (*driver)->make(configs[i], options[i]);
        const bool known = channels_are_known(options[i]);
        for (const ChannelConfig& channel : configs[i].channels)
            if (known) check_channel(*instrument, channel, options[i]);
        instruments.push_back(std::move(instrument));
    }
    return instruments;
}

} // namespace axiscal
