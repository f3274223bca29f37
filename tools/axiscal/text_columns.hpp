#pragma once
// Words in the columns of a terminal. Pure.

#include <cstddef>
#include <string>

namespace axiscal {

/// Columns that a terminal gives to UTF-8 text without wide letters; a combining mark takes none.
std::size_t columns_of(const std::string& text);
/// Filled with spaces up to so many columns, behind or before the text; a longer one stays whole.
std::string padded(std::string text, std::size_t columns);
std::string right(const std::string& text, std::size_t columns);
/// Words in lines of at most 80 columns, each begun with `indent` spaces.
std::string wrapped(const std::string& words, std::size_t indent);

} // namespace axiscal
