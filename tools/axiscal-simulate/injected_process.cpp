#include "injected_process.hpp"

#include "simulated_machine.hpp"
#include "wire/simulated_sensors.hpp"
#include "wire/umd_counter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::simulate {

namespace {

constexpr int weather_steps = 1000;

double rounded(double value, double step) {
    return step > 0 ? std::round(value / step) * step : value;
}

/// Mean of the contact sensors as the tM-TH8 shows them, minus the truth, K.
double material_error_k(const Scenario& s, double true_c) {
    const auto& differences = s.thermal.sensor_difference_k;
    for (const SensorScenario& sensor : s.sensors) {
        if (sensor.kind != "tm-th8" || differences.empty()) continue;
        double sum = 0;
        for (const double difference : differences)
            sum += rounded(true_c + difference, temperature_step_k(sensor));
        return sum / static_cast<double>(differences.size()) - true_c;
    }
    return 0;
}

double scale_error_k(const Scenario& s, double true_c) {
    for (const SensorScenario& sensor : s.sensors)
        if (sensor.kind == "tm-th8") return rounded(true_c, temperature_step_k(sensor)) - true_c;
    return 0;
}

double index_error(const Scenario& s, const TrueAir& air) {
    if (s.laser.resolution_um) return 0; // a scale does not look through the air
    if (s.polygon) return 0;             // air does not turn a beam
    const AirSteps steps = air_steps(s);
    TrueAir shown = air;
    shown.temperature =
        Temperature::celsius(rounded(air.temperature.in_celsius(), steps.temperature_k));
    shown.pressure = pascal(rounded(air.pressure.in(pascal), steps.pressure_pa));
    shown.humidity = percent(rounded(air.humidity.in(percent), steps.humidity_percent));
    const Length wavelength = nm(s.laser.wavelength_nm);
    return refractivity(shown, wavelength) - refractivity(air, wavelength);
}

/// Amplitude that is left of a sine averaged over one window, um.
double vibration_left_um(const Scenario& s) {
    const double turns = std::numbers::pi * s.errors.vibration_hz * s.truth.window_s;
    return s.errors.vibration_um * std::abs(std::sin(turns)) / turns;
}

/// Of the way that the light goes to a target, with the sign of the laser, mm; behind an indexing
/// table the rest alone.
double beam_mm(const Scenario& s, double target_mm) {
    if (s.indexing_table) return target_mm - rounded(target_mm, s.indexing_table->step_deg);
    return s.laser.sign * s.laser.dead_path_mm + (target_mm - s.laser.zero_mm);
}

} // namespace

AirSteps air_steps(const Scenario& s) {
    AirSteps coarsest;
    for (const SensorScenario& sensor : s.sensors) {
        if (sensor.kind == "tm-th8") continue;
        const double step = temperature_step_k(sensor);
        const double pressure_step = sensor.kind == "dracal-vcp" ? 1.0 : 10.0;
        coarsest.temperature_k = std::max(coarsest.temperature_k, step);
        coarsest.pressure_pa = std::max(coarsest.pressure_pa, pressure_step);
        coarsest.humidity_percent = std::max(coarsest.humidity_percent, step);
    }
    return coarsest;
}

Weather weather_at(const Scenario& s, double seconds) {
    const double material_c = s.thermal.material.at(seconds);
    const double shown_of_scale =
        s.laser.resolution_um ? scale_error_k(s, scale_at(s.thermal, seconds).in_celsius()) : 0;
    return {material_c, material_error_k(s, material_c), index_error(s, air_at(s.air, seconds)),
            shown_of_scale};
}

double samples_a_window(const Scenario& s) {
    if (s.polygon) return std::max(1.0, s.truth.window_s / s.polygon->poll_s);
    return std::max(1.0, s.truth.window_s * UmdCounter{s.laser}.rate_hz());
}

double capture_sigma_um(const Scenario& s) {
    return std::hypot(s.errors.approach_noise_um,
                      s.errors.noise_um / std::sqrt(samples_a_window(s)));
}

