#pragma once
// What a perfect measurement of the squareness of the simulated axes would find. Pure.

#include "scenario.hpp"
#include "truth.hpp"

#include <nlohmann/json.hpp>

namespace axiscal::simulate {

/// As truth_of(), of a scenario with [squareness]; the plan is that of the second axis. Values and
/// bounds in um/m, 1e-6 rad.
nlohmann::json squareness_truth_of(const Scenario& scenario, const TruthPlan& plan);

} // namespace axiscal::simulate
