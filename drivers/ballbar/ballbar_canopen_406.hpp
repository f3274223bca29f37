#pragma once
#include "drivers/instrument.hpp"

namespace axiscal {

/// Reads `link`, `node`, `sample_period`, `position_step`, `reversed` and `work_area`.
std::unique_ptr<Instrument> make_canopen_406(const InstrumentConfig& config, Settings& options);

extern const Appearance canopen_406_appearance;

} // namespace axiscal
