#include "tools/axiscal/arguments/encoding.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace axiscal {
namespace {

/// Each byte that belongs to no character as \xNN, as the shell's $'...' takes it.
std::string with_escapes(std::string_view word) {
    std::string text;
    while (!word.empty()) {
        const std::size_t length = well_formed_length(word);
        if (length > 0) {
            text += word.substr(0, length);
        } else {
            char escape[5];
            std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned char>(word[0]));
            text += escape;
        }
        word.remove_prefix(length > 0 ? length : 1);
    }
    return text;
}

bool is_well_formed(std::string_view word) {
    while (!word.empty()) {
        const std::size_t length = well_formed_length(word);
        if (length == 0) return false;
        word.remove_prefix(length);
    }
    return true;
}

/// `word` itself, or what stands behind the = of `--option=FILE`.
bool names_a_file(const std::string& word) {
    const auto equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    std::error_code ignored;
    return std::filesystem::exists(equals == std::string::npos ? word : word.substr(equals + 1),
                                   ignored);
}

} // namespace

std::optional<std::string> complaint_of_encoding(const std::vector<std::string>& words) {
    for (const std::string& word : words)
        if (!is_well_formed(word) && !names_a_file(word))
            return "'" + valid_text(with_escapes(word)) +
                   "' is not UTF-8, which all words must be: set the terminal to UTF-8 and write "
                   "it again";
    return std::nullopt;
}

} // namespace axiscal
