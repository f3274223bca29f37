#pragma once
// The grammar of certificate numbers. Pure.

#include <string>
#include <string_view>

namespace axiscal {

/// Why `text` is no number and no pattern of numbers, with what would be right; empty: it is one. A
/// pattern has braces: {year}, {count}, and {count:1} to {count:9} with at least so many digits;
/// its count stands in it once, for without one each certificate would bear the same number.
std::string mistake_in_number(std::string_view text);

} // namespace axiscal
