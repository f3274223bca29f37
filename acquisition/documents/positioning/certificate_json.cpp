#include "acquisition/documents/positioning/certificate_json.hpp"

#include "acquisition/documents/alignment_json.hpp"
#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/positioning/result_json.hpp"
#include "acquisition/documents/positioning/setup_findings_json.hpp"
#include "acquisition/documents/record_json.hpp"
#include "acquisition/documents/uncertainty_json.hpp"
#include "analysis/record/certificate_expiry.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Json plan_of(const Certificate& certificate) {
    const RunPlan& plan = certificate.run.plan;
    Json object;
    object["axis_kind"] = name_of(plan.axis_kind);
    object["cycle"] = name_of(plan.cycle);
    object["pass"] = plan.pass;
    object["remark"] = stated_json(plan.remark);
    object["targets"] = certificate.planned_targets;
    object["target_rule"] = plan.seed ? "P_i = (i-1) p + r" : "given list";
    object["interval_mm"] = plan.interval.in(mm);
    object["seed"] = stated_json(plan.seed);
    object["approaches"] = plan.approaches;
    object["bidirectional"] = plan.bidirectional;
    const bool imported = certificate.run.imported.has_value(); // nobody stated these
    object["overrun_mm"] = imported ? Json{} : Json(plan.overrun.in(mm));
    object["near_tolerance_mm"] = imported ? Json{} : Json(plan.near_tolerance.in(mm));
    object["datum_mm"] = imported ? Json{} : Json(plan.datum.in(mm));
    if (imported) object["cycle"] = nullptr;
    return object;
}

Json device_of(const DeviceLimit& limit) {
    if (!limit.stated()) return {};
    Json object;
    if (limit.fixed) object["um"] = limit.fixed->in(um);
    if (limit.per_length) object["um_per_m"] = limit.per_length->in(ppm);
    return object;
}

template <class Amount, class Unit> Json stated(const std::optional<Amount>& amount, Unit unit) {
    return amount ? Json(amount->in(unit)) : Json{};
}

/// As the station file states it; null without a statement.
Json statement_of(const std::optional<UncertaintySetup>& setup) {
    if (!setup) return {};
    Json object;
    object["device"] = device_of(setup->device_U);
    object["device_k"] = setup->device_k;
    object["device_width"] = device_of(setup->device_width);
    object["misalignment_mm"] = stated(setup->misalignment, mm);
    object["misalignment_rad"] = stated(setup->misalignment_angle, radian);
    object["temperature_width_K"] = stated(setup->temperature_width, kelvin);
    object["expansion_width_um_per_m_K"] = stated(setup->expansion_width, um_per_m_kelvin);
    object["eve_um"] = stated(setup->eve, um);
    object["eve_model"] = name_of(setup->eve_model);
    object["target_um"] = Json::object();
    for (const auto& [parameter, limit] : setup->targets)
        object["target_um"][parameter] = limit.in(um);
    return object;
}

/// The same of a rotary axis: lengths stand for degrees.
Json statement_of_angle(const std::optional<UncertaintySetup>& setup) {
    if (!setup) return {};
    const auto in_arcsec = [](const std::optional<Length>& angle) {
        return angle ? Json(arcsec_of(*angle)) : Json{};
    };
    Json object;
    object["device_arcsec"] = in_arcsec(setup->device_U.fixed);
    object["device_k"] = setup->device_k;
    object["device_width_arcsec"] = in_arcsec(setup->device_width.fixed);
    object["eve_arcsec"] = in_arcsec(setup->eve);
    object["eve_model"] = name_of(setup->eve_model);
    object["target_arcsec"] = Json::object();
    for (const auto& [parameter, limit] : setup->targets)
        object["target_arcsec"][parameter] = arcsec_of(limit);
    return object;
}

Json beam_of(const RunRecord& run) {
    Json object;
    object["laser"]["instrument"] = stated_json(run.laser.instrument);
    object["laser"]["vacuum_wavelength_nm"] = run.laser.vacuum_wavelength.in(nm);
    object["laser"]["optical_fold"] = run.laser.optical_fold;
    object["laser"]["sign"] = run.laser.sign;
    object["laser"]["dead_path_mm"] = run.laser.dead_path.in(mm);
    object["laser"]["beam_walk_mm"] = run.laser.beam_walk.in(mm);
    object["laser"]["beam_walk_travel_mm"] = run.laser.beam_walk_travel.in(mm);
    object["air"]["formula"] = name_of(run.air.formula);
    object["air"]["co2_ppm"] = run.air.co2_ppm;
    object["air"]["oldest_s"] = seconds_of(run.air.oldest);
    return object;
}

