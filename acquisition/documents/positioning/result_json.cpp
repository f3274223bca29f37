#include "acquisition/documents/positioning/result_json.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json parameters_of(const PositioningParameters& p) {
    const std::vector<std::pair<const char*, std::optional<double>>> figures{
        {"A", p.A},
        {"A_forward", p.A_forward},
        {"A_backward", p.A_backward},
        {"E", p.E},
        {"E_forward", p.E_forward},
        {"E_backward", p.E_backward},
        {"M", p.M},
        {"R", p.R},
        {"R_forward", p.R_forward},
        {"R_backward", p.R_backward},
        {"B", p.B},
        {"B_mean", p.B_mean}};
    Json object = Json::object();
    for (const auto& [key, figure] : figures)
        if (figure) object[key]["value"] = *figure;
    return object;
}

Json position_of(const PositionRow& row) {
    const std::vector<std::pair<const char*, std::optional<double>>> figures{
        {"target", row.target},
        {"mean_forward", row.mean_forward},
        {"mean_backward", row.mean_backward},
        {"mean", row.mean},
        {"B", row.reversal},
        {"s_forward", row.s_forward},
        {"s_backward", row.s_backward},
        {"R_forward", row.repeatability_forward},
        {"R_backward", row.repeatability_backward},
        {"R", row.repeatability}};
    Json object = Json::object();
    for (const auto& [key, figure] : figures)
        if (figure) object[key] = *figure;
    return object;
}

} // namespace

Json result_to_json(const PositioningResult& result) {
    Json document;
    document["format"] = "axiscal.result/1";
    document["standard"] = result.standard;
    document["unit"] = result.unit;
    document["compensation"] = result.provenance.substr(0, result.provenance.find(':'));
    document["parameters"] = parameters_of(result.parameters);
    document["positions"] = Json::array();
    for (const PositionRow& row : result.positions)
        document["positions"].push_back(position_of(row));
    if (!result.not_evaluated.empty()) document["not_evaluated"] = result.not_evaluated;
    return document;
}

} // namespace axiscal
