#include "acquisition/documents/straightness/straightness_json.hpp"

#include "acquisition/documents/alignment_json.hpp"
#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/record_json.hpp"
#include "acquisition/documents/straightness/straightness_remarks.hpp"
#include "analysis/record/certificate_expiry.hpp"

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

Json optics_json(const StraightnessSetup& setup) {
    const StraightnessStatement& said = setup.uncertainty;
    const auto si_of = [](const auto& amount) { return amount ? Json(amount->si()) : Json{}; };
    const auto um_of = [](const std::optional<Length>& length) {
        return length ? Json(length->in(um)) : Json{};
    };
    Json object;
    object["method"] = name_of(setup.method);
    object["across"] = setup.across;
    object["sign"] = setup.sign;
    object["place"] = stated_json(setup.place);
    if (setup.method == StraightnessMethod::wollaston) {
        object["factor"] = setup.factor;
        object["factor_U"] = si_of(said.factor_U);
        object["factor_limit"] = si_of(said.factor_limit);
        object["factor_k"] = said.factor_k;
        object["resolution_um"] = setup.resolution.in(um);
        object["mirror"] = name_of(setup.mirror);
        object["reversal_of"] = stated_json(setup.reversal_of);
        object["mirror_limit_um_per_m2"] = stated_json(said.mirror_limit_um_per_m2);
        object["E_VE_um"] = um_of(said.eve);
        return object;
    }
    object["base_mm"] = setup.base.in(mm);
    object["base_U_um"] = um_of(said.base_U);
    object["base_k"] = said.base_k;
    object["angle_resolution_rad"] = setup.angle_resolution.si();
    object["angle_U_rad"] = si_of(said.angle_U);
    object["angle_k"] = said.angle_k;
    object["E_VE_rad"] = si_of(said.eve_angle);
    return object;
}

Json straightness_plan_json(const RunPlan& plan) {
    Json object;
    object["cycle"] = name_of(plan.cycle);
    object["pass"] = plan.pass;
    object["approaches"] = plan.approaches;
    object["bidirectional"] = plan.bidirectional;
    object["datum_mm"] = plan.datum.in(mm);
    object["targets_mm"] = Json::array();
    for (const Length target : plan.targets)
        object["targets_mm"].push_back(target.in(mm));
    return object;
}

Json straightness_datums_json(const RunRecord& run) {
    Json list = Json::array();
    for (const DatumRecord& datum : run.datums)
        list.push_back({{"id", datum.id},
                        {"coordinate_mm", datum.coordinate.in(mm)},
                        {"reading_mm", datum.reading.in(mm)},
                        {"spread_um", datum.spread.in(um)},
                        {"readings", datum.n}});
    return list;
}

Json run_of(const StraightnessResult& result) {
    const RunRecord& run = result.run;
    Json object = test_run_json(run, result.run_file_sha256, result.result_digest);
    object["next_calibration_due"] =
        result.completeness.partial() ? Json{}
                                      : stated_json(next_due_of(run.statements, run.closed.utc_ns));
    object["statements"] = statements_json(run.statements);
    object["plan"] = straightness_plan_json(run.plan);
    object["optics"] = optics_json(result.setup());
    object["laser"] = stated_json(run.laser.instrument);
    object["instruments"] = instruments_json(run.instruments, run_date_of(run));
    object["calibrations"] = calibrations_json(run.calibrations, run.channels, run_date_of(run));
    object["alignment"] = alignment_to_json(result.attachments.alignment);
    object["datums"] = straightness_datums_json(run);
    object["deviations"]["sign"] = "positive towards + of " + result.setup().across;
    object["deviations"]["targets_mm"] = result.readings.targets_mm;
    object["deviations"]["forward"] = result.readings.forward_um;
    if (!result.readings.backward_um.empty())
        object["deviations"]["backward"] = result.readings.backward_um;
    object["preflight"] = preflight_json(result.revisions.preflight);
    object["orders"] = orders_json(result.revisions.orders, run.opened);
    object["events"] = events_json(run.events, run.opened);
    object["remarks"] = result.remarks;
    return object;
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
    const auto missing = missing_terms_of(result);
    object["preliminary"] = !missing.empty();
    object["missing"] = missing;
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
    return object;
}

Json straightness_to_json(const StraightnessResult& result) {
    Json object = straightness_figures_json(result);
    add_subject(object, result);
    add_conformity(object, result.conformity);
    add_uncertainty_of_lines(object, result);
    object["completeness"] = {{"status", result.completeness.partial() ? "partial" : "complete"},
                              {"expected", result.completeness.expected},
                              {"used", result.completeness.used}};
    object["certificate"] = {{"number", stated_json(result.run.statements.certificate_number)},
                             {"replaces", stated_json(result.replaces)}};
    object["run"] = run_of(result);
    return object;
}

} // namespace axiscal