/// In the place of laser and air, of which there is then nothing to tell.
Json scale_of(const RunRecord& run) {
    const ScaleSetup& scale = *run.scale;
    Json object;
    object["scale"]["instrument"] = stated_json(run.laser.instrument);
    object["scale"]["sign"] = run.laser.sign;
    object["scale"]["resolution_um"] = scale.resolution.in(um);
    object["scale"]["expansion_per_K"] = scale.coefficient.si();
    object["scale"]["standard_uncertainty_per_K"] =
        scale.standard_uncertainty ? Json(scale.standard_uncertainty->si()) : Json{};
    object["scale"]["temperature_width_K"] = stated(scale.temperature_width, kelvin);
    object["scale"]["temperatures"] = Json::array();
    for (const ChannelRecord& channel : run.channels)
        if (sits_on_scale(run, channel.id)) object["scale"]["temperatures"].push_back(channel.name);
    object["scale"]["oldest_s"] = seconds_of(run.air.oldest);
    return object;
}

Json imported_json(const ImportedReadings& imported) {
    return {{"file", imported.file},
            {"form", imported.form},
            {"sha256", imported.sha256},
            {"measured", stated_json(imported.measured)},
            {"remark", stated_json(imported.remark)}};
}

Json setup_of(const RunRecord& run) {
    if (run.imported) return {{"imported", imported_json(*run.imported)}};
    Json object = run.scale ? scale_of(run) : beam_of(run);
    object["material"]["expansion_per_K"] = run.material.coefficient.si();
    object["material"]["standard_uncertainty_per_K"] =
        run.material.standard_uncertainty ? Json(run.material.standard_uncertainty->si()) : Json{};
    object["material"]["feedback"] = stated_json(run.material.feedback);
    object["material"]["form"] = name_of(run.material.form);
    object["uncertainty"] =
        run.rotary ? statement_of_angle(run.uncertainty) : statement_of(run.uncertainty);
    return object;
}

/// Null of a linear axis.
Json rotary_of(const std::optional<RotarySetup>& rotary) {
    if (!rotary) return {};
    Json object;
    object["method"] = name_of(rotary->method);
    object["step_deg"] = rotary->step_deg;
    object["arm_mm"] = rotary->arm > Length{} ? Json(rotary->arm.in(mm)) : Json{};
    object["range_deg"] = rotary->range_deg;
    object["turn_time_s"] = seconds_of(rotary->turn_time);
    object["turned_by_hand"] = rotary->by_hand;
    object["deviations_arcsec"] = rotary->deviations_arcsec;
    object["certificate_sense"] = rotary->certificate_with_axis ? "with_axis" : "against_axis";
    object["run_out"] = stated_json(rotary->run_out);
    return object;
}

Json datums_of(const RunRecord& run) {
    Json list = Json::array();
    if (run.imported) return list; // its datum is none
    for (const DatumRecord& datum : run.datums) {
        Json object;
        object["id"] = datum.id;
        object["coordinate_mm"] = datum.coordinate.in(mm);
        object["reading_mm"] = datum.reading.in(mm);
        object["spread_um"] = datum.spread.in(um);
        object["slope_um_per_s"] = datum.slope_um_per_s;
        object["readings"] = datum.n;
        list.push_back(std::move(object));
    }
    return list;
}

Json retakes_of(const RunRecord& run, const RunRevisions& revisions) {
    Json list = Json::array();
    for (const RetakeRecord& retake : revisions.retakes)
        list.push_back(
            {{"number", retake.number},
             {"time", iso8601_utc(retake.utc_ns ? retake.utc_ns : run.opened.utc_ns_at(retake.at))},
             {"reason", retake.reason},
             {"points", retake.points.size()}});
    return list;
}

/// Readings that no figure uses, in the result's unit.
Json set_aside_of(const Certificate& certificate) {
    Json list = Json::array();
    for (const SetAside& reading : certificate.set_aside)
        list.push_back({{"target", reading.planned.target_index},
                        {"direction", name_of(reading.planned.direction)},
                        {"approach", reading.planned.approach},
                        {"step", reading.step},
                        {"deviation", reading.deviation},
                        {"why", reading.superseded ? "superseded" : "excluded"},
                        {"reason", reading.reason}});
    return list;
}

