#pragma once
// The verdict on the limits, as it stands on paper.

#include "acquisition/documents/pdf/sheet.hpp"
#include "analysis/conformity/conformity.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

/// Where paper writes the parameter's own name.
inline std::string symbol_as_it_is(std::string_view parameter) {
    return std::string{parameter};
}

/// "PASS", "FAIL: R, B", "NOT PROVABLE: R", "NO VERDICT: A", "No limits agreed: no verdict".
/// @param symbol_of  what paper writes for a parameter
std::string verdict_on_paper(const std::optional<Conformity>& conformity,
                             const std::function<std::string(std::string_view)>& symbol_of);

/// Value, U, limit, guard band and verdict of each limit, where the limits are from, and the rule
/// in words; nothing without limits.
void draw_conformity(Sheet& sheet,
                     const std::optional<Conformity>& conformity,
                     const std::function<std::string(std::string_view)>& symbol_of);

} // namespace axiscal
