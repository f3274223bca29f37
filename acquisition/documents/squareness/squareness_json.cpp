#include "acquisition/documents/squareness/squareness_json.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/record_json.hpp"
#include "acquisition/documents/straightness/across_json.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json squareness_rows_json(const SquarenessResult& result) {
    Json list = Json::array();
    const Straightness& against = result.figures.mean.against;
    for (std::size_t i = 0; i < result.figures.rows.size(); ++i) {
        const StraightnessRow& row = result.figures.rows[i];
        Json object;
        object["target_mm"] = row.target_mm;
        object["mean_forward_um"] = row.mean_forward_um;
        object["mean_backward_um"] = stated_json(row.mean_backward_um);
        object["mean_um"] = stated_json(row.mean_um);
        object["s_forward_um"] = stated_json(row.s_forward_um);
        object["s_backward_um"] = stated_json(row.s_backward_um);
        object["residual_um"] = line_against(against, main_reference).residuals[i];
        list.push_back(std::move(object));
    }
    return list;
}

/// An object of its own beside the figures that are stored.
void add_expanded_squareness(Json& parameters, const SquarenessResult& result) {
    for (const NamedSquareness& figure : figures_of(result))
        if (figure.expanded_um_per_m)
            parameters[figure.key]["expanded_uncertainty"] = {
                {"value", *figure.expanded_um_per_m},
                {"arcsec", arcsec_of_um_per_m(*figure.expanded_um_per_m)},
                {"k", result.budget.coverage}};
}

Json angle_json(double rad) {
    const double um_per_m = rad * um_per_m_of_rad;
    return {{"value", um_per_m}, {"arcsec", arcsec_of_um_per_m(um_per_m)}};
}

Json angle_json(const std::optional<Angle>& angle) {
    return angle ? angle_json(angle->in(radian)) : Json{};
}

Json square_json(const SquarenessResult& result) {
    const SquarenessSetup& setup = result.setup();
    const SquareStatement& said = setup.stated;
    Json object;
    object["position"] = name_of(setup.square);
    object["error_by"] = square_error_by(result);
    object["error_taken_out"] = square_error_by(result) == "not taken out"
                                    ? Json{}
                                    : angle_json(result.found.square_error_rad);
    object["error_is"] = "angle of the square minus 90 degrees, as it counts in position normal";
    object["stated"] = {{"error", angle_json(said.error)},
                        {"error_U", angle_json(said.error_U)},
                        {"error_k", said.error_k},
                        {"error_limit", angle_json(said.error_limit)},
                        {"mount_limit", angle_json(said.mount_limit)}};
    return object;
}

Json means_json(const SquareLine& line) {
    Json list = Json::array();
    for (const RecordedLineRow& row : line.recorded.rows)
        list.push_back({{"target_mm", row.target.in(mm)},
                        {"mean_forward_um", row.forward.in(um)},
                        {"mean_backward_um", row.backward ? Json(row.backward->in(um)) : Json{}}});
    return list;
}

Json references_json(const SquareLine& line) {
    Json list = Json::array();
    for (const LineReference reference : line_references)
        list.push_back({{"reference", name_of(reference)},
                        {"slope_um_per_m",
                         line_against(line.found.against, reference).slope * um_per_m_of_rad},
                        {"straightness_um", line.found.straightness_um(reference)}});
    return list;
}

Json square_lines_json(const SquarenessResult& result) {
    Json list = Json::array();
    for (const SquareLine& line : result.lines) {
        Json object;
        object["square"] = name_of(line.square);
        object["run_id"] = line.recorded.run_id;
        object["axis"] = line.recorded.axis;
        object["across"] = line.recorded.across;
        object["sign"] = "positive towards + of " + line.recorded.across;
        object["readings_a_mean_of_one_direction"] = line.recorded.readings;
        object["scatter_um"] = line.recorded.scatter.in(um);
        object["references"] = references_json(line);
        object["means"] = means_json(line);
        list.push_back(std::move(object));
    }
    return list;
}

/// What both lines of each position seem to say, the error of the square still in it.
Json apparent_json(const SquarenessResult& result) {
    Json list = Json::array();
    const auto add = [&](SquarePosition square, const Squareness& apparent) {
        Json object;
        object["square"] = name_of(square);
        for (const LineReference reference : line_references)
            object[std::string{name_of(reference)}] =
                squareness_against(apparent, reference) * um_per_m_of_rad;
        list.push_back(std::move(object));
    };
    add(result.lines.front().square, result.found.lines.apparent);
    if (result.found.other) add(result.lines.back().square, result.found.other->apparent);
    return list;
}

Json squareness_budget_json(const SquarenessBudget& budget) {
    const auto um_per_m = [](const std::optional<double>& rad) {
        return rad ? Json(*rad * um_per_m_of_rad) : Json{};
    };
    Json object;
    object["reference"] = name_of(main_reference);
    object["coverage"] = budget.coverage;
    object["u"] = um_per_m(budget.u_rad);
    object["expanded"] = um_per_m(budget.expanded_rad);
    object["environment_by"] = budget.by_scatter ? "scatter" : "E_VE";
    object["contributions"] = Json::array();
    for (const SquarenessContribution& part : budget.contributions)
        object["contributions"].push_back({{"term", name_of(part.term)},
                                           {"u", part.u_rad * um_per_m_of_rad},
                                           {"formula", part.formula},
                                           {"status", "R"}});
    return object;
}

/// Which axes, which sign, against what, and what was done to the readings.
void add_axes(Json& object, const SquarenessResult& result) {
    object["standard"] = "ISO 230-1:2012";
    object["title"] = squareness_title(result);
    object["axis"] = result.second_axis();
    object["to"] = result.first_axis();
    object["sign"] = sign_of_squareness(result);
    object["reference"] = name_of(main_reference);
    object["positions_by"] = "control of the machine";
    object["compensation"]["air"] = "n = 1.000271";
    object["compensation"]["expansion"] = "none";
}

void add_square(Json& object, const SquarenessResult& result) {
    add_expanded_squareness(object["parameters"], result);
    object["method_spread"] = angle_json(result.found.squareness.method_spread);
    object["square"] = square_json(result);
    object["apparent"] = apparent_json(result);
    object["lines"] = square_lines_json(result);
    object["slopes_are"] = "of this set-up, no property of an axis";
    object["budget"] = squareness_budget_json(result.budget);
    add_missing(object, result.budget.not_stated);
}

} // namespace

Json squareness_figures_json(const SquarenessResult& result) {
    Json object;
    object["format"] = "axiscal.squareness/1";
    object["unit"] = "um/m";
    object["parameters"] = Json::object();
    for (const NamedSquareness& figure : figures_of(result))
        object["parameters"][figure.key] = {{"value", figure.value_um_per_m},
                                            {"arcsec", arcsec_of_um_per_m(figure.value_um_per_m)}};
    object["positions"] = squareness_rows_json(result);
    return object;
}

Json squareness_to_json(const SquarenessResult& result) {
    Json object = squareness_figures_json(result);
    add_axes(object, result);
    add_conformity(object, result.conformity);
    add_square(object, result);
    add_across_run(object, result);
    return object;
}

} // namespace axiscal
