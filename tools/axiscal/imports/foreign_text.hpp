#pragma once
// Text of a file whose encoding nobody states. Pure.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace axiscal {

enum class TextEncoding : std::uint8_t { utf8, utf16, gbk, latin1 };
std::string_view name_of(TextEncoding encoding);

struct ForeignText {
    std::string utf8;
    TextEncoding encoding = TextEncoding::utf8;
};

/// UTF-8, or UTF-16 by its byte order mark. Else GBK where every byte above 0x7F belongs to a pair
/// of GB 2312 (both 0xA1 to 0xFE, the first one up to 0xF7), as Chinese text has them, and Latin-1
/// where one does not. A lone accented letter can never be such a pair.
/// @errors Fault::bad_case, "file": half a character of UTF-16, a byte 0.
Result<ForeignText> foreign_text(std::string_view bytes);

} // namespace axiscal
