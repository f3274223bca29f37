#pragma once
// Conformity of a figure with its limit when the figure has an uncertainty. Pure.

#include <cstdint>
#include <string_view>

namespace axiscal {

/// What a measurement proves about a limit.
enum class Verdict : std::uint8_t { pass, fail, not_provable };

/// ISO 14253-1, the rule for a supplier's and for a customer's proof at once, for a figure that
/// must not exceed `limit`:
///   pass          value <= limit - expanded_uncertainty
///   fail          value >  limit + expanded_uncertainty
///   not_provable  between the two: neither side can prove its case
/// All three in one unit, all finite; expanded_uncertainty >= 0 (U, k = 2). Zero is the simple
/// comparison of value and limit. A figure with a sign (B_mean) is given by its magnitude.
Verdict verdict_of(double value, double limit, double expanded_uncertainty);

std::string_view name_of(Verdict verdict); ///< "pass" | "fail" | "not_provable"

} // namespace axiscal
