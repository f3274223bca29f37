#pragma once
// Reads the members of a case: each refusal names the field as the user wrote it. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

using Words = std::vector<std::string>;
using Rows = std::vector<std::vector<double>>;

/// Refuses a value that is no object, and every key that is neither known nor a remark
/// ("comment", "note", ...), with the nearest known word. `field` names the object; empty: the
/// case.
Result<void>
check_object(const nlohmann::json& object, const std::string& field, const Words& known);

/// The member `key`; `field` is its full name in refusals.
Result<const nlohmann::json*>
member(const nlohmann::json& object, const std::string& key, const std::string& field);

Result<std::string>
text_of(const nlohmann::json& object, const std::string& key, const std::string& field);

/// A text out of a list; the refusal shows the list.
Result<std::string> one_of(const nlohmann::json& object,
                           const std::string& key,
                           const std::string& field,
                           const Words& allowed);

/// A finite number; a NaN or infinity token is named.
Result<double> number_of(const nlohmann::json& value, const std::string& field);

/// The number under `key`.
Result<double>
number_at(const nlohmann::json& object, const std::string& key, const std::string& field);

/// The number under `key`, greater than 0 and at most 1e12.
Result<double>
positive_at(const nlohmann::json& object, const std::string& key, const std::string& field);

/// The number under `key`, or `missing` where the key does not stand.
Result<double> number_or(const nlohmann::json& object,
                         const std::string& key,
                         const std::string& field,
                         double missing);

Result<std::vector<double>> numbers_of(const nlohmann::json& array, const std::string& field);

/// The array of numbers under `key`.
Result<std::vector<double>>
numbers_at(const nlohmann::json& object, const std::string& key, const std::string& field);

Result<Rows> rows_of(const nlohmann::json& array, const std::string& field);

/// "forward[2]"
std::string indexed(const std::string& field, std::size_t index);

} // namespace axiscal
