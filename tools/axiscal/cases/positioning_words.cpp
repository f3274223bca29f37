#include "tools/axiscal/cases/positioning_words.hpp"

#include "analysis/positioning/slope.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json edition_of(const PositioningStandard& standard) {
    Json edition;
    if (standard.is_iso()) edition["same_as"] = standard.same_as;
    if (standard.cover_factor > 0) edition["cover_factor"] = standard.cover_factor;
    edition["confidence"] = standard.confidence;
    return edition;
}

Json labels_of(const PositioningInput& input, const Json& parameters) {
    Json labels = Json::object();
    for (const auto& [key, figure] : parameters.items()) {
        const auto label = figure_label(key, input.standard->same_as, input.axis.name);
        labels[key]["symbol"] = label.symbol;
        if (!label.axis_symbol.empty()) labels[key]["axis_symbol"] = label.axis_symbol;
        labels[key]["name"] = label.name;
    }
    return labels;
}

void add_slope(const CaseAxis& axis, const std::vector<PositionRow>& rows, Json& document) {
    const auto slope = slope_of_means(rows);
    if (!slope) return;
    Json& member = document["slope"];
    member["least_squares"] = slope->least_squares;
    member["end_points"] = slope->end_points;
    member["unit"] = axis.unit + " per " + axis.target_unit;
    member["of"] = slope->of_both_directions ? "mean" : "mean_forward";
}

} // namespace

Json style_to_json(const StyleResult& result, const PositioningInput& input) {
    Json document;
    document["format"] = "axiscal.result/1";
    document["standard"] = input.standard->name;
    document["unit"] = input.axis.unit;
    document["compensation"] = "already_at_20C";
    document["parameters"] = Json::object();
    for (const NamedFigure& figure : result.parameters)
        document["parameters"][figure.name]["value"] = figure.value;
    document["positions"] = Json::array();
    for (const NamedFigures& row : result.positions) {
        Json position = Json::object();
        for (const NamedFigure& figure : row)
            position[figure.name] = figure.value;
        document["positions"].push_back(std::move(position));
    }
    if (!result.not_evaluated.empty()) document["not_evaluated"] = result.not_evaluated;
    for (const std::string& note : result.notes)
        document["notes"].push_back(note);
    return document;
}

void add_words(const PositioningInput& input,
               const std::vector<PositionRow>& rows,
               Json& document) {
    document["axis"]["name"] = input.axis.name;
    document["axis"]["kind"] = name_of(input.axis.kind);
    if (input.axis.target_unit != input.axis.unit) document["target_unit"] = input.axis.target_unit;
    document["edition"] = edition_of(*input.standard);
    if (input.standard->is_iso()) document["labels"] = labels_of(input, document["parameters"]);
    add_slope(input.axis, rows, document);
    if (!input.standard->note.empty()) document["notes"].push_back(input.standard->note);
}

} // namespace axiscal