/// Null where nothing is stated: the clock of the instrument tells no u(t).
Json synchronisation_json(const Certificate& certificate) {
    const auto& records = certificate.attachments.synchronisation;
    const SynchronisationSummary over = summarize_synchronisation(certificate.run, records);
    if (!over.largest) return {};
    const SynchronisationUnit unit = synchronisation_unit_of(certificate.run);
    const std::string error = "error_" + std::string{unit.name};
    Json object;
    object["rule"] = "|slope of the window| * u(t) of its samples";
    object["captures"] = over.captures;
    object["stated"] = over.stated;
    object["largest_" + std::string{unit.name}] = over.largest->stated->error_um * unit.per_um;
    object["largest_step"] = over.largest->step;
    object["readings"] = Json::array();
    for (const auto& [step, datum_id, stated] : records)
        object["readings"].push_back(
            {{"step", step},
             {"datum", datum_id},
             {"u_t_us", stated ? Json(seconds_of(stated->time_uncertainty) * 1e6) : Json{}},
             {error, stated ? Json(stated->error_um * unit.per_um) : Json{}}});
    return object;
}

Json run_of(const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    Json object;
    object["id"] = stated_json(run.run_id);
    object["station"] = stated_json(run.station);
    object["started"] = run.imported ? Json{} : stated_json(certificate.started_utc);
    object["finished"] = run.imported ? Json{} : stated_json(certificate.finished_utc);
    object["issued_on"] = stated_json(certificate.issued_on);
    object["next_calibration_due"] = stated_json(certificate.next_due);
    object["software_version"] = stated_json(run.software_version);
    object["run_file_sha256"] = stated_json(certificate.run_file_sha256);
    object["config_sha256"] = stated_json(run.config_hash);
    object["result_digest"] = stated_json(certificate.result_digest);
    object["statements"] = statements_json(certificate.run.statements);
    object["plan"] = plan_of(certificate);
    object.update(setup_of(run));
    object["rotary"] = rotary_of(run.rotary);
    object["instruments"] = instruments_json(run.instruments, run_date_of(run));
    object["calibrations"] = calibrations_json(run.calibrations, run.channels, run_date_of(run));
    object["alignment"] = alignment_to_json(certificate.attachments.alignment);
    object["datums"] = datums_of(run);
    object["synchronisation"] = synchronisation_json(certificate);
    object["deviations"]["sign"] = "actual minus target";
    if (certificate.completeness.partial()) // else those of the plan
        object["deviations"]["targets"] = certificate.deviations.targets();
    object["deviations"]["forward"] = certificate.deviations.forward();
    if (!certificate.deviations.backward().empty())
        object["deviations"]["backward"] = certificate.deviations.backward();
    object["preflight"] = preflight_json(certificate.revisions.preflight);
    object["retakes"] = retakes_of(run, certificate.revisions);
    object["orders"] = orders_json(certificate.revisions.orders, run.opened);
    object["set_aside"] = set_aside_of(certificate);
    object["events"] = events_json(run.events, run.opened);
    object["remarks"] = certificate.remarks;
    return object;
}

Json environment_of(const Certificate& certificate) {
    Json list = Json::array();
    for (const EnvironmentSummary& summary : certificate.environment) {
        Json object;
        object["channel"] = summary.channel;
        object["place"] = stated_json(summary.place);
        object["quantity"] = name_of(summary.kind);
        object["medium"] = name_of(summary.medium);
        object["unit"] = stored_unit_of(summary.kind);
        object["correction"] = summary.by_table ? Json{} : Json(summary.correction);
        object["readings"] = summary.readings;
        const bool read = summary.readings > 0;
        object["first"] = read ? Json(summary.first) : Json{};
        object["last"] = read ? Json(summary.last) : Json{};
        object["minimum"] = read ? Json(summary.minimum) : Json{};
        object["maximum"] = read ? Json(summary.maximum) : Json{};
        list.push_back(std::move(object));
    }
    Json object;
    object["channels"] = std::move(list);
    return object;
}

void add_scale_summary(Json& object, const ScaleSummary& scale) {
    object["reference"] = "linear scale";
    object["scale_resolution_um"] = scale.resolution_um;
    object["scale_expansion_per_K"] = scale.expansion_per_K;
    object["scale_expansion_standard_uncertainty_per_K"] =
        stated_json(scale.expansion_standard_uncertainty_per_K);
    object["scale_first_degC"] = scale.first_degC;
    object["scale_last_degC"] = scale.last_degC;
    object["largest_scale_correction"] = scale.largest_correction;
}

void add_air_summary(Json& object, const CompensationSummary& done) {
    object["air_formula"] = done.air_formula;
    object["vacuum_wavelength_nm"] = done.vacuum_wavelength_nm;
    object["refractive_index_minus_1_first"] = done.refractive_index_minus_1_first;
    object["refractive_index_minus_1_last"] = done.refractive_index_minus_1_last;
}

