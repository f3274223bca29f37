#include "tools/axiscal/tape/tape_look.hpp"

#include "analysis/quantity/counted.hpp"
#include "analysis/quantity/time.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <set>

namespace axiscal {
namespace {

using TapeJson = nlohmann::ordered_json;
using Way = TapeEntry::Direction;

bool is_readable(char letter) {
    return (letter >= ' ' && letter <= '~') || letter == '\t' || letter == '\r' || letter == '\n';
}

std::string bytes_of(const Tape& tape, Way direction) {
    std::string text;
    for (const TapeEntry& entry : tape.entries)
        if (entry.direction == direction)
            for (const std::byte byte : entry.bytes)
                text += static_cast<char>(byte);
    return text;
}

/// Bytes that are no text part words.
std::string readable_of(std::string text) {
    std::ranges::replace_if(
        text, [](char letter) { return !is_readable(letter); }, '\n');
    return text;
}

struct Pattern {
    const char* what;
    const char* needs; ///< no line without one of these letters is searched
    std::regex form;
};

const std::array<Pattern, 4>& patterns() {
    static const std::array<Pattern, 4> known{
        {{"e-mail address", "@",
          std::regex{R"([A-Za-z0-9._%+-]{1,64}@[A-Za-z0-9-]{1,63}(\.[A-Za-z0-9-]{1,63}){1,4})"}},
         {"IP address", ".",
          std::regex{R"(\b(25[0-5]|2[0-4]\d|1?\d?\d)(\.(25[0-5]|2[0-4]\d|1?\d?\d)){3}\b)"}},
         {"hardware address", ":-", std::regex{R"(\b[0-9A-Fa-f]{2}([:-][0-9A-Fa-f]{2}){5}\b)"}},
         {"home folder", "/\\",
          std::regex{R"((/home|/Users|\\Users)(/|\\{1,2})[^/\\\s"]{1,64}|/root/[^/\s"]{1,64})"}}}};
    return known;
}

/// Piece by piece, because a pattern's work grows with its text; no trace is longer than the
/// overlap.
void search(const std::string& where, const std::string& text, std::vector<PrivateTrace>& found) {
    constexpr std::size_t longest = 400, overlap = 150;
    std::set<std::string> told;
    for (std::size_t at = 0; at < text.size();) {
        const auto line_end = std::min(text.find_first_of("\r\n", at), text.size());
        const auto end = std::min(line_end, at + longest);
        const std::string piece = text.substr(at, end - at);
        for (const Pattern& pattern : patterns()) {
            if (piece.find_first_of(pattern.needs) == std::string::npos) continue;
            for (std::sregex_iterator hit{piece.begin(), piece.end(), pattern.form}, none;
                 hit != none; ++hit)
                if (told.insert(hit->str()).second)
                    found.push_back({where, pattern.what, hit->str()});
        }
        at = end < line_end ? end - overlap : end + 1;
    }
}

TapeJson look_at(const Tape& tape, Way direction) {
    const std::string bytes = bytes_of(tape, direction);
    const auto readable = std::ranges::count_if(bytes, is_readable);
    const auto transfers = std::ranges::count(tape.entries, direction, &TapeEntry::direction);
    TapeJson look{{"transfers", transfers}, {"bytes", bytes.size()}};
    look["readable"] =
        bytes.empty() ? 0.0 : static_cast<double>(readable) / static_cast<double>(bytes.size());
    look["lines"] = std::ranges::count(bytes, '\n');
    constexpr std::size_t shown = 80;
    const std::string text = readable_of(bytes);
    const auto begin = std::min(text.find_first_not_of("\r\n"), text.size());
    const auto end = std::min(text.find_first_of("\r\n", begin), text.size());
    look["first_line"] = printable(text.substr(begin, std::min(end - begin, shown)));
    return look;
}

TapeJson stated(const Tape& tape, const char* key) {
    const auto found = tape.header.find(key);
    return found == tape.header.end() || found->second.empty() ? TapeJson{}
                                                               : TapeJson(printable(found->second));
}

std::string rounded(double value) {
    return std::to_string(std::llround(value));
}

std::string line_about(const char* who, const TapeJson& look) {
    const auto bytes = look.at("bytes").get<long>();
    std::string text = std::string{who} + ": " +
                       counted(look.at("transfers").get<long>(), "transfer") + ", " +
                       counted(bytes, "byte");
    if (bytes == 0) return text + "\n";
    text += ", " + rounded(look.at("readable").get<double>() * 100) + " % readable, " +
            counted(look.at("lines").get<long>(), "line");
    const auto first = look.at("first_line").get<std::string>();
    return text + (first.empty() ? "" : "; the first: " + first) + "\n";
}

/// Stretches between two closings in which anything passed.
long openings_of(const Tape& tape) {
    long openings = 0;
    bool open = false;
    for (const TapeEntry& entry : tape.entries) {
        if (!open && entry.direction != Way::closed) ++openings;
        open = entry.direction != Way::closed;
    }
    return openings;
}

} // namespace

std::vector<PrivateTrace> private_traces(const Tape& tape) {
    std::vector<PrivateTrace> found;
    for (const auto& [key, value] : tape.header) {
        if (key == "who" && !value.empty())
            found.push_back({"header who", "name", printable(value)});
        search("header " + key, value, found);
    }
    search("from the instrument", readable_of(bytes_of(tape, Way::in)), found);
    search("to the instrument", readable_of(bytes_of(tape, Way::out)), found);
    return found;
}

TapeJson look_into(const Tape& tape) {
    TapeJson look;
    for (const char* key : {"origin", "driver", "wire"})
        look[key] = stated(tape, key);
    look["seconds"] = tape.entries.empty() ? 0.0 : seconds_of(tape.entries.back().offset);
    look["openings"] = openings_of(tape);
    look["from_instrument"] = look_at(tape, Way::in);
    look["to_instrument"] = look_at(tape, Way::out);
    look["missing"] = TapeJson::array();
    for (const char* key : {"maker", "model", "what", "driver"})
        if (stated(tape, key).is_null()) look["missing"].push_back(key);
    look["private"] = TapeJson::array();
    for (const PrivateTrace& trace : private_traces(tape))
        look["private"].push_back(
            {{"where", trace.where}, {"what", trace.what}, {"text", trace.text}});
    return look;
}

std::string text_of_look(const TapeJson& look) {
    const auto word = [&](const char* key) {
        return look.at(key).is_string() ? look.at(key).get<std::string>()
                                        : std::string{"not stated"};
    };
    std::string text = "Origin " + word("origin") + ", wire " + word("wire") + ", driver " +
                       word("driver") + ", " + rounded(look.at("seconds").get<double>()) + " s\n";
    text += line_about("From the instrument", look.at("from_instrument"));
    text += line_about("To the instrument", look.at("to_instrument"));
    for (const TapeJson& key : look.at("missing"))
        text += "The header does not state " + key.get<std::string>() + "\n";
    for (const TapeJson& trace : look.at("private"))
        text += "Private? " + trace.at("where").get<std::string>() + ": " +
                trace.at("what").get<std::string>() + " " + trace.at("text").get<std::string>() +
                "\n";
    if (look.at("private").empty())
        text += "No name, address or home folder was found in it; read it all the same\n";
    return text;
}

} // namespace axiscal
