#pragma once
// A run file that is added to after the computer was restarted.

#include "analysis/quantity/boot_id.hpp"

namespace axiscal {

struct MeasurementContext;

/// What is written now counts by another monotonic clock: who tells its times has to know. Notes it
/// in the file that the journal has open, unless both boots are the same.
void note_another_boot(const MeasurementContext& context, const BootId& of_run, const BootId& now);

} // namespace axiscal
