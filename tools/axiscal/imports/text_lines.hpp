#pragma once
// Lines, words and numbers of text that laser programs write. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct TextLine {
    std::size_t number = 0; ///< in the file, from 1
    std::string_view text;  ///< without blanks at its ends
};

std::string_view without_blanks(std::string_view text);
std::vector<TextLine> lines_of(std::string_view text);
/// Between blanks and tabs.
std::vector<std::string_view> words_of(std::string_view text);

/// Fault::bad_case, "line N".
tl::unexpected<Error> refuse_line(std::size_t line, std::string reason);

/// A decimal comma stands for a point: these files part no thousands. At most 1e9.
/// @errors Fault::bad_case, "line N".
Result<double> number_of(std::string_view word, std::size_t line);

} // namespace axiscal
