#pragma once
// Lines of comma-separated values as certificates write them. Pure.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

/// The shortest digits that give the same double again.
std::string csv_number(double value);
/// The same; empty where there is none.
std::string csv_number(const std::optional<double>& value);

/// One field: no line breaks, quoted where a comma or a quote would end it.
std::string csv_field(std::string_view words);

/// Fields and the end of the line.
void append_csv_line(std::string& csv, std::initializer_list<std::string> fields);

} // namespace axiscal
