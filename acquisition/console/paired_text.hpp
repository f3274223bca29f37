#pragma once
// The paired browsers as the text of their file. Pure.

#include "acquisition/console/pairing.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// One line a browser: hash of the token, since when, the last order ("-": none), both in
/// nanoseconds of UTC, and the name to the end of the line.
std::string paired_text(const std::vector<PairedBrowser>& paired);
/// What paired_text() wrote, and nothing else. @errors Fault::refused naming the line.
Result<std::vector<PairedBrowser>> paired_of_text(std::string_view text);

} // namespace axiscal