Json compensation_of(const Certificate& certificate) {
    const CompensationSummary& done = certificate.compensation;
    const std::string& provenance = certificate.result.provenance;
    Json object;
    object["state"] = provenance.substr(0, provenance.find(':'));
    object["reference_temperature_degC"] = reference_temperature.in_celsius();
    if (certificate.run.imported) {
        object["reference_temperature_degC"] = nullptr;
        object["reference"] = "imported";
        object["after"] = done.after;
        return object;
    }
    if (done.scale)
        add_scale_summary(object, *done.scale);
    else
        add_air_summary(object, done);
    object["expansion_form"] = done.expansion_form;
    object["expansion_per_K"] = done.expansion_per_K;
    object["expansion_standard_uncertainty_per_K"] =
        stated_json(done.expansion_standard_uncertainty_per_K);
    object["material_first_degC"] = done.material_first_degC;
    object["material_last_degC"] = done.material_last_degC;
    if (!done.scale) {
        object["dead_path_mm"] = done.dead_path_mm;
        object["cosine_factor"] = done.cosine_factor;
        object["largest_air_correction"] = done.largest_air_correction;
    }
    object["largest_material_correction"] = done.largest_material_correction;
    object["before"] = done.before;
    object["after"] = done.after;
    object["remarks"] = done.remarks;
    return object;
}

/// Counts of readings; targets and approaches from 0, positions in mm or deg.
Json completeness_of(const Certificate& certificate) {
    const Completeness& known = certificate.completeness;
    Json object;
    object["status"] = known.partial() ? "partial" : "complete";
    object["expected"] = known.expected;
    object["used"] = known.used;
    object["left_out"] = Json::array();
    for (const LeftOut& entry : known.left_out)
        object["left_out"].push_back(
            {{"target", entry.target_index},
             {"position",
              certificate.planned_targets.at(static_cast<std::size_t>(entry.target_index))},
             {"direction", name_of(entry.direction)},
             {"approaches", entry.approaches},
             {"count", entry.approaches.size()},
             {"why", entry.why},
             {"target_omitted", entry.target_omitted}});
    return object;
}

/// By parameter, whose U is not evaluated. An object of its own: a new member of `document` may
/// move those that are being read.
Json not_evaluated_for(const Json& document) {
    Json uncertainty = Json::object();
    for (const auto& [key, parameter] : document.at("parameters").items())
        if (!parameter.contains("expanded_uncertainty")) uncertainty[key] = "not evaluated";
    return uncertainty;
}

void add_uncertainty(Json& document, const Certificate& certificate) {
    const RunUncertainty& known = certificate.uncertainty;
    std::map<std::string, double> targets;
    if (certificate.run.uncertainty)
        for (const auto& [parameter, limit] : certificate.run.uncertainty->targets)
            targets[parameter] =
                in_budget_units(certificate.run, limit) / budget_units_per(certificate.result.unit);
    if (known.budget)
        add_uncertainty_json(document, *known.budget, targets, certificate.result.unit);
    if (known.budget && known.simulation)
        add_simulation_json(document, *known.simulation, *known.budget, certificate.result.unit);
    if (known.true_figures) add_true_figures_json(document, *known.true_figures);
    document["preliminary"] = certificate.preliminary;
    if (!certificate.preliminary) return;
    document["missing"] = Json::array();
    for (const MissingTerm& term : known.missing)
        document["missing"].push_back(term.words);
    document["expanded_uncertainty"] = not_evaluated_for(document);
}

Json others_of(const std::vector<OtherResult>& others) {
    Json list = Json::array();
    for (const OtherResult& other : others) {
        Json object;
        object["standard"] = other.standard;
        object["confidence"] = other.confidence;
        object["note"] = stated_json(other.note);
        object["parameters"] = Json::object();
        for (const NamedFigure& figure : other.parameters)
            object["parameters"][figure.name]["value"] = figure.value;
        object["not_evaluated"] = other.not_evaluated;
        object["notes"] = other.notes;
        list.push_back(std::move(object));
    }
    return list;
}

} // namespace

Json certificate_to_json(const Certificate& certificate) {
    Json document = result_to_json(certificate.result);
    add_conformity(document, certificate.conformity);
    if (!certificate.others.empty()) document["other_standards"] = others_of(certificate.others);
    if (!certificate.setup_findings.empty())
        document["setup_findings"] = setup_findings_json(certificate.setup_findings);
    document["completeness"] = completeness_of(certificate);
    document["compensation"] = compensation_of(certificate);
    add_uncertainty(document, certificate);
    document["certificate"] = {
        {"number", stated_json(certificate.run.statements.certificate_number)},
        {"replaces", stated_json(certificate.replaces)}};
    document["run"] = run_of(certificate);
    document["environment"] = environment_of(certificate);
    return document;
}

} // namespace axiscal
