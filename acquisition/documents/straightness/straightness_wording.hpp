#pragma once
// How a straightness is written on paper. Pure.

#include "acquisition/documents/straightness/straightness_document.hpp"

#include <string>
#include <string_view>

namespace axiscal {

/// "least squares line" | "line through the end points" | "minimum zone".
std::string reference_on_paper(LineReference reference);

/// "least squares ↑" of "straightness_least_squares_forward", "B" of "straightness_B".
std::string straightness_name_on_paper(std::string_view key);

/// How many decimals deviations of this test are printed with.
int straightness_decimals(const StraightnessResult& result);

/// "4.20 µm ± 1.10 µm"; ", U not evaluated" where the budget lacks a term.
std::string straightness_on_paper(const StraightnessResult& result, LineReference reference);

/// "Straightness error of the motion of axis X in direction Y"; of angle steps "Straightness of the
/// line on which a foot of 100 mm stood".
std::string straightness_subject(const StraightnessResult& result);

/// The whole answer in one paragraph: by which line, the other two, k.
std::string straightness_sentence(const StraightnessResult& result);

} // namespace axiscal
