#pragma once
// The parsed file as plain nodes with their lines; keeps the TOML library inside one source file.
// Internal to config/. Pure.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace axiscal {

struct TomlNode;
struct TomlEntry;
using TomlArray = std::vector<TomlNode>;
/// In the order of the library's map; the line of each node tells the order in the file.
using TomlTable = std::vector<TomlEntry>;
/// A local date, written "2026-11-21".
struct TomlDate {
    std::string iso;
};
/// A value the station file has no use for (times of day).
struct TomlOther {};

struct TomlNode {
    std::variant<std::string, std::int64_t, double, bool, TomlDate, TomlOther, TomlArray, TomlTable>
        value;
    int line = 0; ///< 1-based; of a table: its header, or its first key
};

struct TomlEntry {
    std::string key;
    TomlNode node;
};

/// "a text", "a whole number", ...: what a value of the file is, for messages.
std::string_view kind_of(const TomlNode& node);
/// nullptr when absent or when `node` is no table.
const TomlNode* find_entry(const TomlNode& node, std::string_view key);

/// @errors Fault::bad_configuration "name:line:column: what the parser says", the line itself and
/// the way out; "name:line: ..." for a file that is no UTF-8.
Result<TomlNode> parse_toml(std::string_view text, const std::string& name);

} // namespace axiscal
