#pragma once
// The text of a case file as a JSON document, with what JSON itself would lose. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace axiscal {

/// 64 MiB: of a case, and of a table that it opens.
inline constexpr std::size_t largest_case_bytes = std::size_t{64} << 20;

struct CaseText {
    nlohmann::json document;
    /// Key that stands twice, by place in the top array (0 for a single object).
    std::map<std::size_t, std::string> repeated_keys;
};

/// Reads UTF-8 JSON, with or without byte order mark. NaN, Infinity and numbers beyond a double
/// (1e999) are no JSON numbers: they become strings that not_finite_token() knows, so that the
/// refusal can name their field.
/// @errors Fault::bad_case, field "json": not JSON (with line and column), larger than 64 MiB,
/// nested deeper than 64.
Result<CaseText> read_case_text(std::string_view text);

/// The token ("NaN", "-Infinity", "1e999") that stood at the place of `value`; empty if it was
/// none.
std::string not_finite_token(const nlohmann::json& value);

/// `text` as one line of plain ASCII: whatever else it holds becomes '?'.
std::string printable(std::string_view text);

} // namespace axiscal
