#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "temper-serial". Keys: link, poll_period.
std::unique_ptr<Instrument> make_temper_serial(const InstrumentConfig& config, Settings& options);

extern const Appearance temper_serial_appearance;

} // namespace axiscal
