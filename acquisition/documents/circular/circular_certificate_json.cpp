#include "acquisition/documents/circular/circular_certificate_json.hpp"

#include "acquisition/documents/circular/circular_json.hpp"
#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/record_json.hpp"
#include "analysis/circular/circular_trials.hpp"

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::string label_of(const CircularCertificate& certificate, const std::string& key) {
    return circular_label(key, certificate.measured.test.source);
}

/// U stands where every term is stated; elsewhere it would be too small.
void limit_uncertainty(Json& document, const CircularCertificate& certificate) {
    document["preliminary"] = certificate.preliminary;
    Json not_evaluated = Json::object();
    for (const auto& [key, value] : circular::figures_by_key(certificate.parameters)) {
        if (certificate.uncertainty_of(key)) continue;
        const std::string label = label_of(certificate, key);
        document["parameters"][label].erase("expanded_uncertainty");
        not_evaluated[label] = "not evaluated";
    }
    if (!certificate.preliminary) return;
    document["missing"] = Json::array();
    for (const MissingTerm& term : certificate.missing)
        document["missing"].push_back(term.words);
    document["expanded_uncertainty"] = std::move(not_evaluated);
}

Json zone_json(const CircularDeviation& deviation, const CircularTest& test) {
    const ZoneRing& ring = deviation.ring;
    Json object;
    object["centre_mm"] = {ring.x_mm, ring.y_mm};
    object["outer_mm"] = ring.outer_mm;
    object["inner_mm"] = ring.inner_mm;
    object["control_points"] = Json::array();
    for (const RingPoint& point : ring.control_points) {
        const CircularTrace* trace = test.find(point.sense);
        Json held;
        held["sense"] = name_of(point.sense);
        held["reading"] = point.index;
        held["angle_deg"] = folded_angle(trace->angle_rad[point.index]) * degree_per_rad;
        held["side"] = point.side == ZoneSide::outer ? "outer" : "inner";
        object["control_points"].push_back(std::move(held));
    }
    object["least_squares"]["centre_mm"] = {deviation.fitted.x_mm, deviation.fitted.y_mm};
    object["least_squares"]["radius_mm"] = deviation.fitted.radius_mm;
    return object;
}

Json zones_of(const CircularCertificate& certificate) {
    const CircularParameters& from = certificate.parameters;
    const CircularTest& test = certificate.measured.test;
    Json object = Json::object();
    object["radii"] = "minus the nominal radius, as read; centres from the set-up's";
    if (from.ccw) object[label_of(certificate, "G_ccw")] = zone_json(from.ccw->G, test);
    if (from.cw) object[label_of(certificate, "G_cw")] = zone_json(from.cw->G, test);
    if (from.G_b) object[label_of(certificate, "G_b")] = zone_json(*from.G_b, test);
    return object;
}

Json compensation_of(const CircularCertificate& certificate) {
    const auto& bar = certificate.measured.expansion;
    Json object;
    object["state"] = certificate.parameters.correction_mm ? "F_and_D_at_20C" : "as_measured";
    object["correction_to_20C_mm"] = stated_json(certificate.parameters.correction_mm);
    if (!bar) return object;
    object["bar_degC"] = bar->bar_degC;
    object["machine_degC"] = bar->machine_degC;
    object["bar_alpha_per_K"] = bar->bar_alpha_per_K;
    object["machine_alpha_per_K"] = bar->machine_alpha_per_K;
    object["bar_length_mm"] = bar->bar_length_mm;
    return object;
}

Json temperature_json(const CircularTemperature& from) {
    Json object;
    object["mean_degC"] = stated_json(from.mean_degC);
    object["minimum_degC"] = from.mean_degC ? Json(from.low_degC) : Json{};
    object["maximum_degC"] = from.mean_degC ? Json(from.high_degC) : Json{};
    object["channel"] = stated_json(from.channel);
    return object;
}

Json environment_of(const CircularConditions& conditions) {
    Json object;
    object["air"] = temperature_json(conditions.air);
    object["instrument"] = temperature_json(conditions.bar);
    object["machine"] = temperature_json(conditions.machine);
    return object;
}

Json plan_of(const CircularMeasurement& measured) {
    const CircularConditions& conditions = measured.conditions;
    Json object;
    object["plane"] = measured.axes[0] + measured.axes[1];
    object["axes"] = {measured.axes[0], measured.axes[1]};
    object["nominal_diameter_mm"] = 2 * measured.test.nominal_radius_mm;
    object["nominal_radius_mm"] = measured.test.nominal_radius_mm;
    object["feed_mm_per_s"] = measured.test.feed_mm_per_s;
    object["centre_mm"] = stated_json(conditions.centre_mm);
    object["tool_offset"] = stated_json(conditions.tool_offset);
    object["work_offset"] = stated_json(conditions.work_offset);
    object["repeats"] = stated_json(conditions.repeats);
    object["warm_up_circles"] = stated_json(conditions.warm_up);
    object["overshoot_deg"] = stated_json(conditions.overshoot_deg);
    object["feed_in"] = stated_json(conditions.feed_in);
    return object;
}

