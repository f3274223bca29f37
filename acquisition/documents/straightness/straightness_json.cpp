#include "acquisition/documents/straightness/straightness_json.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/record_json.hpp"
#include "acquisition/documents/straightness/across_json.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json straightness_rows_json(const StraightnessResult& result) {
    Json list = Json::array();
    const Straightness& against = result.mean().found.against;
    for (std::size_t i = 0; i < result.figures.rows.size(); ++i) {
        const StraightnessRow& row = result.figures.rows[i];
        Json object;
        object["target_mm"] = row.target_mm;
        object["mean_forward"] = row.mean_forward_um;
        object["mean_backward"] = stated_json(row.mean_backward_um);
        object["mean"] = stated_json(row.mean_um);
        object["B"] = stated_json(row.reversal_um);
        object["s_forward"] = stated_json(row.s_forward_um);
        object["s_backward"] = stated_json(row.s_backward_um);
        for (const LineReference reference : line_references)
            object["residual_" + std::string{name_of(reference)}] =
                line_against(against, reference).residuals[i];
        list.push_back(std::move(object));
    }
    return list;
}

/// Each parameter that has a U gains it. An object of its own beside the figures that are stored.
void add_expanded(Json& parameters, const StraightnessResult& result) {
    for (const NamedStraightness& figure : figures_of(result))
        if (figure.expanded_um)
            parameters[figure.key]["expanded_uncertainty"] = {{"value", *figure.expanded_um},
                                                              {"k", result.mean().budget.coverage}};
}

Json reference_lines_json(const StraightnessResult& result) {
    constexpr double um_per_m = 1e6;
    Json list = Json::array();
    for (const BudgetedLine& line : result.lines)
        for (const LineReference reference : line_references) {
            const ReferenceLine& found = line_against(line.found.against, reference);
            list.push_back({{"line", line.name},
                            {"reference", name_of(reference)},
                            {"straightness", line.found.straightness_um(reference)},
                            {"slope_um_per_m", found.slope * um_per_m},
                            {"offset", found.offset}});
        }
    return list;
}

Json terms_json(const StraightnessUncertainty& against) {
    Json object;
    object["reference"] = name_of(against.reference);
    object["straightness"] = against.straightness_um;
    object["u"] = stated_json(against.u_um);
    object["expanded"] = stated_json(against.expanded_um);
    object["contributions"] = Json::array();
    for (const StraightnessContribution& part : against.contributions)
        object["contributions"].push_back({{"term", name_of(part.term)},
                                           {"u", part.u_um},
                                           {"formula", part.formula},
                                           {"status", "R"}});
    return object;
}

Json budgets_json(const StraightnessResult& result) {
    Json list = Json::array();
    for (const BudgetedLine& line : result.lines) {
        Json object;
        object["line"] = line.name;
        object["coverage"] = line.budget.coverage;
        object["environment_by"] = line.budget.by_scatter ? "scatter" : "E_VE";
        object["references"] = Json::array();
        for (const StraightnessUncertainty& against : line.budget.by_reference)
            object["references"].push_back(terms_json(against));
        list.push_back(std::move(object));
    }
    return list;
}

/// Null without: the budget lacks a term.
Json trials_json(const StraightnessResult& result) {
    if (!result.tried) return {};
    const auto& tried = result.tried->by_reference[static_cast<std::size_t>(main_reference)];
    return {{"reference", name_of(main_reference)},
            {"trials", result.tried->trials},
            {"seed", result.tried->seed},
            {"mean", tried.mean_um},
            {"u", tried.u_um},
            {"u_closed_form", stated_json(independent_u_um(result))}};
}

/// What was measured, against what, and what was done to the readings.
void add_subject(Json& object, const StraightnessResult& result) {
    const bool wollaston = result.setup().method == StraightnessMethod::wollaston;
    object["standard"] = "ISO 230-1:2012";
    object["symbol"] = straightness_symbol_of(result);
    object["of"] = wollaston ? "motion of the axis" : "line on which the foot stood";
    object["axis"] = stated_json(result.run.statements.axis);
    object["direction"] = result.setup().across;
    object["reference"] = name_of(main_reference);
    object["positions_by"] = "control of the machine";
    object["compensation"]["air"] = wollaston ? "n = 1.000271" : "none";
    object["compensation"]["expansion"] = "none";
}

void add_uncertainty_of_lines(Json& object, const StraightnessResult& result) {
    add_expanded(object["parameters"], result);
    object["lines"] = reference_lines_json(result);
    object["slopes_are"] = "of this set-up, no property of the axis";
    object["budget"] = budgets_json(result);
    object["monte_carlo"] = trials_json(result);
    add_missing(object, result.mean().budget.not_stated);
}

/// What the run with the mirror in the other position gave. Null without one.
Json reversal_json(const std::optional<RecordedLine>& reversal) {
    if (!reversal) return {};
    Json object;
    object["run"] = reversal->run_id;
    object["readings"] = reversal->readings;
    object["scatter_um"] = reversal->scatter.in(um);
    object["positions"] = Json::array();
    for (const RecordedLineRow& row : reversal->rows)
        object["positions"].push_back(
            {{"target_mm", row.target.in(mm)},
             {"mean_forward", row.forward.in(um)},
             {"mean_backward", row.backward ? Json(row.backward->in(um)) : Json{}}});
    return object;
}

} // namespace

Json straightness_figures_json(const StraightnessResult& result) {
    Json object;
    object["format"] = "axiscal.straightness/1";
    object["unit"] = "um";
    object["parameters"] = Json::object();
    for (const NamedStraightness& figure : figures_of(result))
        object["parameters"][figure.key]["value"] = figure.value_um;
    object["positions"] = straightness_rows_json(result);
    if (result.mirror)
        for (const LineReference reference : line_references)
            object["mirror"][name_of(reference)] = result.mirror->straightness_um(reference);
    return object;
}

Json straightness_to_json(const StraightnessResult& result) {
    Json object = straightness_figures_json(result);
    add_subject(object, result);
    add_conformity(object, result.conformity);
    add_uncertainty_of_lines(object, result);
    add_across_run(object, result);
    object["run"]["reversal"] = reversal_json(result.setup().reversal);
    return object;
}

} // namespace axiscal
