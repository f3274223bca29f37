#pragma once
// What both halves of MissingRows need to read a row and to name a table.

#include "acquisition/journal/record_rows.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace axiscal {

inline constexpr std::string_view first_of_body =
    "datum"; // tables from here on: written in the run

/// Of a table in the order of the chain.
inline std::size_t place_of(std::string_view table) {
    return static_cast<std::size_t>(&table_named(table) - chained_tables().data());
}

inline std::string text_at(const Row& row, std::size_t column) {
    const auto* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr;
    return text ? *text : std::string{};
}

/// -1 for what is no number of a thing; a wrong number is no reason to count to it.
inline int number_at(const Row& row, std::size_t column) {
    constexpr std::int64_t most = 100'000;
    const auto* number = column < row.size() ? std::get_if<std::int64_t>(&row[column]) : nullptr;
    return number ? static_cast<int>(std::clamp<std::int64_t>(*number, -1, most)) : -1;
}

} // namespace axiscal