/// Null of a case. What is done again is told in the keys of "parameters".
Json effect_of(const CircularCertificate& certificate) {
    if (!certificate.capture_effect) return {};
    const CaptureEffect& effect = *certificate.capture_effect;
    Json object;
    object["state"] = is_changed(effect.capture) ? "averaged_or_filtered" : "none_stated";
    if (!is_changed(effect.capture)) return object;
    object["averaged"] = effect.capture.averaged;
    object["low_pass_hz"] = stated_json(effect.capture.low_pass_hz);
    object["undulations"] = Json::array();
    for (const UndulationGain& one : effect.gains)
        object["undulations"].push_back({{"per_revolution", one.per_revolution},
                                         {"frequency_hz", one.frequency_hz},
                                         {"gain", one.gain}});
    object["one_percent_lost_at_per_revolution"] = stated_json(effect.one_percent_per_revolution);
    object["change_when_done_again_mm"] = Json::object();
    for (const auto& [key, change_mm] : effect.done_again_mm)
        object["change_when_done_again_mm"][label_of(certificate, key)] = change_mm;
    if (!effect.not_known.empty()) object["not_known"] = effect.not_known;
    return object;
}

Json capture_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const CircularConditions& conditions = measured.conditions;
    Json object;
    object["source"] = measured.test.source == SignalSource::feedback ? "feedback" : "external";
    object["taken_elsewhere"] = measured.taken_elsewhere;
    object["sample_rate_hz"] = stated_json(conditions.sample_rate_hz);
    object["filter"] = stated_json(conditions.filter);
    object["effect_on_G"] = effect_of(certificate);
    object["angle_origin"] = stated_json(conditions.angle_origin);
    object["missing_readings"] = measured.taken_elsewhere ? Json{} : Json(measured.run.missing);
    object["readings"] = Json::object();
    for (const CircularTrace& trace : measured.test.traces) {
        Json& driven = object["readings"][std::string{name_of(trace.sense)}];
        driven["count"] = trace.angle_rad.size();
        driven["start_deg"] = trace.angle_rad.front() * degree_per_rad;
        driven["end_deg"] = trace.angle_rad.back() * degree_per_rad;
    }
    return object;
}

/// Null where a sample of the arc states no u(t).
Json synchronisation_json(const std::optional<Synchronisation>& stated) {
    if (!stated) return {};
    return {{"u_t_us", seconds_of(stated->time_uncertainty) * 1e6}, {"error_um", stated->error_um}};
}

Json circles_of(const CircularRun& run) {
    Json list = Json::array();
    for (const CircleCapture& circle : run.circles) {
        Json object;
        object["sense"] = name_of(circle.trace.sense);
        object["repeat"] = circle.repeat;
        object["warm_up"] = circle.warm_up;
        object["readings"] = circle.trace.angle_rad.size();
        object["start_from"] = name_of(circle.start);
        object["residual_mm"] = circle.residual_mm;
        object["missing_readings"] = circle.missing;
        object["synchronisation"] = synchronisation_json(circle.synchronisation);
        list.push_back(std::move(object));
    }
    return list;
}

Json bar_of(const CircularBar& bar) {
    Json object;
    object["length_mm"] = bar.length_mm > 0 ? Json(bar.length_mm) : Json{};
    object["expansion_per_K"] = stated_json(bar.alpha_per_K);
    object["calibration_U_um"] = stated_json(bar.calibration_U_um);
    object["calibration_k"] = stated_json(bar.calibration_k);
    object["sign"] = bar.sign;
    return object;
}

Json run_of(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const CircularRun& run = measured.run;
    Json object;
    object["id"] = stated_json(run.run_id);
    object["station"] = stated_json(run.station);
    object["started"] = stated_json(measured.started_utc);
    object["finished"] = stated_json(measured.finished_utc);
    object["issued_on"] = stated_json(measured.finished_utc.substr(0, 10));
    object["next_calibration_due"] = stated_json(measured.next_due);
    object["software_version"] = stated_json(run.software_version);
    object[measured.taken_elsewhere ? "case_sha256" : "run_file_sha256"] =
        stated_json(certificate.file_sha256);
    object["config_sha256"] = stated_json(run.config_hash);
    object["result_digest"] = stated_json(certificate.result_digest);
    object["statements"] = statements_json(run.statements);
    object["plan"] = plan_of(measured);
    object["capture"] = capture_of(certificate);
    if (!measured.taken_elsewhere) {
        object["bar"] = bar_of(run.bar);
        object["circles"] = circles_of(run);
    }
    object["instruments"] = instruments_json(run.instruments, measured.started_utc.substr(0, 10));
    object["calibrations"] =
        calibrations_json(run.calibrations, run.channels, measured.started_utc.substr(0, 10));
    if (!measured.taken_elsewhere) {
        object["preflight"] = preflight_json(run.preflight);
        object["orders"] = orders_json(run.orders, run.opened);
    }
    object["events"] = events_json(run.events, run.opened);
    object["remarks"] = certificate.remarks;
    return object;
}

} // namespace

Json circular_certificate_to_json(const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    Json document = circular_to_json({measured.test, measured.axes, certificate.parameters,
                                      certificate.diagnosis, certificate.budget});
    limit_uncertainty(document, certificate);
    add_conformity(document, certificate.conformity);
    document["compensation"] = compensation_of(certificate);
    document["zones"] = zones_of(certificate);
    if (!certificate.of_repeats.empty()) {
        document["repeats"] = Json::object();
        for (const auto& [key, values] : certificate.of_repeats)
            document["repeats"][label_of(certificate, key)] = values;
    }
    document["certificate"] = {{"number", stated_json(measured.run.statements.certificate_number)},
                               {"replaces", stated_json(certificate.replaces)}};
    document["run"] = run_of(certificate);
    document["environment"] = environment_of(measured.conditions);
    return document;
}

} // namespace axiscal
