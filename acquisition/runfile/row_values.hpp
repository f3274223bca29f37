#pragma once
// A record's fields as the values of a row. Internal to record_rows.cpp and setups/. Pure.

#include "acquisition/runfile/record_rows.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace axiscal::row_values {

template <class Integer> Value whole(Integer number) {
    return static_cast<std::int64_t>(number);
}
inline Value optional(const std::optional<double>& number) {
    return number ? Value{*number} : Value{};
}
template <class Amount> Value si_or_nothing(const std::optional<Amount>& amount) {
    return amount ? Value{amount->si()} : Value{};
}
inline Value text(std::string_view words) {
    return std::string{words};
}

inline ChainedRow chained(std::string_view table, Row row) {
    return {&table_named(table), std::move(row)};
}

} // namespace axiscal::row_values
