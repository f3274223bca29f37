#pragma once
// The result as the document "axiscal.result/1". Pure.

#include "analysis/positioning/positioning_accuracy.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// format, standard, unit, compensation ("already_at_20C" | "compensated_to_20C"), parameters,
/// positions and, where something is missing, not_evaluated (key -> reason). What the data do not
/// allow is absent. All figures in `unit`; in `positions` all but `target` are deviations (actual -
/// target) or derived from them; B_mean is signed, forward minus backward. Every double survives
/// dump() and parse() exactly.
/// certificate.json is this document with "run" and "environment" added and "compensation" replaced
/// by an object.
nlohmann::ordered_json result_to_json(const PositioningResult& result);

} // namespace axiscal
