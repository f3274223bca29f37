#include "tools/axiscal/text_columns.hpp"

#include <sstream>

namespace axiscal {

std::size_t columns_of(const std::string& text) {
    std::size_t columns = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const bool mark = byte == 0xCC || (byte == 0xCD && i + 1 < text.size() &&
                                           static_cast<unsigned char>(text[i + 1]) < 0xB0);
        if ((byte & 0xC0U) != 0x80U && !mark) ++columns;
    }
    return columns;
}

std::string padded(std::string text, std::size_t columns) {
    const std::size_t has = columns_of(text);
    return has < columns ? text + std::string(columns - has, ' ') : text;
}

std::string right(const std::string& text, std::size_t columns) {
    const std::size_t has = columns_of(text);
    return has < columns ? std::string(columns - has, ' ') + text : text;
}

std::string wrapped(const std::string& words, std::size_t indent) {
    constexpr std::size_t widest = 80;
    std::istringstream in{words};
    std::string text, line, word;
    while (in >> word) {
        if (!line.empty() && indent + columns_of(line) + 1 + columns_of(word) > widest) {
            text += std::string(indent, ' ') + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return line.empty() ? text : text + std::string(indent, ' ') + line + "\n";
}

} // namespace axiscal
