#pragma once
// What `axiscal result` says of a positioning run, for people and for programs. Pure.

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// {"run", "unit", "k", "completeness", "parameters": {"A": {"value", "U", "verdict"}},
/// "not_evaluated"} of a document of certificate_to_json(), `unit` that of every value and U. U is
/// null where it was not evaluated. `verdict` of a parameter is null where no limit names it. Of a
/// result with limits also "verdict" of all, "verdicts" and "tolerances" as the document has them,
/// and "setup_findings" where it has them.
nlohmann::ordered_json result_summary(const nlohmann::ordered_json& document);

/// The same of a summary in at most 80 columns, in um or seconds of arc. `about`: machine, axis and
/// time, one line.
std::string result_text(const nlohmann::ordered_json& summary, const std::string& about);

} // namespace axiscal
