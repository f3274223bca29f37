#include "acquisition/console/api_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

template <class T> Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json to_json(const ChannelView& channel) {
    return {{"instrument", channel.instrument},
            {"channel", channel.channel},
            {"place", channel.place},
            {"kind", name_of(channel.kind)},
            {"medium", name_of(channel.medium)},
            {"value", or_null(channel.value)},
            {"unit", channel.unit},
            {"age_s", or_null(channel.age_s)},
            {"quality", channel.quality},
            {"used", channel.used}};
}

Json to_json(const AxisView& axis) {
    return {{"name", axis.name},
            {"position_mm", or_null(axis.position_mm)},
            {"deviation_um", or_null(axis.deviation_um)},
            {"displacement_mm", or_null(axis.displacement_mm)},
            {"strength_percent", or_null(axis.strength_percent)},
            {"spread_um", or_null(axis.spread_um)},
            {"slope_um_per_s", or_null(axis.slope_um_per_s)},
            {"still", axis.still}};
}

Json to_json(const RunStatus& run) {
    Json next = nullptr;
    if (run.next_target)
        next = {
            {"target", *run.next_target},
            {"nominal_mm", or_null(run.next_nominal_mm)},
            {"direction", run.next_direction ? Json(name_of(*run.next_direction)) : Json(nullptr)},
            {"approach", or_null(run.next_approach)}};
    return {{"id", run.run_id},
            {"pass", run.pass},
            {"state", run.state},
            {"file", run.file},
            {"step", run.step},
            {"steps", run.steps},
            {"done", run.done},
            {"next", std::move(next)},
            {"seconds_left", or_null(run.seconds_left)},
            {"last_deviation_um", or_null(run.last_deviation_um)},
            {"fault", run.last_fault},
            {"sentence", run.last_sentence},
            {"certificate", run.certificate}};
}

constexpr std::array statement_keys{"certificate_number",
                                    "customer",
                                    "place",
                                    "operator",
                                    "approver",
                                    "procedure",
                                    "state",
                                    "warm_up",
                                    "offsets",
                                    "idle_axes",
                                    "sensor_note",
                                    "next_due",
                                    "control_compensation"};

Result<void> read_statements(const Json& given, ArmRequest& request) {
    if (!given.is_object())
        return refuse(Fault::bad_request, "statements", "must be an object of texts");
    for (const auto& [key, value] : given.items()) {
        if (std::ranges::find(statement_keys, key) == statement_keys.end())
            return refuse(Fault::bad_request, "statements." + key,
                          "is not a statement; docs/api.md lists them");
        if (!value.is_string())
            return refuse(Fault::bad_request, "statements." + key, "must be a text");
        request.statements[key] = value.get<std::string>();
    }
    return {};
}

Result<void> read_arm_field(const std::string& key, const Json& value, ArmRequest& request) {
    if (key == "datum_mm" && value.is_number())
        return request.datum_mm = value.get<double>(), Result<void>{};
    if (key == "pass" && value.is_string())
        return request.pass = value.get<std::string>(), Result<void>{};
    if (key == "seed" && value.is_number_unsigned())
        return request.seed = value.get<std::uint64_t>(), Result<void>{};
    if (key == "datum_by_cnc" && value.is_boolean())
        return request.datum_by_cnc = value.get<bool>(), Result<void>{};
    if (key == "statements") return read_statements(value, request);
    const bool known = key == "datum_mm" || key == "pass" || key == "seed" || key == "datum_by_cnc";
    return refuse(Fault::bad_request, key,
                  known ? "has the wrong type"
                        : "is unknown; known are datum_mm, pass, seed, datum_by_cnc, statements");
}

Result<Json> parse_object(const std::string& body) {
    Json parsed = Json::parse(body.empty() ? "{}" : body, nullptr, false);
    if (parsed.is_discarded()) return refuse(Fault::bad_request, "body", "is not JSON");
    if (!parsed.is_object()) return refuse(Fault::bad_request, "body", "must be a JSON object");
    return parsed;
}

} // namespace

nlohmann::ordered_json to_json(const InstrumentView& view) {
    const InstrumentCounters& counters = view.counters;
    return {{"name", view.name},
            {"driver", view.driver},
            {"state", name_of(view.state)},
            {"maker", view.identity.maker},
            {"model", view.identity.model},
            {"serial", view.identity.serial},
            {"firmware", view.identity.firmware},
            {"restarts", view.restarts},
            {"frames", counters.frames},
            {"samples", counters.samples},
            {"bad_frames", counters.bad_frames},
            {"checksum_errors", counters.checksum_errors},
            {"gaps", counters.gaps},
            {"lost_records", counters.lost_records},
            {"fault", fault_name(view.last_fault)},
            {"note", view.last_note},
            {"repeats", view.repeats}};
}

nlohmann::ordered_json to_json(const Error& error) {
    Json json{{"fault", fault_name(error.fault)}, {"sentence", describe(error)}};
    if (!error.field.empty()) json["field"] = error.field;
    return {{"error", std::move(json)}};
}

nlohmann::ordered_json to_json(const StationStatus& status) {
    Json channels = Json::array(), instruments = Json::array();
    for (const ChannelView& channel : status.channels)
        channels.push_back(to_json(channel));
    for (const InstrumentView& view : status.instruments)
        instruments.push_back(to_json(view));
    return {{"protocol", "axiscal/1"},
            {"station", status.station},
            {"version", status.version},
            {"utc", status.utc},
            {"axis", to_json(status.axis)},
            {"channels", std::move(channels)},
            {"instruments", std::move(instruments)},
            {"trigger",
             {{"port", status.trigger},
              {"cnc_silent", status.cnc_silent},
              {"note", status.trigger_note}}},
            {"run", status.run ? to_json(*status.run) : Json(nullptr)},
            {"run_open", status.run_open},
            {"outbox_entries", status.outbox_entries},
            {"notes", status.notes}};
}

Result<ArmRequest> arm_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    ArmRequest request;
    for (const auto& [key, value] : parsed.items())
        AXISCAL_CHECK(read_arm_field(key, value, request));
    return request;
}

Result<std::string> abort_reason_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    if (!parsed.contains("reason")) return std::string{"aborted by the operator"};
    if (!parsed["reason"].is_string())
        return refuse(Fault::bad_request, "reason", "must be a text");
    return parsed["reason"].get<std::string>();
}

} // namespace axiscal
