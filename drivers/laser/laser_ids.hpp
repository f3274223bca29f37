#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "ids3010". Keys: link, axis, air, wavelength, fastest, start, poll_period.
std::unique_ptr<Instrument> make_ids(const InstrumentConfig& config, Settings& options);

extern const Appearance ids_appearance;

} // namespace axiscal
