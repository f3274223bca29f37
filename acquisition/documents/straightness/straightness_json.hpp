#pragma once
// A straightness result as JSON. Deviations in um, positions in mm. Pure.

#include "acquisition/documents/straightness/straightness_document.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// What is stored at the first evaluation: "format", "unit", "parameters", "positions"; no U.
nlohmann::ordered_json straightness_figures_json(const StraightnessResult& result);

/// certificate.json: the figures with their U, against which line they are, the slope of each line
/// (of the set-up, no property of the axis), the budget, the trials, the run.
nlohmann::ordered_json straightness_to_json(const StraightnessResult& result);

} // namespace axiscal
