#pragma once
// Conformity of a figure with its limit when the figure has an uncertainty. Pure.

#include "analysis/record/tolerance_record.hpp"

#include <cstdint>
#include <string_view>

namespace axiscal {

/// What a measurement proves about a limit.
enum class Verdict : std::uint8_t { pass, fail, not_provable };

/// The rule for a supplier's and for a customer's proof at once (ISO 14253-1), for a figure that
/// must not exceed `limit`:
///   pass          value <= limit - guard_band
///   fail          value >  limit + guard_band
///   not_provable  between the two: neither side can prove its case
/// All three in one unit, all finite; guard_band >= 0. Zero is the simple comparison of value and
/// limit. A figure with a sign (B_mean) is given by its magnitude.
Verdict verdict_of(double value, double limit, double guard_band);

/// Distance from the limit at which the rule takes a case as proven:
///   simple        0
///   guard-U       U
///   14253-1:2017  z U / k with z = 1.6449, the one-sided 95 % of the normal distribution (JCGM
///                 106:2012, table 1): the limit bounds the figure from one side
///   none          0, and nobody decides by it
/// `expanded_uncertainty` U >= 0 with its coverage factor k > 0.
double guard_band_of(DecisionRule rule, double expanded_uncertainty, double coverage);

std::string_view name_of(Verdict verdict); ///< "pass" | "fail" | "not_provable"

} // namespace axiscal
