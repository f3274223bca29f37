#pragma once
// The station's structs as the JSON of docs/api.md, and back. Pure.

#include "acquisition/station/station_face.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace axiscal {

nlohmann::ordered_json to_json(const StationStatus& status);
nlohmann::ordered_json to_json(const InstrumentView& view);
nlohmann::ordered_json to_json(const Error& error);

/// @errors Fault::bad_request naming the field: unknown keys and wrong types are refused.
Result<ArmRequest> arm_request_from_json(const std::string& body);
/// The optional {"reason": "..."} of an abort.
Result<std::string> abort_reason_from_json(const std::string& body);

} // namespace axiscal
