#pragma once
// `polygon` and `indexing_table` of a rotary positioning case. Pure.

#include "analysis/positioning/reference_angles.hpp"
#include "tools/axiscal/cases/positioning_input.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// Takes the certified deviations out of the table's readings where the case has one of the two
/// members. Refused on a linear axis, together, and beside readings that are positions.
Result<void>
take_out_artefact(const nlohmann::json& object, const CaseAxis& axis, DeviationTable& table);

/// "polygon", "indexing_table", or "" where the case has neither.
std::string artefact_key(const nlohmann::json& object);

} // namespace axiscal
