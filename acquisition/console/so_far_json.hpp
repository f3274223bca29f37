#pragma once
// How a positioning run stands, as the JSON of docs/api.md. Pure.

#include "analysis/positioning/figures_so_far.hpp"

#include <nlohmann/json_fwd.hpp>

namespace axiscal {

/// `so_far` of the run in the status: without its targets, which the event `points` brings.
nlohmann::ordered_json to_json(const FiguresSoFar& so_far);
/// One of them, in that event. @param index  from 0
nlohmann::ordered_json target_json(int index, const TargetSoFar& target);

} // namespace axiscal
