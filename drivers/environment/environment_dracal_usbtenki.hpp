#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Registry row "dracal-usbtenki". Keys: link, poll_period.
std::unique_ptr<Instrument> make_dracal_usbtenki(const InstrumentConfig& config, Settings& options);

extern const Appearance dracal_usbtenki_appearance;

} // namespace axiscal
