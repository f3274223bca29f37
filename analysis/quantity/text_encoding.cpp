#include "analysis/quantity/text_encoding.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <cstdio>

namespace axiscal {
namespace {

constexpr std::string_view way_out = ": save the file as UTF-8 in your editor";

bool is_utf_16(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
    return text.size() > 1 && (text[0] == '\0') != (text[1] == '\0'); // one half of each letter
}

} // namespace

std::optional<WrongEncoding> wrong_encoding(std::string_view text) {
    if (is_utf_16(text))
        return WrongEncoding{1, "the file is UTF-16, as editors of Windows may save it" +
                                    std::string{way_out}};
    int line = 1;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = well_formed_length(text.substr(at));
        if (text[at] == '\0')
            return WrongEncoding{line, "a byte 0 stands there, so this is no text file"};
        if (length == 0) {
            char byte[8];
            std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned char>(text[at]));
            return WrongEncoding{line, "the byte " + std::string{byte} +
                                           " is no UTF-8 (a letter or sign of Latin-1 or of "
                                           "Windows-1252?)" +
                                           std::string{way_out}};
        }
        line += text[at] == '\n' ? 1 : 0;
        at += length;
    }
    return std::nullopt;
}

} // namespace axiscal
