#pragma once
// Whether two parts of the station name one wire that only one of them can have. Follows symbolic
// links of serial ports; opens nothing.

#include "config/instrument_config.hpp"
#include "config/settings.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Refuses through `options[i]` the `link` of an instrument whose wire an instrument before it, or
/// the CNC's line (`trigger_line`, empty: none), has too. Modbus sensors share a line, CANopen
/// nodes a bus, and what plays a tape opens no wire.
void refuse_shared_wires(const std::vector<InstrumentConfig>& configs,
                         std::vector<Settings>& options,
                         const std::string& trigger_line);

} // namespace axiscal
