#pragma once
// What GET /metrics answers (docs/metrics.md): the status as Prometheus reads it, in base units.
// Pure.

#include <string>

namespace axiscal {

struct StationStatus;

/// Prometheus' text format 0.0.4. Judges nothing and asks for nothing: every number stands in
/// `status`. A value that is not good, or not known, has no line.
std::string metrics_text(const StationStatus& status);

} // namespace axiscal
