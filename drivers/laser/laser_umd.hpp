#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "umd". Keys: link, baud, parity, data_bits, stop_bits, wavelength, fold,
/// counts_per_cycle, head, phase, axis, fastest.
std::unique_ptr<Instrument> make_umd(const InstrumentConfig& config, Settings& options);

extern const Appearance umd_appearance;

} // namespace axiscal
