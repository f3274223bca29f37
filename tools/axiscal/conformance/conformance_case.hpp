#pragma once
// One file of the conformance kit: a case, and the figures that a right program gives for it. Pure.
// The format for people: docs/conformance.md.

#include "analysis/quantity/result.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Where expected figures may come from, in falling order of weight.
inline constexpr std::array<std::string_view, 4> conformance_origins{
    "published", "third_party_program", "closed_form", "two_ways"};

// The json library's noexcept constructor of a null throws for other types only.
struct Expectation { // NOLINT(bugprone-exception-escape)
    enum class Kind : std::uint8_t { number, equal, absent };
    std::string at; ///< JSON pointer into the result
    Kind kind = Kind::number;
    double value = 0, tolerance = 0; ///< of Kind::number; the tolerance is absolute
    double scale = 0;                ///< digits are counted from max(|value|, scale)
    nlohmann::json equals;           ///< of Kind::equal: text, boolean or whole number
    std::string reason;              ///< why this tolerance
};

struct ConformanceCase { // NOLINT(bugprone-exception-escape): as above
    std::string id, title, origin, source, derivation;
    nlohmann::json input; ///< what `axiscal analyze` reads
    std::vector<Expectation> expect;
};

/// @param id the file's name without ".json"; the file must carry it.
/// @errors Fault::bad_case with the field ("expect[3].tolerance"); "json" with line and column.
Result<ConformanceCase> read_conformance_case(std::string_view text, const std::string& id);

} // namespace axiscal
