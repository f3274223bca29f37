#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "dracal-vcp". Keys: link, baud, parity, data_bits, stop_bits, poll_period.
std::unique_ptr<Instrument> make_dracal_vcp(const InstrumentConfig& config, Settings& options);

extern const Appearance dracal_vcp_appearance;

} // namespace axiscal
