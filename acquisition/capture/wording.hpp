#pragma once
// Numbers inside sentences, with their unit and no more digits than a person needs. Pure.

#include "analysis/quantity/counted.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"

#include <string>

namespace axiscal {

/// "12.5": fixed digits, trailing zeros removed, never "-0". No locale.
std::string plain_number(double value, int digits);
std::string in_mm(Length length); ///< "12.345 mm", resolved to 0.1 um
/// "12.345 mm", or "12.345 deg" of a rotary axis, where one millimetre stands for one degree.
std::string in_axis_unit(AxisKind kind, Length coordinate);
std::string in_um(Length length);      ///< "3.2 um"
std::string in_seconds(Duration span); ///< "0.5 s"

} // namespace axiscal
