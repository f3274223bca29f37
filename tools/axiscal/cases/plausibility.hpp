#pragma once
// What a person would ask about a case that can be evaluated: sentences for `remarks`, beside the
// figures, never instead of them. Pure.

#include "analysis/circular/circular_test.hpp"
#include "tools/axiscal/cases/positioning_input.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace axiscal {

/// Targets that are taken in the small unit of the deviations, for want of another key: most
/// programs export micrometres over millimetres.
/// @param key  that would state their unit
std::vector<std::string>
unit_remarks(const std::vector<double>& targets, const std::string& unit, const std::string& key);

/// Of a positioning case: its units, deviations beyond half the interval between targets, and
/// members of `uncertainty` that the rows contradict.
std::vector<std::string> positioning_remarks(const nlohmann::json& object,
                                             const PositioningInput& input);

/// Angles over ten turns, deviations over a millimetre.
std::vector<std::string> circular_remarks(const CircularTest& test);

/// As a sentence holds a number: six digits at most, the point as decimal sign.
std::string six_digits(double value);

/// Puts them behind those that stand in the document; no member where there are none.
void add_remarks(const std::vector<std::string>& remarks, nlohmann::ordered_json& document);

} // namespace axiscal
