#pragma once
// What a perfect calibration of the simulated machine would find, computed from the injected
// curves by code of our own. axiscald never opens this.

#include "scenario.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace axiscal::simulate {

/// The measured points of a part program.
struct TruthPlan {
    std::vector<double> targets_mm; ///< ascending
    int approaches = 1;             ///< of each target in each direction
    bool bidirectional = true;
};

/// Runs the program on a machine of paper and notes where it asked for a capture (or, without any
/// request, where it dwelled most often). @errors bad_request; incomplete_run without any point.
Result<TruthPlan> plan_of_program(const std::string& text, bool marlin, const Scenario& scenario);

/// The truth document: {"parameters":{"E":{"value","bound"},"A":{"value","low","high"},...}}, in
/// mm, keys as in the certificate, with the terms of each bound. Pure; same seed, same bits.
nlohmann::json truth_of(const Scenario& scenario, const TruthPlan& plan);

/// One evaluation of deviations (um) [target][approach]; the keys of the certificate. An empty
/// backward gives the parameters of one direction; one approach those without s.
/// Source: ISO 230-2:2014, own formula code. Pure.
std::map<std::string, double> evaluate_truth(const std::vector<std::vector<double>>& forward_um,
                                             const std::vector<std::vector<double>>& backward_um);

} // namespace axiscal::simulate
