#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "counter". Keys: device, count, event, event_channel, bits, resolution, or
/// wavelength with fold and counts_per_cycle; counting, fastest, silence.
std::unique_ptr<Instrument> make_counter(const InstrumentConfig& config, Settings& options);

extern const Appearance counter_appearance;

} // namespace axiscal
