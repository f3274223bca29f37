#include "acquisition/console/alignment_json.hpp"

#include "acquisition/console/optional_json.hpp"
#include "analysis/compensation/cosine_error.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::optional<CosineError>& found) {
    if (!found) return nullptr;
    return {{"distance_mm", found->distance.in(mm)},
            {"error_um", found->error.in(um)},
            {"bound_um", found->bound ? Json(found->bound->in(um)) : Json(nullptr)},
            {"angle_mrad", found->angle.in(radian)*1e3}};
}

Json to_json(const std::optional<FarRest>& far) {
    if (!far) return nullptr;
    return {{"distance_mm", far->distance.in(mm)},
            {"highest_mm", far->highest.in(mm)},
            {"last_mm", far->last.in(mm)},
            {"scatter_um", far->scatter.in(um)},
            {"blocks", far->blocks},
            {"passed_maximum", far->passed_maximum}};
}

Json places_of(const AlignmentRecord& record) {
    Json places = Json::array();
    for (const AlignmentPlace& place : record.places)
        places.push_back({{"from_mm", place.begin.in(mm)},
                          {"to_mm", place.end.in(mm)},
                          {"readings", place.readings},
                          {"weakest_percent", place.weakest_percent},
                          {"mean_percent", place.mean_percent},
                          {"last_percent", place.last_percent}});
    return places;
}

Json to_json(const std::optional<AlignmentRecord>& record) {
    if (!record) return nullptr;
    return {
        {"began", iso8601_utc(record->began_utc_ns)},
        {"ended", iso8601_utc(record->ended_utc_ns)},
        {"instrument", record->instrument},
        {"serial", record->serial},
        {"travel_mm", record->travel.in(mm)},
        {"reached_mm", record->reached.in(mm)},
        {"readings", record->readings},
        {"lost", record->lost},
        {"restarts", record->restarts},
        {"far", to_json(record->far)},
        {"cosine", to_json(cosine_error_by_reading(*record))},
        {"spot_offset_mm", record->spot_offset ? Json(record->spot_offset->in(mm)) : Json(nullptr)},
        {"cosine_by_spot", to_json(cosine_error_by_spot(*record))},
        {"places", places_of(*record)}};
}

Result<void> read_field(const std::string& key, const Json& value, AlignmentOrder& order) {
    constexpr double largest_mm = 100;
    if (key == "action") {
        if (value == "begin")
            order.action = AlignmentAction::begin;
        else if (value == "keep")
            order.action = AlignmentAction::keep;
        else if (value == "drop")
            order.action = AlignmentAction::drop;
        else
            return refuse(Fault::bad_request, key, "must be begin, keep or drop");
        return {};
    }
    if (key != "spot_offset_mm")
        return refuse(Fault::bad_request, key, "is unknown; known are action, spot_offset_mm");
    if (!value.is_number() || !(std::fabs(value.get<double>()) <= largest_mm))
        return refuse(Fault::bad_request, key, "must be a number of millimetres, at most 100");
    order.spot_offset_mm = value.get<double>();
    return {};
}

} // namespace

nlohmann::ordered_json to_json(const AlignmentView& view) {
    return {{"running", view.running},
            {"distance_mm", or_null(view.distance_mm)},
            {"strength_percent", or_null(view.strength_percent)},
            {"at_rest", view.at_rest},
            {"record", to_json(view.record)}};
}

Result<AlignmentOrder> alignment_order_from_json(const std::string& body) {
    const Json parsed = Json::parse(body, nullptr, false);
    if (!parsed.is_object()) return refuse(Fault::bad_request, "body", "must be a JSON object");
    if (!parsed.contains("action"))
        return refuse(Fault::bad_request, "action", "is missing: begin, keep or drop");
    AlignmentOrder order;
    for (const auto& [key, value] : parsed.items())
        AXISCAL_CHECK(read_field(key, value, order));
    if (order.spot_offset_mm && order.action != AlignmentAction::keep)
        return refuse(Fault::bad_request, "spot_offset_mm", "belongs to action keep");
    return order;
}

} // namespace axiscal
