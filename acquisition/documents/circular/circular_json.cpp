#include "acquisition/documents/circular/circular_json.hpp"

#include <string>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;
using circular::Cause;

Json deviation_json(const CircularDeviation& deviation) {
    Json object;
    object["value"] = deviation.minimum_zone_mm;
    object["method"] = "minimum_zone";
    object["least_squares"] = deviation.least_squares_mm;
    object["gap"] = deviation.gap_mm;
    if (deviation.wide) object["local_optimum_only"] = true;
    return object;
}

Json radial_json(double value, RadialCentre centre) {
    Json object;
    object["value"] = value;
    object["centre"] = name_of(centre);
    return object;
}

void add_uncertainty(Json& parameters,
                     const std::optional<CircularBudget>& budget,
                     SignalSource source) {
    if (!budget) return;
    for (const CircularFigureUncertainty& figure : budget->figures) {
        Json object;
        object["value"] = figure.expanded_mm;
        object["k"] = budget->coverage;
        if (figure.monte_carlo_u_mm)
            object["monte_carlo"] = budget->coverage * *figure.monte_carlo_u_mm;
        parameters[circular_label(figure.key, source)]["expanded_uncertainty"] = std::move(object);
    }
}

Json parameters_json(const CircularAnswer& answer) {
    const CircularParameters& from = answer.parameters;
    const SignalSource source = answer.test.source;
    Json object = Json::object();
    if (from.ccw) object[circular_label("G_ccw", source)] = deviation_json(from.ccw->G);
    if (from.cw) object[circular_label("G_cw", source)] = deviation_json(from.cw->G);
    if (from.G_b) object[circular_label("G_b", source)] = deviation_json(*from.G_b);
    for (const Sense sense : {Sense::ccw, Sense::cw}) {
        const auto& seen = from.of(sense);
        const std::string suffix = "_" + std::string{name_of(sense)};
        if (!seen || from.not_evaluated.contains("F_max" + suffix)) continue;
        object["F_max" + suffix] = radial_json(seen->F.max_mm, seen->F.centre);
        object["F_min" + suffix] = radial_json(seen->F.min_mm, seen->F.centre);
    }
    if (from.D_mm) {
        object["D"]["value"] = *from.D_mm;
        object["D"]["condition"] = *from.D_condition;
    }
    add_uncertainty(object, answer.budget, source);
    return object;
}

Json traces_json(const CircularParameters& from) {
    Json list = Json::array();
    for (const Sense sense : {Sense::ccw, Sense::cw}) {
        if (!from.of(sense)) continue;
        Json object;
        object["sense"] = name_of(sense);
        object["arc_deg"] = from.of(sense)->cover.arc_deg;
        object["full_circle"] = from.of(sense)->cover.full_circle;
        list.push_back(std::move(object));
    }
    return list;
}

/// The contract's keys, and the same with standard uncertainties. A centre is a pair.
void add_causes(const CircleDiagnosis& from, Json& values, Json& uncertainties) {
    for (std::size_t i = 4; i < circular::cause_count; ++i) {
        const CauseEstimate& estimate = from.causes[i];
        if (!estimate.value) continue;
        const std::string key{circular::key_of(static_cast<Cause>(i))};
        values[key] = *estimate.value;
        uncertainties[key] = estimate.standard_uncertainty;
    }
    for (const auto& [key, x, y] :
         {std::tuple{"center_ccw_mm", Cause::center_ccw_x, Cause::center_ccw_y},
          std::tuple{"center_cw_mm", Cause::center_cw_x, Cause::center_cw_y}}) {
        const CauseEstimate &first = from.of(x), &second = from.of(y);
        if (!first.value || !second.value) continue;
        values[key] = {*first.value, *second.value};
        uncertainties[key] = {first.standard_uncertainty, second.standard_uncertainty};
    }
}

Json not_separable_json(const CircleDiagnosis& from) {
    Json list = Json::array();
    for (const InseparableGroup& group : from.not_separable) {
        Json object;
        object["causes"] = Json::array();
        for (const Cause cause : group.causes)
            object["causes"].push_back(circular::key_of(cause));
        object["peak_to_valley_mm"] = group.peak_to_valley_mm;
        list.push_back(std::move(object));
    }
    return list;
}

Json ranking_json(const CircleDiagnosis& from) {
    Json list = Json::array();
    for (const CauseContribution& one : from.ranking) {
        Json object;
        object["cause"] = one.cause;
        object["G_mm"] = one.G_mm;
        object["G_b_mm"] = one.G_b_mm;
        object["peak_to_valley_mm"] = one.peak_to_valley_mm;
        object["significant"] = one.significant;
        object["words"] = one.words;
        list.push_back(std::move(object));
    }
    return list;
}

Json cyclic_json(const CircleDiagnosis& from, const AxisNames& axes) {
    Json list = Json::array();
    for (const circular::CyclicError& cyclic : from.cyclic) {
        Json object;
        object["axis"] = axes[static_cast<std::size_t>(cyclic.axis)];
        object["pitch_mm"] = cyclic.pitch_mm;
        object["amplitude_mm"] = cyclic.amplitude_mm;
        object["peak_to_valley_mm"] = 2 * cyclic.amplitude_mm;
        object["phase_rad"] = cyclic.phase_rad;
        object["standard_uncertainty"] = {
            {"pitch_mm", cyclic.pitch_standard_uncertainty_mm},
            {"amplitude_mm", cyclic.amplitude_standard_uncertainty_mm}};
        list.push_back(std::move(object));
    }
    return list;
}

