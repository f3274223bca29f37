#pragma once
// The readings of a run for other programs. Pure.

#include "analysis/positioning/positioning_certificate.hpp"
#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

/// Laser10 text (.rtl), as the readers among public programs take it (docs/import.md): every
/// section and key in column 0, five targets a line with two blanks between, no exponent and no
/// plus sign; run, target, value in um with at least four blanks before the value. A run is one
/// way: odd ones forward from the first target, even ones backward from the last. Deviations are at
/// 20 degC.
/// @errors Fault::refused for a rotary axis, a partial result, or where a reading is left out: the
/// layout has no place for a gap.
Result<std::string> laser10_text(const Certificate& certificate);

/// A row a reading: run, direction (+ and -), target, deviation at 20 degC, and when. `axiscal
/// analyze` takes it as it is. Readings that are left out stand above as remarks.
std::string readings_csv(const Certificate& certificate);

} // namespace axiscal
