#include "acquisition/documents/record_json.hpp"

#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {

using Json = nlohmann::ordered_json;

/// Json(x), not Json{x}: braces make an array of one.
Json stated_json(const std::string& text) {
    return text.empty() ? Json{} : Json(text);
}

Json statements_json(const Statements& said) {
    Json object;
    object["certificate_number"] = stated_json(said.certificate_number);
    object["laboratory"] = stated_json(said.laboratory);
    object["customer"] = stated_json(said.customer);
    object["place"] = stated_json(said.place);
    object["machine"] = stated_json(said.machine);
    object["machine_maker"] = stated_json(said.machine_maker);
    object["machine_serial"] = stated_json(said.machine_serial);
    object["axis"] = stated_json(said.axis);
    object["operator"] = stated_json(said.operator_name);
    object["approver"] = stated_json(said.approver);
    object["procedure"] = stated_json(said.procedure);
    object["state"] = stated_json(said.state);
    object["control_compensation"] = stated_json(said.control_compensation);
    object["feed"] = stated_json(said.feed);
    object["dwell"] = stated_json(said.dwell);
    object["warm_up"] = stated_json(said.warm_up);
    object["offsets"] = stated_json(said.offsets);
    object["idle_axes"] = stated_json(said.idle_axes);
    object["sensor_note"] = stated_json(said.sensor_note);
    return object;
}

Json instruments_json(const std::vector<InstrumentRecord>& instruments, const std::string& date) {
    Json list = Json::array();
    for (const InstrumentRecord& instrument : instruments) {
        Json object;
        object["name"] = instrument.name;
        object["driver"] = stated_json(instrument.driver);
        object["maker"] = stated_json(instrument.maker);
        object["model"] = stated_json(instrument.model);
        object["serial"] = stated_json(instrument.serial);
        object["firmware"] = stated_json(instrument.firmware);
        object["certificate_number"] = stated_json(instrument.certificate_number);
        object["calibrated_on"] = stated_json(instrument.calibrated_on);
        object["due_on"] = stated_json(instrument.due_on);
        object["expired"] = has_expired(instrument.due_on, date);
        list.push_back(std::move(object));
    }
    return list;
}

Json calibrations_json(const std::vector<ChannelCalibration>& calibrations,
                       const std::vector<ChannelRecord>& channels,
                       const std::string& date) {
    Json list = Json::array();
    for (const ChannelCalibration& calibration : calibrations) {
        const auto channel = std::ranges::find(channels, calibration.channel, &ChannelRecord::id);
        Json object;
        object["channel"] = channel == channels.end() ? Json{} : Json(channel->name);
        object["certificate_number"] = stated_json(calibration.certificate_number);
        object["calibrated_on"] = stated_json(calibration.calibrated_on);
        object["due_on"] = stated_json(calibration.due_on);
        object["expired"] = has_expired(calibration.due_on, date);
        object["expanded_uncertainty"] = stated_json(calibration.expanded_uncertainty);
        object["expanded_uncertainty_per_m"] = stated_json(calibration.expanded_uncertainty_per_m);
        object["k"] = calibration.coverage;
        object["corrections"] = Json::array();
        for (const auto& [reading, correction] : calibration.corrections)
            object["corrections"].push_back({{"reading", reading}, {"correction", correction}});
        list.push_back(std::move(object));
    }
    return list;
}

Json preflight_json(const std::vector<PreflightRecord>& checks) {
    auto list = nlohmann::ordered_json::array();
    for (const PreflightRecord& check : checks)
        list.push_back({{"name", check.name},
                        {"passed", check.passed},
                        {"warning", check.warning},
                        {"verdict", check.verdict},
                        {"override", stated_json(check.override_reason)}});
    return list;
}

Json orders_json(const std::vector<OrderRecord>& orders, const ClockTie& opened) {
    Json list = Json::array();
    for (const OrderRecord& order : orders)
        list.push_back(
            {{"order", order.kind},
             {"about", stated_json(order.about)},
             {"time", iso8601_utc(order.utc_ns ? order.utc_ns : opened.utc_ns_at(order.at))},
             {"door", stated_json(order.by.door)},
             {"uid", stated_json(order.by.uid)},
             {"user", stated_json(order.by.user)},
             {"by", stated_json(order.by.name)}});
    return list;
}

Json events_json(const std::vector<EventRecord>& events, const ClockTie& opened) {
    Json list = Json::array();
    for (const EventRecord& event : events) {
        Json object;
        object["kind"] = name_of(event.kind);
        object["time"] = iso8601_utc(event.utc_ns ? event.utc_ns : opened.utc_ns_at(event.at));
        object["text"] = stated_json(event.text);
        if (event.fault != Fault::none) object["fault"] = fault_name(event.fault);
        list.push_back(std::move(object));
    }
    return list;
}

} // namespace axiscal
