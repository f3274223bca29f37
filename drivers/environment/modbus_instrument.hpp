#pragma once
#include "drivers/environment/modbus_profile.hpp"
#include "drivers/instrument.hpp"

namespace axiscal {

/// What one station states about one Modbus instrument besides the profile.
struct ModbusStation {
    LinkSettings link;
    int unit_id = 1;
    int address_offset = 0; ///< added to every address: manuals that count from 1
    Duration poll_period{};
    std::string stated_serial; ///< compared with the instrument's own, where it tells one
};

std::unique_ptr<Instrument> make_modbus_instrument(ModbusProfile profile, ModbusStation station);

/// Registry row "modbus". Keys: profile, link, baud, parity, data_bits, stop_bits, unit_id,
/// address_offset, poll_period.
std::unique_ptr<Instrument> make_modbus(const InstrumentConfig& config, Settings& options);

extern const Appearance modbus_appearance;

} // namespace axiscal
