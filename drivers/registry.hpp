#pragma once
// Which drivers exist. Explicit on purpose: objects that register themselves are dropped by the
// linker from a static library. Pure.

#include "config/settings.hpp"
#include "drivers/instrument.hpp"

#include <span>

namespace axiscal {

std::span<const InstrumentDriver> instrument_drivers();

/// @errors Fault::unknown_instrument with the nearest name and the list.
Result<const InstrumentDriver*> find_driver(std::string_view name);

/// One instrument for each configuration, in order; opens nothing. `options[i]` are the driver's
/// own keys of `configs[i]`. An unknown driver, a channel that the driver does not have and a
/// stated medium that the channel is not are refused through them; the entry of an unknown driver
/// is null.
std::vector<std::unique_ptr<Instrument>>
make_instruments(const std::vector<InstrumentConfig>& configs, std::vector<Settings>& options);

} // namespace axiscal