Json reversals_json(const CircleDiagnosis& from, const AxisNames& axes) {
    Json list = Json::array();
    for (const circular::Reversal& reversal : from.reversals) {
        Json object;
        object["sense"] = name_of(reversal.sense);
        object["axis"] = axes[static_cast<std::size_t>(reversal.axis)];
        object["at_deg"] = reversal.at_deg;
        object["step_mm"] = reversal.step_mm;
        object["step_standard_uncertainty_mm"] = reversal.step_standard_uncertainty_mm;
        object["spike_mm"] = reversal.spike_mm;
        object["spike_width_deg"] = reversal.spike_width_deg;
        object["spike_width_ms"] = reversal.spike_width_ms;
        object["spike_significant"] = reversal.spike_significant;
        list.push_back(std::move(object));
    }
    return list;
}

Json change_overs_json(const CircleDiagnosis& from) {
    Json list = Json::array();
    for (const circular::ChangeOver& step : from.change_overs) {
        Json object;
        object["sense"] = name_of(step.sense);
        object["at_deg"] = step.at_deg;
        object["step_mm"] = step.step_mm;
        object["standard_uncertainty_mm"] = step.standard_uncertainty_mm;
        object["significant"] = step.significant;
        list.push_back(std::move(object));
    }
    return list;
}

Json common_lag_json(const CommonLag& lag) {
    Json object;
    object["radius_change_mm"] = lag.radius_change_mm;
    if (lag.longest_s) object["lag_s_if_nothing_else"] = *lag.longest_s;
    object["separable"] = false;
    object["words"] =
        "One feed does not tell a lag common to both axes from a scale error of both.";
    return object;
}

Json diagnosis_json(const CircularAnswer& answer) {
    const CircleDiagnosis& from = answer.diagnosis;
    Json object, uncertainties = Json::object();
    add_causes(from, object, uncertainties);
    object["standard_uncertainty"] = std::move(uncertainties);
    object["rank"] = from.rank;
    object["columns"] = from.columns;
    object["condition"] = from.condition;
    object["residual_rms_mm"] = from.residual_rms_mm;
    object["reversals_masked"] = from.reversals_masked;
    object["not_separable"] = not_separable_json(from);
    object["ranking"] = ranking_json(from);
    if (from.common_lag) object["common_lag"] = common_lag_json(*from.common_lag);
    object["cyclic"] = cyclic_json(from, answer.axes);
    if (from.lobes)
        object["lobes"] = {{"per_turn", from.lobes->per_turn},
                           {"amplitude_mm", from.lobes->amplitude_mm}};
    object["reversals"] = reversals_json(from, answer.axes);
    object["change_overs"] = change_overs_json(from);
    if (from.vibration)
        object["vibration"] = {{"rms_mm", from.vibration->rms_mm},
                               {"peak_to_valley_mm", from.vibration->peak_to_valley_mm}};
    if (answer.parameters.correction_mm && from.of(Cause::scale_x).value &&
        from.of(Cause::scale_y).value) {
        const double strain = *answer.parameters.correction_mm / answer.test.nominal_radius_mm;
        object["scale_x_at_20C"] = *from.of(Cause::scale_x).value + strain;
        object["scale_y_at_20C"] = *from.of(Cause::scale_y).value + strain;
    }
    return object;
}

Json budget_json(const CircularBudget& budget) {
    Json object;
    object["n"] = budget.runs;
    object["k"] = budget.coverage;
    object["contributions"] = Json::array();
    for (const CircularContribution& one : budget.contributions) {
        Json term{{"term", one.term},
                  {"u_mm", one.u_mm},
                  {"formula", one.formula},
                  {"status", one.status}};
        if (!one.source.empty()) term["source"] = one.source;
        object["contributions"].push_back(std::move(term));
    }
    object["not_stated"] = budget.not_stated;
    object["trials"] = budget.trials;
    return object;
}

} // namespace

std::string circular_label(const std::string& key, SignalSource source) {
    if (source == SignalSource::external || !key.starts_with('G')) return key;
    return "G_f" + key.substr(1);
}

Json circular_to_json(const CircularAnswer& answer) {
    Json document;
    document["format"] = "axiscal.result/1";
    document["standard"] = "ISO 230-4";
    document["unit"] = "mm";
    document["source"] = answer.test.source == SignalSource::feedback ? "feedback" : "external";
    document["plane"] = answer.axes[0] + answer.axes[1];
    document["compensation"] = answer.parameters.correction_mm ? "F_and_D_at_20C" : "as_measured";
    if (answer.parameters.correction_mm)
        document["correction_to_20C_mm"] = *answer.parameters.correction_mm;
    document["parameters"] = parameters_json(answer);
    document["traces"] = traces_json(answer.parameters);
    document["diagnosis"] = diagnosis_json(answer);
    if (answer.budget) document["budget"] = budget_json(*answer.budget);
    if (!answer.parameters.not_evaluated.empty()) {
        document["not_evaluated"] = Json::object();
        for (const auto& [key, reason] : answer.parameters.not_evaluated)
            document["not_evaluated"][circular_label(key, answer.test.source)] = reason;
    }
    return document;
}

} // namespace axiscal
