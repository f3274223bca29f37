#pragma once
// The alignment of the beam as the JSON of docs/api.md, and the order back. Pure.

#include "acquisition/live/station_interface.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace axiscal {

nlohmann::ordered_json to_json(const AlignmentView& view);

/// {"action": "begin" | "keep" | "drop", "spot_offset_mm": 1.2}
/// @errors Fault::bad_request naming the field.
Result<AlignmentOrder> alignment_order_from_json(const std::string& body);

} // namespace axiscal
