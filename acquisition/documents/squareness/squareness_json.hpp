#pragma once
// A squareness result as JSON. Figures in um/m with the same angle in seconds of arc, deviations in
// um, positions in mm. Pure.

#include "acquisition/documents/squareness/squareness_document.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// What is stored at the first evaluation: "format", "unit", "parameters", "positions"; no U.
nlohmann::ordered_json squareness_figures_json(const SquarenessResult& result);

/// certificate.json: the figures, U of the one that has it, the square and what became of its
/// error, every line with its slopes (of the set-up, no property of an axis), the budget, the run.
nlohmann::ordered_json squareness_to_json(const SquarenessResult& result);

} // namespace axiscal
