#pragma once
// The member "report" of a circular case, and the remarks beside it: words for paper. Pure.

#include "tools/axiscal/cases/circular_input.hpp"

namespace axiscal {

/// "report" and, where it does not speak, the remarks "id", "date", "customer", "place", "machine",
/// "operator" and "instrument" of the case itself, as far as they are texts.
/// @errors Fault::bad_case, field "report.…"
Result<CircularReportWords> report_of(const nlohmann::json& object);

} // namespace axiscal
