#pragma once
// The order of a drift test, from the JSON of docs/api.md. Pure.

#include "acquisition/live/station_interface.hpp"

#include <string>

namespace axiscal {

/// {"of": "axis", "duration_s": 1800, "interval_s": 1, "place_mm": 900, "statements": {...}}; each
/// may be left out. @errors Fault::bad_request naming the field.
Result<DriftRequest> drift_request_from_json(const std::string& body);

} // namespace axiscal
