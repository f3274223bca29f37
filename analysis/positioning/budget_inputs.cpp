#include "analysis/positioning/budget_inputs.hpp"

#include "analysis/compensation/cosine_error.hpp"
#include "analysis/drift/drift.hpp"
#include "analysis/setup/course_drift.hpp"
#include "analysis/setup/frozen_sensor.hpp"
#include "analysis/setup/run_course.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace axiscal {
namespace {

UncertaintySetup setup_of(const Certificate& certificate) {
    return certificate.run.uncertainty.value_or(UncertaintySetup{});
}

BudgetInput input(UncertaintyTerm term, std::string quantity, std::string unit) {
    BudgetInput made;
    made.term = name_of(term);
    made.quantity = std::move(quantity);
    made.unit = std::move(unit);
    return made;
}

/// Nothing where there is no value: it stays missing.
void take(BudgetInput& to, std::optional<double> value, InputOrigin origin, std::string where) {
    if (!value) return;
    to.value = value;
    to.origin = origin;
    to.where = std::move(where);
}

BudgetInput device_of(const Certificate& certificate) {
    const UncertaintySetup setup = setup_of(certificate);
    const UncertaintyStatement& s = certificate.uncertainty.statement;
    const std::string unit = certificate.run.rotary ? "arcsec" : "um";
    if (s.device_width) {
        BudgetInput width =
            input(UncertaintyTerm::device, "full width of the device's limits", unit);
        take(width, s.device_width, InputOrigin::typed, "uncertainty.device_width");
        return width;
    }
    BudgetInput device = input(UncertaintyTerm::device, "U of the device over the length", unit);
    if (setup.device_U.stated())
        take(device, s.device_U, InputOrigin::typed, "uncertainty.device_U");
    else
        take(device, s.device_U, InputOrigin::certificate, "U of the instruments' channels");
    return device;
}

/// By the reading at the far end, else by the walk of the spot.
std::optional<CosineError> cosine_error_of(const Certificate& certificate) {
    const auto& alignment = certificate.attachments.alignment;
    if (!alignment) return std::nullopt;
    const auto by_reading = cosine_error_by_reading(*alignment);
    return by_reading ? by_reading : cosine_error_by_spot(*alignment);
}

BudgetInput misalignment_of(const Certificate& certificate) {
    const UncertaintyStatement& s = certificate.uncertainty.statement;
    BudgetInput beam =
        input(UncertaintyTerm::misalignment, "offset of the beam over the length", "mm");
    const double length_mm = s.length_m.value_or(0) * 1e3;
    if (s.misalignment_rad)
        take(beam, *s.misalignment_rad * length_mm, InputOrigin::typed,
             "uncertainty.misalignment_angle");
    take(beam, s.misalignment_mm, InputOrigin::typed, "uncertainty.misalignment");
    if (const auto left = cosine_error_of(certificate)) {
        beam.seen = left->angle.in(radian)*length_mm;
        beam.seen_in = "the alignment that was kept";
    }
    return beam;
}

/// Largest difference of two sensors at one time.
std::optional<double> gradient_K(const RunRecord& run) {
    std::vector<DriftSeries> sensors;
    for (const ChannelRecord& channel : run.channels)
        if (channel.medium == Medium::material && !sits_on_scale(run, channel.id))
            if (auto readings = readings_within(run, channel.id); !readings.times.empty())
                sensors.push_back(std::move(readings));
    std::optional<double> largest;
    for (std::size_t a = 0; a < sensors.size(); ++a)
        for (std::size_t b = 0; b < sensors.size(); ++b) {
            if (a == b) continue;
            for (std::size_t i = 0; i < sensors[a].times.size(); ++i) {
                const auto change = change_at(sensors[b], sensors[a].times[i]);
                if (!change) continue; // outside the record of the other
                const double other = sensors[b].readings.front() + *change;
                largest = std::max(largest.value_or(0), sensors[a].readings[i] - other);
            }
        }
    return largest;
}

BudgetInput temperature_width_of(const Certificate& certificate) {
    BudgetInput width = input(UncertaintyTerm::machine_temperature,
                              "full width of the material's temperature", "K");
    const bool typed = setup_of(certificate).temperature_width.has_value();
    take(width, certificate.uncertainty.statement.temperature_width_K,
         typed ? InputOrigin::typed : InputOrigin::certificate,
         typed ? "uncertainty.temperature_width" : "U of the material sensors");
    if (!certificate.run.points.empty()) width.seen = gradient_K(certificate.run);
    if (width.seen) width.seen_in = "the largest difference of two material sensors at one time";
    return width;
}

BudgetInput coefficient_of(const Certificate& certificate) {
    BudgetInput coefficient =
        input(UncertaintyTerm::machine_temperature, "coefficient of expansion", "um/(m*K)");
    take(coefficient, certificate.uncertainty.statement.alpha_um_per_m_K, InputOrigin::typed,
         "axis.material.coefficient");
    return coefficient;
}

BudgetInput expansion_width_of(const Certificate& certificate) {
    BudgetInput width = input(UncertaintyTerm::machine_expansion,
                              "full width of the coefficient of expansion", "um/(m*K)");
    const bool typed = setup_of(certificate).expansion_width.has_value();
    take(width, certificate.uncertainty.statement.alpha_width_um_per_m_K, InputOrigin::typed,
         typed ? "uncertainty.expansion_width"
               : "axis.material.standard_uncertainty, times 2 sqrt(3)");
    return width;
}

BudgetInput offset_of(const Certificate& certificate) {
    BudgetInput offset =
        input(UncertaintyTerm::machine_expansion, "largest distance from 20 degC", "K");
    take(offset, certificate.uncertainty.statement.temperature_offset_K, InputOrigin::readings,
         "every reading of the material sensors");
    return offset;
}

/// The least range of a straight drift in time that this run's readings show: the fitted one less
/// 2 u, with u from their scatter, taken as independent.
std::optional<double> least_drift_um(const Certificate& certificate) {
    const auto course =
        course_of(certificate.run, certificate.revisions, certificate.compensation.after);
    if (!course) return std::nullopt; // of a rotary axis, or without air
    const auto drift = drift_of(*course);
    if (!drift) return std::nullopt;
    return std::max(drift->range_um - 2 * drift->standard_uncertainty_um, 0.0);
}

BudgetInput environment_of(const Certificate& certificate) {
    BudgetInput eve =
        input(UncertaintyTerm::environment, "E_VE", certificate.run.rotary ? "arcsec" : "um");
    const std::string& drift_test = certificate.attachments.eve_source;
    if (drift_test.empty())
        take(eve, certificate.uncertainty.statement.eve, InputOrigin::typed, "uncertainty.eve");
    else
        take(eve, certificate.uncertainty.statement.eve, InputOrigin::drift_test, drift_test);
    eve.seen = least_drift_um(certificate);
    if (eve.seen) eve.seen_in = "the straight drift in time of this run's readings, less 2 u";
    return eve;
}

/// Of the laser along the travel. It enters no term, but a weak beam counts wrongly.
std::optional<BudgetInput> strength_of(const Certificate& certificate) {
    const auto& alignment = certificate.attachments.alignment;
    if (!alignment || alignment->places.empty()) return std::nullopt;
    BudgetInput strength = input(UncertaintyTerm::device, "least strength along the travel", "%");
    strength.term = "strength";
    const auto weakest =
        std::ranges::min_element(alignment->places, {}, &AlignmentPlace::weakest_percent);
    take(strength, weakest->weakest_percent, InputOrigin::readings, "the alignment that was kept");
    return strength;
}

BudgetInput of_scale(UncertaintyTerm term,
                     std::string quantity,
                     std::string unit,
                     std::optional<double> value,
                     InputOrigin origin,
                     std::string where) {
    BudgetInput made = input(term, std::move(quantity), std::move(unit));
    take(made, value, origin, std::move(where));
    return made;
}

void add_scale(std::vector<BudgetInput>& inputs, const Certificate& certificate) {
    using enum UncertaintyTerm;
    const UncertaintyStatement& s = certificate.uncertainty.statement;
    const bool typed = certificate.run.scale->temperature_width.has_value();
    inputs.push_back(of_scale(device_temperature, "full width of the scale's temperature", "K",
                              s.device_temperature_width_K,
                              typed ? InputOrigin::typed : InputOrigin::certificate,
                              typed ? "axis.scale.temperature_width" : "U of the scale's sensors"));
    inputs.push_back(of_scale(device_temperature, "coefficient of the scale", "um/(m*K)",
                              s.device_alpha_um_per_m_K, InputOrigin::typed,
                              "axis.scale.coefficient"));
    inputs.push_back(of_scale(device_expansion, "full width of the scale's coefficient", "um/(m*K)",
                              s.device_alpha_width_um_per_m_K, InputOrigin::typed,
                              "axis.scale.standard_uncertainty, times 2 sqrt(3)"));
    inputs.push_back(of_scale(device_expansion, "largest distance of the scale from 20 degC", "K",
                              s.device_temperature_offset_K, InputOrigin::readings,
                              "every reading of the scale's sensors"));
}

} // namespace

std::vector<BudgetInput> budget_inputs_of(const Certificate& certificate) {
    if (certificate.run.imported) return {}; // no U follows from them
    if (certificate.run.rotary) return {device_of(certificate), environment_of(certificate)};
    std::vector<BudgetInput> inputs{
        device_of(certificate),          misalignment_of(certificate),
        coefficient_of(certificate),     temperature_width_of(certificate),
        expansion_width_of(certificate), offset_of(certificate)};
    if (auto strength = strength_of(certificate))
        inputs.insert(inputs.begin() + 1, *std::move(strength));
    if (certificate.run.scale) add_scale(inputs, certificate);
    inputs.push_back(environment_of(certificate));
    return inputs;
}

} // namespace axiscal
