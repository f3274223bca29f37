#include "config/toml_tree.hpp"

#include "analysis/quantity/text_encoding.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <toml++/toml.h>
#include <utility>

namespace axiscal {
namespace {

std::string iso_date(const toml::date& date) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%04u-%02u-%02u", unsigned{date.year},
                  unsigned{date.month}, unsigned{date.day});
    return buffer;
}

int line_of(const toml::node& node) {
    return static_cast<int>(node.source().begin.line);
}

// Depth is bounded by the library, which refuses deeply nested values.
TomlNode copy(const toml::node& node);

TomlNode copy_table(const toml::table& table) {
    TomlTable entries;
    for (const auto& [key, value] : table) {
        TomlNode entry = copy(value);
        // An implicit table ("[a.b]" without "[a]") has no place of its own.
        if (entry.line == 0) entry.line = static_cast<int>(key.source().begin.line);
        entries.push_back({std::string{key.str()}, std::move(entry)});
    }
    return {std::move(entries), line_of(table)};
}

TomlNode copy(const toml::node& node) {
    const int line = line_of(node);
    if (const auto* table = node.as_table()) return copy_table(*table);
    if (const auto* array = node.as_array()) {
        TomlArray items;
        for (const auto& item : *array)
            items.push_back(copy(item));
        return {std::move(items), line};
    }
    if (const auto* text = node.as_string()) return {text->get(), line};
    if (const auto* whole = node.as_integer()) return {std::int64_t{whole->get()}, line};
    if (const auto* real = node.as_floating_point()) return {real->get(), line};
    if (const auto* flag = node.as_boolean()) return {flag->get(), line};
    if (const auto* date = node.as_date()) return {TomlDate{iso_date(date->get())}, line};
    return {TomlOther{}, line};
}

/// As it stands in the file, without the blanks around it. `line` counts from 1.
std::string line_text(std::string_view text, std::size_t line) {
    for (; line > 1 && !text.empty(); --line)
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    text = text.substr(0, text.find_first_of("\r\n"));
    constexpr std::size_t longest = 200; // a line that was pasted; never in mid-character
    const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
    text = text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
    return text.size() > longest ? std::string{} : std::string{text};
}

/// What typing programs put for a straight quote.
bool has_curly_quote(std::string_view line) {
    constexpr std::array<std::string_view, 8> quotes{"\u201C", "\u201D", "\u201E", "\u2018",
                                                     "\u2019", "\u201A", "\u00AB", "\u00BB"};
    return std::ranges::any_of(
        quotes, [&](std::string_view quote) { return line.find(quote) != std::string_view::npos; });
}

/// The way out of what the parser complains about; empty where the line and its words must do.
std::string_view way_out(std::string_view description, std::string_view line) {
    const auto says = [&](std::string_view words) {
        return description.find(words) != std::string_view::npos;
    };
    if (has_curly_quote(line)) return ": put straight quotes (\") for the curly ones";
    if (says("value type") || says("expected value") || says("parsing value"))
        return ": behind = stands a number (1, -1, 0.5), true, false, or a text in straight "
               "quotes (\"5 mm\")";
    if (says("comment or whitespace"))
        return ": a value with a unit stands in quotes (\"5 mm\"), and its decimal sign is a point";
    return "";
}

std::string syntax_complaint(const toml::parse_error& error, std::string_view text) {
    const std::string line = line_text(text, error.source().begin.line);
    const std::string_view description = error.description();
    return std::string{description} + (line.empty() ? "" : ", in the line `" + line + "`") +
           std::string{way_out(description, line)};
}

} // namespace

std::string_view kind_of(const TomlNode& node) {
    static constexpr std::string_view names[] = {"a text",        "a whole number", "a number",
                                                 "true or false", "a date",         "a time of day",
                                                 "a list",        "a table"};
    return names[node.value.index()];
}

const TomlNode* find_entry(const TomlNode& node, std::string_view key) {
    const auto* entries = std::get_if<TomlTable>(&node.value);
    if (!entries) return nullptr;
    for (const auto& [name, entry] : *entries)
        if (name == key) return &entry;
    return nullptr;
}

Result<TomlNode> parse_toml(std::string_view text, const std::string& name) {
    if (const auto wrong = wrong_encoding(text))
        return fail(Fault::bad_configuration,
                    name + ":" + std::to_string(wrong->line) + ": " + wrong->reason);
    try {
        return copy_table(toml::parse(text, std::string_view{name}));
    } catch (const toml::parse_error& error) {
        const auto place = error.source().begin;
        return fail(Fault::bad_configuration, name + ":" + std::to_string(place.line) + ":" +
                                                  std::to_string(place.column) + ": " +
                                                  syntax_complaint(error, text));
    } catch (const std::bad_alloc&) {
        return fail(Fault::bad_configuration, name + ": the file is too large for the memory");
    }
}

} // namespace axiscal
