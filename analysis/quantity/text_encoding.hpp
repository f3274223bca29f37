#pragma once
// Whether the bytes of a file are the text that this program reads, and what the editor must do
// when they are not. Pure.

#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

struct WrongEncoding {
    int line = 1;       ///< 1-based, of the first byte that is no UTF-8
    std::string reason; ///< with the way out: "... save the file as UTF-8"
};

/// Empty when `text` is UTF-8 (RFC 3629: no overlong form, no surrogate, at most U+10FFFF) without
/// a NUL. Editors of Windows save UTF-16, which is told apart, and code pages like Latin-1.
std::optional<WrongEncoding> wrong_encoding(std::string_view text);

} // namespace axiscal
