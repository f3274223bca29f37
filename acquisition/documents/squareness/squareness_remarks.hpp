#pragma once
// What a squareness result is, and is not, in sentences. Pure.

#include "acquisition/documents/squareness/squareness_document.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Sentences for every paper: what is missing, by whom the positions are, what became of the error
/// of the square, what stands in no budget, which readings were set aside, what the checks warned
/// of.
/// @param clock_off  how far the clock was set in mid-run
std::vector<std::string> remarks_on_squareness(const SquarenessResult& result, Duration clock_off);

} // namespace axiscal
