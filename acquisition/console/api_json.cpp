#include "acquisition/console/api_json.hpp"

#include "acquisition/console/optional_json.hpp"
#include "acquisition/console/so_far_json.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const ChannelView& channel) {
    return {{"instrument", channel.instrument},
            {"channel", channel.channel},
            {"name", channel.name},
            {"place", channel.place},
            {"kind", name_of(channel.kind)},
            {"medium", name_of(channel.medium)},
            {"value", or_null(channel.value)},
            {"unit", channel.unit},
            {"age_s", or_null(channel.age_s)},
            {"stale_after_s", or_null(channel.stale_after_s)},
            {"quality", channel.quality},
            {"used", channel.used},
            {"role", channel.role},
            {"due_on", channel.due_on}};
}

Json to_json(const AxisView& axis) {
    return {{"name", axis.name},
            {"kind", name_of(axis.kind)},
            {"reading", axis.reads_angle ? "angle" : "length"},
            {"position_mm", or_null(axis.position_mm)},
            {"deviation_um", or_null(axis.deviation_um)},
            {"displacement_mm", or_null(axis.displacement_mm)},
            {"strength_percent", or_null(axis.strength_percent)},
            {"least_strength_percent", or_null(axis.least_strength_percent)},
            {"spread_um", or_null(axis.spread_um)},
            {"slope_um_per_s", or_null(axis.slope_um_per_s)},
            {"still", axis.still},
            {"age_s", or_null(axis.age_s)},
            {"stale_after_s", or_null(axis.stale_after_s)}};
}

Json to_json(const OutboxView& outbox) {
    return {{"waiting", outbox.waiting},
            {"oldest_s", or_null(outbox.oldest_s)},
            {"alarm", outbox.alarm},
            {"publisher",
             {{"runs", outbox.publisher_runs},
              {"destination", outbox.destination},
              {"state", outbox.state},
              {"reason", outbox.reason},
              {"since_utc", outbox.since_utc}}}};
}

Json to_json(const CircleView& view) {
    return {{"number", view.circle.number},
            {"sense", view.circle.sense == Sense::ccw ? "counterclockwise" : "clockwise"},
            {"repeat", view.circle.repeat},
            {"warm_up", view.circle.warm_up},
            {"begun", view.begun}};
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
            {"skipped", run.skipped},
            {"steps", run.steps},
            {"done", run.done},
            {"retakes_asked", run.retakes_asked},
            {"retakes_left", run.retakes_left},
            {"excluded", run.excluded},
            {"next", std::move(next)},
            {"circle", run.circle ? to_json(*run.circle) : Json(nullptr)},
            {"seconds_left", or_null(run.seconds_left)},
            {"last_deviation_um", or_null(run.last_deviation_um)},
            {"last_synchronisation_um", or_null(run.last_synchronisation_um)},
            {"so_far", run.so_far ? to_json(*run.so_far) : Json(nullptr)},
            {"fault", run.last_fault},
            {"sentence", run.last_sentence},
            {"certificate", run.certificate}};
}

Json to_json(const DriftView& drift) {
    return {{"id", drift.run_id},
            {"state", drift.state},
            {"file", drift.file},
            {"certificate", drift.certificate},
            {"of", drift.of_bar ? "ballbar" : "axis"},
            {"place_mm", or_null(drift.place_mm)},
            {"taken", drift.taken},
            {"missing", drift.missing},
            {"planned", drift.planned},
            {"range_um", or_null(drift.range_um)},
            {"seconds_left", or_null(drift.seconds_left)},
            {"sentence", drift.sentence}};
}

Json to_json(const ToDo& entry) {
    return {{"id", entry.id},
            {"rank", name_of(entry.rank)},
            {"source", name_of(entry.source)},
            {"seen", entry.seen},
            {"since_utc", entry.since_utc},
            {"next", entry.next},
            {"command", entry.command},
            {"undo", entry.undo}};
}

Json trigger_json(const StationStatus& status) {
    const PortCounters& counters = status.trigger_counters;
    return {{"port", status.trigger},
            {"cnc_silent", status.cnc_silent},
            {"note", status.trigger_note},
            {"requests", counters.requests},
            {"exceptions", counters.exceptions},
            {"refused", counters.refused},
            {"strangers", counters.strangers},
            {"hung_up", counters.hung_up}};
}

} // namespace

nlohmann::ordered_json to_json(const InstrumentView& view) {
    const InstrumentCounters& counters = view.counters;
    return {{"name", view.name},
            {"driver", view.driver},
            {"state", shown_state(view)},
            {"tape", view.tape},
            {"maker", view.identity.maker},
            {"model", view.identity.model},
            {"serial", view.identity.serial},
            {"firmware", view.identity.firmware},
            {"due_on", view.due_on},
            {"restarts", view.restarts},
            {"frames", counters.frames},
            {"samples", counters.samples},
            {"bad_frames", counters.bad_frames},
            {"checksum_errors", counters.checksum_errors},
            {"gaps", counters.gaps},
            {"lost_records", counters.lost_records},
            {"timeouts", counters.timeouts},
            {"fault", fault_name(view.last_fault)},
            {"note", view.last_note},
            {"repeats", view.repeats}};
}

nlohmann::ordered_json to_json(const std::vector<PreflightRecord>& checks) {
    Json list = Json::array();
    for (const PreflightRecord& check : checks)
        list.push_back({{"name", check.name},
                        {"passed", check.passed},
                        {"warning", check.warning},
                        {"verdict", check.verdict},
                        {"override", check.override_reason}});
    return list;
}

nlohmann::ordered_json to_json(const RetakeAnswer& answer) {
    Json points = Json::array();
    for (const RetakeAnswer::Point& point : answer.points)
        points.push_back({{"step", point.step},
                          {"target", point.planned.target_index},
                          {"direction", name_of(point.planned.direction)},
                          {"approach", point.planned.approach}});
    return {{"points", std::move(points)}, {"last_request", answer.last_request}};
}

nlohmann::ordered_json to_json(const Error& error) {
    Json json{{"fault", fault_name(error.fault)}, {"sentence", describe(error)}};
    if (!error.field.empty()) json["field"] = error.field;
    return {{"error", std::move(json)}};
}

nlohmann::ordered_json to_json(const StationStatus& status) {
    Json channels = Json::array(), instruments = Json::array(), to_do = Json::array();
    for (const ChannelView& channel : status.channels)
        channels.push_back(to_json(channel));
    for (const InstrumentView& view : status.instruments)
        instruments.push_back(to_json(view));
    for (const ToDo& entry : status.to_do)
        to_do.push_back(to_json(entry));
    return {{"protocol", "axiscal/1"},
            {"station", status.station},
            {"version", status.version},
            {"utc", status.utc},
            {"axis", to_json(status.axis)},
            {"channels", std::move(channels)},
            {"instruments", std::move(instruments)},
            {"trigger", trigger_json(status)},
            {"run", status.run ? to_json(*status.run) : Json(nullptr)},
            {"run_open", status.run_open},
            {"drift", status.drift ? to_json(*status.drift) : Json(nullptr)},
            {"outbox_entries", status.outbox.waiting},
            {"outbox", to_json(status.outbox)},
            {"notes", status.notes},
            {"to_do", std::move(to_do)}};
}

} // namespace axiscal
