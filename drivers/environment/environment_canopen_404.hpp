#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Reads `link`, `node`, `inputs`, `sample_period`, `unit` and `digits`.
std::unique_ptr<Instrument> make_canopen_404(const InstrumentConfig& config, Settings& options);

extern const Appearance canopen_404_appearance;

} // namespace axiscal
