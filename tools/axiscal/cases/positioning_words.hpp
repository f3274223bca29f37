#pragma once
// The members that a case's answer carries beside the figures: edition, labels, slope. Pure.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/positioning/styles.hpp"
#include "tools/axiscal/cases/positioning_input.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// "axiscal.result/1" of a standard that is not ISO 230-2.
nlohmann::ordered_json style_to_json(const StyleResult& result, const PositioningInput& input);

/// Adds `axis`, `edition`, `labels` (ISO figures only), `slope` and the standard's note; what the
/// document holds already stays as it is.
void add_words(const PositioningInput& input,
               const std::vector<PositionRow>& rows,
               nlohmann::ordered_json& document);

} // namespace axiscal
