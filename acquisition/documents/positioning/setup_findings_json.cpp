#include "acquisition/documents/positioning/setup_findings_json.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

const char* unit_of(SetupError error) {
    switch (error) {
    case SetupError::moved_optic: return "um";
    case SetupError::dead_path: return "m";
    case SetupError::expansion: return "um/(m*K)";
    case SetupError::growth: return "um/(m*h)";
    case SetupError::frozen_air: return "min";
    case SetupError::sensor_in_air: return "1";
    }
    return "";
}

Json json_of(const SetupFinding& found) {
    const bool by_sensor = !found.sensor.empty();
    Json object;
    object["error"] = name_of(found.error);
    object["sensor"] = by_sensor ? Json(found.sensor) : Json{};
    object["value"] = found.value;
    object["unit"] = unit_of(found.error);
    object["standard_uncertainty"] = by_sensor ? Json{} : Json(found.standard_uncertainty);
    object["range_um"] = by_sensor ? Json{} : Json(found.range_um);
    object["seen"] = found.seen;
    object["probably"] = found.probably;
    object["look_at"] = found.look_at;
    object["answer"] = Json{};
    if (!found.answer.empty())
        object["answer"] = {{"text", found.answer}, {"by", found.answered_by}};
    return object;
}

} // namespace

Json setup_findings_json(std::span<const SetupFinding> findings) {
    Json list = Json::array();
    for (const SetupFinding& found : findings)
        list.push_back(json_of(found));
    return list;
}

} // namespace axiscal
