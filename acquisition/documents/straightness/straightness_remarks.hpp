#pragma once
// What a straightness result is, and is not, in sentences. Pure.

#include "acquisition/documents/straightness/straightness_document.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Sentences for every paper: what is missing, by whom the positions are, what the optics add, what
/// stands in no budget, which readings were set aside, what the checks warned of.
/// @param clock_off  how far the clock was set in mid-run
std::vector<std::string> remarks_on_straightness(const StraightnessResult& result,
                                                 Duration clock_off);

} // namespace axiscal
