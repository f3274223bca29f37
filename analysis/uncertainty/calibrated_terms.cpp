#include "analysis/uncertainty/calibrated_terms.hpp"

#include "analysis/air/air_refraction.hpp"
#include "analysis/record/channel_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

std::string written(const char* format, double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

/// Standard uncertainty of one channel, in its stored unit; a length takes its part by metre over
/// `length_m`.
std::optional<double> standard_uncertainty_of(const RunRecord& run, int channel, double length_m) {
    const ChannelCalibration* stated = calibration_of(run, channel);
    if (!stated || (!stated->expanded_uncertainty && !stated->expanded_uncertainty_per_m))
        return std::nullopt;
    const double expanded = stated->expanded_uncertainty.value_or(0) +
                            stated->expanded_uncertainty_per_m.value_or(0) * length_m;
    return expanded / stated->coverage;
}

/// The worst of a kind; empty when one of them, or all, state nothing.
template <class IsOfKind>
std::optional<double> worst_of(const RunRecord& run, const IsOfKind& is_of_kind, double length_m) {
    std::optional<double> worst;
    for (const ChannelRecord& channel : run.channels) {
        if (!is_of_kind(channel)) continue;
        const auto u = standard_uncertainty_of(run, channel.id, length_m);
        if (!u) return std::nullopt;
        worst = std::max(worst.value_or(0), *u);
    }
    return worst;
}

AirState usual_air(const RunRecord& run) {
    AirState air;
    air.temperature = reference_temperature;
    air.pressure = pascal(101325);
    air.relative_humidity = percent(50);
    air.vacuum_wavelength = run.laser.vacuum_wavelength;
    air.co2_ppm = run.air.co2_ppm;
    return air;
}

struct AirKind {
    ChannelKind kind;
    const char* name;
    void (*add)(AirState& air, double amount); ///< in the stored unit
    double step;
};
constexpr std::array air_kinds{
    AirKind{
        ChannelKind::temperature, "air temperature",
        [](AirState& air, double amount) { air.temperature = air.temperature + kelvin(amount); },
        0.5},
    AirKind{ChannelKind::pressure, "air pressure",
            [](AirState& air, double amount) { air.pressure = air.pressure + pascal(amount); },
            500},
    AirKind{ChannelKind::humidity, "air humidity",
            [](AirState& air, double amount) {
                air.relative_humidity = air.relative_humidity + percent(amount);
            },
            5},
};

/// Relative change of a length for one stored unit, by a central difference.
std::optional<double> sensitivity_of(const RunRecord& run, const AirKind& kind) {
    AirState low = usual_air(run), high = low;
    kind.add(low, -kind.step);
    kind.add(high, kind.step);
    const auto below = refractivity_of(run.air.formula, low);
    const auto above = refractivity_of(run.air.formula, high);
    if (!below || !above) return std::nullopt;
    return (above->n_minus_1 - below->n_minus_1) / (2 * kind.step);
}

/// Full width of a temperature, K, from the sensors that `is_of_kind` picks.
template <class IsOfKind>
std::optional<double> width_of_sensors_K(const RunRecord& run,
                                         const IsOfKind& is_of_kind,
                                         const std::string& whose,
                                         std::vector<std::string>& remarks) {
    const auto u_K = worst_of(run, is_of_kind, 0);
    if (!u_K) return std::nullopt;
    const double width_K = 2 * std::sqrt(3.0) * *u_K;
    remarks.push_back("Uncertainty: the width of the " + whose +
                      " temperature is not stated; taken as "
                      "2 \u221A3 u = " +
                      written("%.3f", width_K) +
                      " K of the sensors' certificates. Contact and the places between the sensors "
                      "are not in it.");
    return width_K;
}

double expanded_um_of_scale(double scale_m, std::vector<std::string>& remarks) {
    const double expanded_um = calibrated_k * scale_m * 1e6;
    remarks.push_back("Uncertainty: the device is not stated; taken from the certificate of the "
                      "scale, U = " +
                      written("%.3f", expanded_um) + " \u00B5m (k = 2) over the length.");
    return expanded_um;
}

} // namespace

std::optional<double>
calibrated_device_um(const RunRecord& run, double length_m, std::vector<std::string>& remarks) {
    const auto is_laser = [&](const ChannelRecord& c) {
        return c.kind == ChannelKind::displacement && c.instrument == run.laser.instrument;
    };
    const auto laser_m = worst_of(run, is_laser, length_m);
    if (!laser_m) return std::nullopt;
    if (run.scale) return expanded_um_of_scale(*laser_m, remarks);
    double variance_um2 = std::pow(*laser_m * 1e6, 2);
    for (const AirKind& kind : air_kinds) {
        const auto is_kind = [&](const ChannelRecord& c) {
            return c.kind == kind.kind && c.medium != Medium::material;
        };
        const auto u = worst_of(run, is_kind, length_m);
        const auto sensitivity = sensitivity_of(run, kind);
        if (!u || !sensitivity) {
            remarks.push_back(
                "Uncertainty: the certificate of the laser alone makes no device term: " +
                std::string{kind.name} + " states no expanded uncertainty.");
            return std::nullopt;
        }
        variance_um2 += std::pow(*sensitivity * *u * length_m * 1e6, 2);
    }
    const double expanded_um = calibrated_k * std::sqrt(variance_um2);
    remarks.push_back(
        "Uncertainty: the device is not stated; taken from the certificates of laser and air "
        "sensors, U = " +
        written("%.3f", expanded_um) + " \u00B5m (k = 2) over the length.");
    return expanded_um;
}

std::optional<double> calibrated_temperature_width_K(const RunRecord& run,
                                                     std::vector<std::string>& remarks) {
    const auto is_material = [&](const ChannelRecord& c) {
        return c.kind == ChannelKind::temperature && c.medium == Medium::material &&
               !sits_on_scale(run, c.id);
    };
    return width_of_sensors_K(run, is_material, "material's", remarks);
}

std::optional<double> calibrated_scale_width_K(const RunRecord& run,
                                               std::vector<std::string>& remarks) {
    const auto is_scale = [&](const ChannelRecord& c) { return sits_on_scale(run, c.id); };
    return width_of_sensors_K(run, is_scale, "scale's", remarks);
}

} // namespace axiscal
