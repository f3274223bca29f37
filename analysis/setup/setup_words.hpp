#pragma once
// A finding as three sentences: what was seen, what it probably is, what to look at. Pure.

#include "analysis/setup/setup_findings.hpp"

namespace axiscal {

void put_into_words(SetupFinding& finding);

/// "Set-up: " and what was seen, what it probably is, what to look at, and what a person answered.
std::string sentence_of(const SetupFinding& finding);

} // namespace axiscal
