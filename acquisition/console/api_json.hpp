#pragma once
// The station's structs as the JSON of docs/api.md, and back. Pure.

#include "acquisition/live/station_interface.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace axiscal {

nlohmann::ordered_json to_json(const StationStatus& status);
nlohmann::ordered_json to_json(const InstrumentView& view);
nlohmann::ordered_json to_json(const Error& error);

/// @errors Fault::bad_request naming the field: unknown keys and wrong types are refused.
Result<ArmRequest> arm_request_from_json(const std::string& body);
nlohmann::ordered_json to_json(const std::vector<PreflightRecord>& checks);
nlohmann::ordered_json to_json(const RetakeAnswer& answer);
/// {"target":3,"direction":"positive","cycle":2,"reason":"..."}; target and cycle count from 0, as
/// everywhere in this interface. @errors Fault::bad_request naming the field.
Result<RevisionRequest> revision_request_from_json(const std::string& body);
/// {"finding":"moved_optic","text":"...","by":"..."}. @errors Fault::bad_request naming the field.
Result<AnswerRequest> answer_request_from_json(const std::string& body);
/// {"arcsec": 1.25}. @errors Fault::bad_request.
Result<double> typed_reading_from_json(const std::string& body);
/// {"reason": "...", "by": "..."} of an abort; both may be left out.
struct AbortRequest {
    std::string reason = "aborted by the operator", by;
};
Result<AbortRequest> abort_request_from_json(const std::string& body);
/// The name that a person gives with an order ("by"): one line of at most 80 bytes.
/// @errors Fault::bad_request
Result<std::string> name_of_orderer(const nlohmann::ordered_json& value);

} // namespace axiscal
