#pragma once
// The document of a circular test. Pure.

#include "analysis/circular/circle_diagnosis.hpp"
#include "analysis/circular/circular_uncertainty.hpp"

#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>

namespace axiscal {

inline constexpr double degree_per_rad = 180 / std::numbers::pi;

struct CircularAnswer {
    const CircularTest& test;
    const AxisNames& axes;
    const CircularParameters& parameters;
    const CircleDiagnosis& diagnosis;
    const std::optional<CircularBudget>& budget;
};

/// G_ccw of feedback signals is called G_f_ccw.
std::string circular_label(const std::string& key, SignalSource source);

/// "axiscal.result/1" with the contract's keys; feedback signals are named G_f throughout.
nlohmann::ordered_json circular_to_json(const CircularAnswer& answer);

} // namespace axiscal
