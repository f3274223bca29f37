#pragma once
// What the JSON of a straightness and of a squareness say alike of their run. Pure.

#include "acquisition/documents/straightness/across_run_file.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// `document` gains "completeness", "certificate" {"number", "replaces"} and "run": which run, with
/// what, by which optics, every deviation that counts in um, what happened, the remarks.
void add_across_run(nlohmann::ordered_json& document, const AcrossRun& one);

/// ... and "preliminary": whether a term of the budget is not stated, and "missing": which, in
/// words.
void add_missing(nlohmann::ordered_json& document, const std::vector<std::string>& not_stated);

} // namespace axiscal
