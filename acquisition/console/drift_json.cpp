#include "acquisition/console/drift_json.hpp"

#include "acquisition/console/api_json.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double longest_s = 14.0 * 24 * 3600, farthest_mm = 1e5;

Result<void> read_span(const Json& value, const std::string& key, Duration& span) {
    constexpr double shortest_s = 0.05;
    const bool fits =
        value.is_number() && value.get<double>() >= shortest_s && value.get<double>() <= longest_s;
    if (!fits)
        return refuse(Fault::bad_request, key, "must be a number of seconds, 0.05 to two weeks");
    span = from_seconds(value.get<double>());
    return {};
}

/// Asked before the value is written anew: writing goes down into each nest, and a body holds one
/// so deep that it takes the whole stack.
bool is_table_of_texts(const Json& value) {
    return value.is_object() &&
           std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_string(); });
}

Result<void> read_drift_field(const std::string& key, const Json& value, DriftRequest& request) {
    if (key == "duration_s") return read_span(value, key, request.duration);
    if (key == "interval_s") return read_span(value, key, request.interval);
    if (key == "place_mm") {
        if (!value.is_number() || !(std::fabs(value.get<double>()) <= farthest_mm))
            return refuse(Fault::bad_request, key, "must be a coordinate in mm");
        return request.place_mm = value.get<double>(), Result<void>{};
    }
    if (key == "of") {
        if (value != "axis" && value != "ballbar")
            return refuse(Fault::bad_request, key, "must be \"axis\" or \"ballbar\"");
        return request.of_bar = value == "ballbar", Result<void>{};
    }
    if (key == "by") {
        AXISCAL_TRY(request.by.name, name_of_orderer(value));
        return {};
    }
    if (key != "statements")
        return refuse(Fault::bad_request, key,
                      "is unknown; known are by, duration_s, interval_s, of, place_mm, statements");
    if (!is_table_of_texts(value))
        return refuse(Fault::bad_request, key, "must be an object of texts");
    // Statements are those of a run, read by the same rules.
    AXISCAL_TRY(ArmRequest run, arm_request_from_json(json_text(Json{{"statements", value}})));
    request.statements = std::move(run.statements);
    return {};
}

} // namespace

Result<DriftRequest> drift_request_from_json(const std::string& body) {
    const Json parsed = Json::parse(body.empty() ? "{}" : body, nullptr, false);
    if (!parsed.is_object()) return refuse(Fault::bad_request, "body", "must be a JSON object");
    DriftRequest request;
    for (const auto& [key, value] : parsed.items())
        AXISCAL_CHECK(read_drift_field(key, value, request));
    return request;
}

} // namespace axiscal
