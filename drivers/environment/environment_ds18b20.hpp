#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "ds18b20". Keys: sensors, file, sysfs, poll_period.
std::unique_ptr<Instrument> make_ds18b20(const InstrumentConfig& config, Settings& options);

extern const Appearance ds18b20_appearance;

} // namespace axiscal
