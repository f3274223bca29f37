#include "acquisition/documents/alignment_json.hpp"

#include "analysis/compensation/cosine_error.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json cosine_of(const std::optional<CosineError>& found) {
    if (!found) return nullptr;
    Json object;
    object["distance_mm"] = found->distance.in(mm);
    object["error_um"] = found->error.in(um);
    object["bound_um"] = found->bound ? Json(found->bound->in(um)) : Json(nullptr);
    object["angle_mrad"] = found->angle.in(radian)*1e3;
    return object;
}

Json far_of(const std::optional<FarRest>& far) {
    if (!far) return nullptr;
    Json object;
    object["distance_mm"] = far->distance.in(mm);
    object["highest_reading_mm"] = far->highest.in(mm);
    object["last_reading_mm"] = far->last.in(mm);
    object["scatter_um"] = far->scatter.in(um);
    object["passed_maximum"] = far->passed_maximum;
    return object;
}

Json strength_of(const std::vector<AlignmentPlace>& places) {
    Json list = Json::array();
    for (const AlignmentPlace& place : places) {
        Json object;
        object["from_mm"] = place.begin.in(mm);
        object["to_mm"] = place.end.in(mm);
        object["weakest_percent"] = place.weakest_percent;
        object["mean_percent"] = place.mean_percent;
        object["last_percent"] = place.last_percent;
        list.push_back(std::move(object));
    }
    return list;
}

} // namespace

Json alignment_to_json(const std::optional<AlignmentRecord>& alignment) {
    if (!alignment) return nullptr;
    Json object;
    object["began"] = iso8601_utc(alignment->began_utc_ns);
    object["ended"] = iso8601_utc(alignment->ended_utc_ns);
    object["instrument"] = alignment->instrument;
    object["serial"] = alignment->serial;
    object["travel_mm"] = alignment->travel.in(mm);
    object["reached_mm"] = alignment->reached.in(mm);
    object["far_end"] = far_of(alignment->far);
    object["cosine_error"] = cosine_of(cosine_error_by_reading(*alignment));
    object["spot_offset_mm"] =
        alignment->spot_offset ? Json(alignment->spot_offset->in(mm)) : Json(nullptr);
    object["cosine_error_by_spot"] = cosine_of(cosine_error_by_spot(*alignment));
    object["strength"] = strength_of(alignment->places);
    return object;
}

} // namespace axiscal
