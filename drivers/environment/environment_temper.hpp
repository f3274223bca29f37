#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "temper". Keys: link, poll_period.
std::unique_ptr<Instrument> make_temper(const InstrumentConfig& config, Settings& options);

extern const Appearance temper_appearance;

} // namespace axiscal
