#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "labjack-u6". Keys: link, input, differential, range, resolution_index,
/// settling_factor, sample_period, scale_length, scale_voltage, usable_voltage.
std::unique_ptr<Instrument> make_labjack_u6(const InstrumentConfig& config, Settings& options);

extern const Appearance labjack_u6_appearance;

} // namespace axiscal
