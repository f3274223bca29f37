#pragma once
// What `axiscal budget` says of the uncertainty of a run, for programs and for people. Pure.

#include "acquisition/documents/test_result.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// {"run", "unit", "k", "inputs": [{"term", "quantity", "value", "unit", "origin", "where", "seen",
/// "seen_in", "exceeded"}], "terms": [{"term", "u", "formula", "status"}], "parameters": {"A":
/// {"u", "U"}}, "missing": ["..."]}. `unit` is that of every u and U: "um", of a rotary axis
/// "arcsec". `value` is null where it is missing, `seen` where the readings show nothing of it.
/// @errors Fault::refused of a drift or probing test, which has no budget.
Result<nlohmann::ordered_json> budget_summary(const TestResult& result);

/// The same of a summary in at most 80 columns.
std::string budget_text(const nlohmann::ordered_json& summary);

} // namespace axiscal
