#pragma once
// How the run file tells that the CNC skipped a step: an event of kind `skipped` with this text.

#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>

namespace axiscal {

std::string skip_text(int step);
/// Empty for any other event.
std::optional<int> skipped_step(const EventRecord& event);

} // namespace axiscal
