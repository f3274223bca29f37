#pragma once
// Numbers that enter an analysis: finite, and of a size whose squares do not overflow. Pure.

#include "analysis/quantity/result.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Far beyond any machine in any unit, far below where a square overflows.
inline constexpr double largest_case_number = 1e12;

/// "forward[2]"
std::string element_of(const std::string& field, std::size_t index);

/// @errors Fault::bad_case with `field` for NaN, infinities and magnitudes above 1e12.
Result<void> check_case_number(double value, const std::string& field);
Result<void> check_case_numbers(const std::vector<double>& values, const std::string& field);

/// Finite, larger than 0, at least 1e-12: something may be divided by it.
Result<void> check_positive(double value, const std::string& field);

/// Each larger than the one before, by more than the rounding of the largest.
Result<void> check_rising(const std::vector<double>& values, const std::string& field);

} // namespace axiscal
