#include "config/toml_tree.hpp"

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
    try {
        return copy_table(toml::parse(text, std::string_view{name}));
    } catch (const toml::parse_error& error) {
        const auto place = error.source().begin;
        return fail(Fault::bad_configuration, name + ":" + std::to_string(place.line) + ":" +
                                                  std::to_string(place.column) + ": " +
                                                  std::string{error.description()});
    } catch (const std::bad_alloc&) {
        return fail(Fault::bad_configuration, name + ": the file is too large for the memory");
    }
}

} // namespace axiscal
