#pragma once
// From the touches that a run file holds to the series that clause 6.9 evaluates. Pure.

#include "analysis/probing/probing_delay.hpp"
#include "analysis/record/probing_record.hpp"

namespace axiscal {

/// Consecutive touches of one direction and kind make a series; its readings are the latched
/// points along the direction (their product with the unit vector), so that a late latch reads
/// larger.
ProbingDelayCase case_of(const ProbingRecord& record);

} // namespace axiscal
