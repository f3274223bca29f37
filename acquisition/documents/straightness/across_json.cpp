#include "acquisition/documents/straightness/across_json.hpp"

#include "acquisition/documents/alignment_json.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/record_json.hpp"
#include "acquisition/documents/straightness/across_remarks.hpp"
#include "analysis/record/certificate_expiry.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

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

Json across_plan_json(const RunPlan& plan) {
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

Json across_datums_json(const RunRecord& run) {
    Json list = Json::array();
    for (const DatumRecord& datum : run.datums)
        list.push_back({{"id", datum.id},
                        {"coordinate_mm", datum.coordinate.in(mm)},
                        {"reading_mm", datum.reading.in(mm)},
                        {"spread_um", datum.spread.in(um)},
                        {"readings", datum.n}});
    return list;
}

Json across_run_json(const AcrossRun& one) {
    const RunRecord& run = one.run;
    Json object = test_run_json(run, one.run_file_sha256, one.result_digest);
    object["next_calibration_due"] =
        one.completeness.partial() ? Json{}
                                   : stated_json(next_due_of(run.statements, run.closed.utc_ns));
    object["statements"] = statements_json(run.statements);
    object["plan"] = across_plan_json(run.plan);
    object["optics"] = optics_json(one.optics());
    object["laser"] = stated_json(run.laser.instrument);
    object["instruments"] = instruments_json(run.instruments, run_date_of(run));
    object["calibrations"] = calibrations_json(run.calibrations, run.channels, run_date_of(run));
    object["alignment"] = alignment_to_json(one.attachments.alignment);
    object["datums"] = across_datums_json(run);
    object["deviations"]["sign"] = "positive towards + of " + one.optics().across;
    object["deviations"]["targets_mm"] = one.readings.targets_mm;
    object["deviations"]["forward"] = one.readings.forward_um;
    if (!one.readings.backward_um.empty())
        object["deviations"]["backward"] = one.readings.backward_um;
    object["preflight"] = preflight_json(one.revisions.preflight);
    object["orders"] = orders_json(one.revisions.orders, run.opened);
    object["events"] = events_json(run.events, run.opened);
    object["remarks"] = one.remarks;
    return object;
}

} // namespace

void add_across_run(Json& document, const AcrossRun& one) {
    document["completeness"] = {{"status", one.completeness.partial() ? "partial" : "complete"},
                                {"expected", one.completeness.expected},
                                {"used", one.completeness.used}};
    document["certificate"] = {{"number", stated_json(one.run.statements.certificate_number)},
                               {"replaces", stated_json(one.replaces)}};
    document["run"] = across_run_json(one);
}

void add_missing(Json& document, const std::vector<std::string>& not_stated) {
    document["preliminary"] = !not_stated.empty();
    document["missing"] = terms_in_words(not_stated);
}

} // namespace axiscal