InjectedProcess::InjectedProcess(const Scenario& scenario, const TruthPlan& plan)
    : scenario_{scenario}
    , plan_{plan}
    , noise_{scenario.seed}
    , captures_{plan.targets_mm.size() * static_cast<std::uint64_t>(plan.approaches) *
                (plan.bidirectional ? 2U : 1U)}
    , sigma_um_{capture_sigma_um(scenario)}
    , vibration_um_{vibration_left_um(scenario)} {
    const TrueErrors errors{scenario.errors};
    for (const double target : plan.targets_mm) {
        up_um_.push_back(errors.deviation_um(target, +1));
        down_um_.push_back(errors.deviation_um(target, -1));
    }
    for (int i = 0; i <= weather_steps; ++i)
        weather_.push_back(weather_at(scenario, scenario.truth.duration_s * i / weather_steps));
}

const Weather& InjectedProcess::weather(double seconds) const {
    const double share = std::clamp(seconds / scenario_.truth.duration_s, 0.0, 1.0);
    return weather_[static_cast<std::size_t>(std::lround(share * weather_steps))];
}

InjectedProcess::Pace InjectedProcess::pace_of(std::uint64_t number) const {
    const double whole_s = scenario_.truth.duration_s;
    const double taken_s =
        whole_s * (0.5 + 0.5 * noise_.uniform(NoiseStream::drawn_pace, 2 * number));
    const double begin_s =
        (whole_s - taken_s) * noise_.uniform(NoiseStream::drawn_pace, 2 * number + 1);
    return {begin_s, captures_ > 1 ? taken_s / static_cast<double>(captures_ - 1) : 0};
}

/// The station brings its reading to 20 C and out of the air by what the sensors show, starting
/// from the datum, which lies at the start of the axis. Terms of first order; what is the same for
/// all captures of a run is left out.
double InjectedProcess::environment_um(double target_mm, double seconds, double begin_s) const {
    const Weather& now = weather(seconds);
    double um = scenario_.errors.drift_um_per_hour * seconds / 3600.0 -
                beam_mm(scenario_, target_mm) * 1e3 * now.index_error;
    if (scenario_.rotary()) return um; // an angle does not expand
    const ThermalScenario& thermal = scenario_.thermal;
    const double alpha = thermal.expansion_um_per_m_k * 1e-6;
    const double datum_mm = scenario_.axis.start_mm;
    um -= (target_mm - datum_mm) * 1e3 * alpha * now.material_error_k;
    um += (datum_mm - thermal.fixed_point_mm) * 1e3 * alpha *
          (now.material_c - weather(begin_s).material_c);
    if (!scenario_.laser.resolution_um) return um;
    const double scale_alpha = scenario_.laser.scale_expansion_um_per_m_k * 1e-6;
    um += (target_mm - datum_mm) * 1e3 * scale_alpha * now.scale_error_k;
    um -= (datum_mm - scenario_.laser.zero_mm) * 1e3 * scale_alpha *
          (now.material_c - weather(begin_s).material_c);
    return um;
}

double InjectedProcess::scatter_um(std::uint64_t capture) const {
    const double phase = 2.0 * std::numbers::pi * noise_.uniform(NoiseStream::drawn_phase, capture);
    return sigma_um_ * noise_.normal(NoiseStream::draws, capture) + vibration_um_ * std::sin(phase);
}

InjectedProcess::Run InjectedProcess::draw(std::uint64_t number) const {
    const Pace pace = pace_of(number);
    const std::size_t count = plan_.targets_mm.size();
    Run run{Readings(count), Readings(plan_.bidirectional ? count : 0)};
    std::uint64_t made = 0;
    const auto capture = [&](Readings& readings, std::size_t target, double injected_um) {
        const double seconds = pace.begin_s + static_cast<double>(made) * pace.step_s;
        readings[target].push_back(injected_um +
                                   environment_um(plan_.targets_mm[target], seconds, pace.begin_s) +
                                   scatter_um(number * captures_ + made));
        ++made;
    };
    for (int approach = 0; approach < plan_.approaches; ++approach) {
        for (std::size_t i = 0; i < count; ++i)
            capture(run.forward, i, up_um_[i]);
        for (std::size_t i = run.backward.size(); i-- > 0;)
            capture(run.backward, i, down_um_[i]);
    }
    return run;
}

} // namespace axiscal::simulate
