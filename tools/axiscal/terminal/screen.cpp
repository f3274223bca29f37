#include "tools/axiscal/terminal/screen.hpp"

#include <algorithm>
#include <array>
#include <cwchar>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t least_notes = 3;
constexpr int fault_lines = 3, fault_indent = 13; // as wide as the words before each value
constexpr std::string_view cut_sign = "…";

struct Letter {
    std::string_view bytes;
    int columns = 1; ///< -1: a control character, or no letter at all
};

/// The letter at the begin of `text`, which is not empty.
Letter first_letter(std::string_view text) {
    std::mbstate_t state{};
    wchar_t letter = 0;
    const std::size_t length = std::mbrtowc(&letter, text.data(), text.size(), &state);
    if (length == 0 || length > text.size()) return {text.substr(0, 1), -1};
    return {text.substr(0, length), ::wcwidth(letter)};
}

/// What is written for a letter, and how wide that is.
std::pair<std::string_view, int> shown(const Letter& letter) {
    if (letter.columns < 0) return {"?", 1};
    return {letter.bytes, letter.columns};
}

/// Bytes of `text` that fit `columns`.
std::size_t fitting(std::string_view text, int columns) {
    std::size_t at = 0;
    for (int used = 0; at < text.size();) {
        const Letter letter = first_letter(text.substr(at));
        used += shown(letter).second;
        if (used > columns) break;
        at += letter.bytes.size();
    }
    return at;
}

std::string printable_letters(std::string_view text) {
    std::string safe;
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        safe += shown(letter).first;
        text.remove_prefix(letter.bytes.size());
    }
    return safe;
}

/// ECMA-48, SGR: bold red, yellow, bold, none, faint.
std::string_view colour_of(Rank rank) {
    static constexpr std::array<std::string_view, 5> colours{"\x1b[1;31m", "\x1b[33m", "\x1b[1m",
                                                             "", "\x1b[2m"};
    return colours[static_cast<std::size_t>(rank)];
}

std::vector<ScreenLine> fold_faults(const std::vector<ScreenLine>& lines, int columns) {
    std::vector<ScreenLine> result;
    for (const ScreenLine& line : lines) {
        const int most = line.rank == Rank::fault ? fault_lines : 1;
        for (std::string& piece : folded(line.text, columns, fault_indent, most))
            result.push_back({line.rank, std::move(piece)});
    }
    return result;
}

/// The first of them, with a word on how many are not shown.
void keep_first(std::vector<ScreenLine>& lines, std::size_t room) {
    if (lines.size() <= room) return;
    const std::size_t left_out = lines.size() - room + 1;
    lines.resize(room);
    if (room > 0)
        lines.back() = {Rank::minor,
                        "  … " + std::to_string(left_out) + " more lines: axiscal status"};
}

} // namespace

int columns_of(std::string_view text) {
    int columns = 0;
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        columns += shown(letter).second;
        text.remove_prefix(letter.bytes.size());
    }
    return columns;
}

std::string cut_to(std::string_view text, int columns) {
    if (columns < 1) return {};
    if (columns_of(text) <= columns) return printable_letters(text);
    return printable_letters(text.substr(0, fitting(text, columns - 1))) + std::string{cut_sign};
}

std::vector<std::string> folded(std::string_view text, int columns, int indent, int most) {
    std::vector<std::string> lines;
    std::string margin;
    while (columns_of(text) > columns - static_cast<int>(margin.size())) {
        const int room = columns - static_cast<int>(margin.size());
        if (static_cast<int>(lines.size()) + 1 >= most || room < 2) break;
        std::size_t end = fitting(text, room);
        const auto blank = text.substr(0, end).find_last_of(' ');
        // A blank in the margin of the first line parts no words.
        if (blank != std::string_view::npos && blank > static_cast<std::size_t>(indent))
            end = blank;
        lines.push_back(margin + printable_letters(text.substr(0, end)));
        text.remove_prefix(end);
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        margin.assign(static_cast<std::size_t>(std::min(indent, columns / 2)), ' ');
    }
    lines.push_back(margin + cut_to(text, columns - static_cast<int>(margin.size())));
    return lines;
}

std::string screen_text(const ScreenParts& parts, ScreenSize size, bool colour) {
    const auto rows = static_cast<std::size_t>(std::max(size.rows, 2) - 1);
    std::vector<ScreenLine> lines = fold_faults(parts.head, size.columns);
    lines.resize(std::min(lines.size(), rows));
    const std::size_t room = rows - lines.size();
    const std::size_t beside_body = room - std::min(room, parts.body.size());
    const std::size_t notes =
        std::min({parts.notes.size(), std::max(least_notes, beside_body), room});
    std::vector<ScreenLine> body = parts.body;
    keep_first(body, room - notes);
    lines.insert(lines.end(), body.begin(), body.end());
    lines.insert(lines.end(), parts.notes.end() - static_cast<std::ptrdiff_t>(notes),
                 parts.notes.end());
    std::string text;
    for (const ScreenLine& line : lines) {
        const std::string_view sign = colour ? colour_of(line.rank) : "";
        text += std::string{sign} + cut_to(line.text, size.columns) +
                (sign.empty() ? "" : "\x1b[0m") + "\n";
    }
    return text;
}

} // namespace axiscal
