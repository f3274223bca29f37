#pragma once
// What a plugged-in device could be, whether the station file knows it, what is missing, and the
// lines that would add it. Pure but for the rights of device nodes.

#include "config/settings.hpp"
#include "drivers/instrument.hpp"
#include "drivers/plugged/account.hpp"
#include "drivers/plugged/plugged.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// What the station file says about wires; keys of drivers that are not wires are not looked at.
struct StationWires {
    struct Entry {
        std::string name, driver, link;   ///< link: "serial:...", "usb:...", or a device
        std::vector<std::string> sensors; ///< 1-Wire
    };
    std::vector<Entry> instruments;
    std::string trigger_line; ///< serial port of the CNC's triggers; empty: none
};
StationWires read_station_wires(SettingsDocument& document);

/// The drivers that could mean this device: those that know its number alone, else, behind an
/// adapter, on a built-in port or with a number that nobody knows, every serial one.
std::vector<const InstrumentDriver*> could_be(const PluggedDevice& device);

/// Name of the instrument that already uses it ("trigger" for the CNC's line); empty: none.
std::string known_as(const PluggedDevice& device, const StationWires& station);

/// Names of the instruments that it may be although nobody can tell before it is opened: they state
/// a serial number, and this kind tells its own only then. Empty for a device that is known.
std::vector<std::string> may_be(const PluggedDevice& device, const StationWires& station);

/// An [[instrument]] of the station file, ready to be appended. Its name is none of `station`'s.
/// Values that stand on a certificate or a label are examples, and say so beside them.
std::string toml_block(const PluggedDevice& device,
                       const InstrumentDriver& driver,
                       const StationWires& station);

/// What keeps axiscald from using a device, and the one line that mends it.
struct Obstacle {
    std::string what, mend;
    bool stops = true; ///< false: it works, but worse than it could
};
std::vector<Obstacle> obstacles(const PluggedDevice& device, const Account& service);

} // namespace axiscal
