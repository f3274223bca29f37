#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "lasertex". Keys: link, position, wavelength, fastest, baud, parity, data_bits,
/// stop_bits.
std::unique_ptr<Instrument> make_lasertex(const InstrumentConfig& config, Settings& options);

extern const Appearance lasertex_appearance;

} // namespace axiscal
