#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "vaisala". Keys: model, link, baud, parity, data_bits, stop_bits, checksum,
/// address, poll_period.
std::unique_ptr<Instrument> make_vaisala(const InstrumentConfig& config, Settings& options);

extern const Appearance vaisala_appearance;

} // namespace axiscal
