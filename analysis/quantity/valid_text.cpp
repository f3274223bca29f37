#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace axiscal {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD"; // U+FFFD

/// Which second bytes may follow a lead byte, and how many bytes the whole has.
struct Lead {
    std::size_t length = 0; ///< 0: no lead byte
    std::uint8_t lowest = 0x80, highest = 0xBF;
};

/// The Unicode Standard 15.0, table 3-7: neither overlong forms, surrogates, nor beyond U+10FFFF.
Lead lead_of(std::uint8_t byte) {
    if (byte < 0x80) return {1};
    if (byte < 0xC2 || byte > 0xF4) return {};
    if (byte < 0xE0) return {2};
    if (byte == 0xE0) return {3, 0xA0, 0xBF};
    if (byte == 0xED) return {3, 0x80, 0x9F};
    if (byte < 0xF0) return {3};
    if (byte == 0xF0) return {4, 0x90, 0xBF};
    return byte == 0xF4 ? Lead{4, 0x80, 0x8F} : Lead{4};
}

struct Piece {
    std::size_t length = 1; ///< bytes, at least 1
    bool well_formed = false;
};

/// One character, or the maximal part of an ill-formed one. `text` is not empty.
Piece first_piece(std::string_view text) {
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(text[at]); };
    const Lead lead = lead_of(byte(0));
    if (lead.length == 0) return {};
    for (std::size_t at = 1; at < lead.length; ++at) {
        const std::uint8_t lowest = at == 1 ? lead.lowest : 0x80;
        const std::uint8_t highest = at == 1 ? lead.highest : 0xBF;
        if (at == text.size() || byte(at) < lowest || byte(at) > highest) return {at, false};
    }
    return {lead.length, true};
}

/// C0, DEL, C1 (U+0080 to U+009F), U+2028 and U+2029.
bool breaks_a_line(std::string_view character) {
    const auto first = static_cast<std::uint8_t>(character.front());
    if (character.size() == 1) return first < 0x20 || first == 0x7F;
    if (character.size() == 2)
        return first == 0xC2 && static_cast<std::uint8_t>(character[1]) < 0xA0;
    return character == "\xE2\x80\xA8" || character == "\xE2\x80\xA9";
}

bool is_kept(char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || letter == '_';
}

/// Microsoft, "Naming Files, Paths, and Namespaces": what no file may be called.
bool is_device_of_windows(std::string_view id) {
    std::string upper{id};
    std::ranges::transform(upper, upper.begin(), [](char letter) {
        return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    });
    static constexpr std::array<std::string_view, 4> devices{"CON", "PRN", "AUX", "NUL"};
    if (std::ranges::find(devices, upper) != devices.end()) return true;
    return upper.size() == 4 && (upper.starts_with("COM") || upper.starts_with("LPT")) &&
           upper[3] >= '0' && upper[3] <= '9';
}

} // namespace

std::string valid_text(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size());
    while (!bytes.empty()) {
        const Piece piece = first_piece(bytes);
        const std::string_view character = bytes.substr(0, piece.length);
        text += !piece.well_formed         ? replacement
                : breaks_a_line(character) ? std::string_view{" "}
                                           : character;
        bytes.remove_prefix(piece.length);
    }
    return text;
}

std::size_t well_formed_length(std::string_view text) {
    if (text.empty()) return 0;
    const Piece piece = first_piece(text);
    return piece.well_formed ? piece.length : 0;
}

std::string id_of_name(std::string_view name, std::string_view otherwise, std::size_t longest) {
    std::string id;
    bool gap = false;
    for (const char letter : name) {
        if (!is_kept(letter)) {
            gap = !id.empty();
            continue;
        }
        if (gap) id += '-';
        gap = false;
        id += letter;
    }
    id.resize(std::min(id.size(), longest));
    while (id.ends_with('-'))
        id.pop_back();
    if (id.empty()) id = otherwise;
    return is_device_of_windows(id) ? id + '_' : id;
}

} // namespace axiscal
