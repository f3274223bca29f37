#pragma once
// Length gauges, read-outs and autocollimators that answer in ASCII, see ascii_gauge.cpp.

#include "drivers/instrument.hpp"

namespace axiscal {

std::unique_ptr<Instrument> make_ascii_gauge(const InstrumentConfig& config, Settings& options);

extern const Appearance ascii_gauge_appearance;

} // namespace axiscal
