#include "simulated_machine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::simulate {

namespace {

double table_um(const std::vector<TablePoint>& table, double position_mm) {
    if (table.empty()) return 0;
    const auto above =
        std::lower_bound(table.begin(), table.end(), position_mm,
                         [](const TablePoint& p, double x) { return p.position_mm < x; });
    if (above == table.begin()) return table.front().error_um;
    if (above == table.end()) return table.back().error_um;
    const TablePoint& a = *(above - 1);
    const double share = (position_mm - a.position_mm) / (above->position_mm - a.position_mm);
    return a.error_um + share * (above->error_um - a.error_um);
}

/// The deviation of a position of the turn, that of position 0 first; none is stated: 0.
double of_turn(const std::vector<double>& deviations, long position) {
    const auto count = static_cast<long>(deviations.size());
    if (count == 0) return 0;
    return deviations[static_cast<std::size_t>(((position % count) + count) % count)];
}

/// An axis settles to its stop; 10 ms is a stiff drive's time constant.
constexpr double settle_s = 0.01;
/// A sample step below this is standing still: 1 nm, the print step of a position stream.
constexpr double still_step_mm = 1.5e-6;

} // namespace

double TrueErrors::pitch_um(double position_mm) const {
    const double x_m = (position_mm - errors_.centre_mm) * 1e-3;
    double um = x_m * (errors_.linear_um_per_m +
                       x_m * (errors_.quadratic_um_per_m2 + x_m * errors_.cubic_um_per_m3));
    um += table_um(errors_.table, position_mm);
    for (const PeriodicError& term : errors_.periodic)
        um += term.amplitude_um * std::sin(2.0 * std::numbers::pi *
                                           (position_mm / term.period_mm + term.phase_deg / 360.0));
    return um;
}

double TrueErrors::reversal_um(double position_mm) const {
    return errors_.reversal_um +
           errors_.reversal_slope_um_per_m * (position_mm - errors_.centre_mm) * 1e-3;
}

double Play::follow(double drive_mm) {
    if (!started_) slide_mm_ = drive_mm - half_mm_; // as after a forward approach
    started_ = true;
    slide_mm_ = std::clamp(slide_mm_, drive_mm - half_mm_, drive_mm + half_mm_);
    return (slide_mm_ - drive_mm) / half_mm_;
}

TrueAir air_at(const AirScenario& air, double seconds) {
    return {Temperature::celsius(air.temperature.at(seconds)), pascal(air.pressure_pa.at(seconds)),
            percent(air.humidity_percent.at(seconds)), air.co2_ppm};
}

Temperature material_at(const ThermalScenario& thermal, double seconds) {
    return Temperature::celsius(thermal.material.at(seconds));
}

Temperature scale_at(const ThermalScenario& thermal, double seconds) {
    return Temperature::celsius(thermal.material.at(seconds) + thermal.scale_warmer_k);
}

double grown_mm(const ThermalScenario& thermal, double position_20_mm, Temperature material) {
    const Ratio growth =
        um_per_m_kelvin(thermal.expansion_um_per_m_k) * (material - reference_temperature);
    const double from_fixed_mm = position_20_mm - thermal.fixed_point_mm;
    return thermal.fixed_point_mm + from_fixed_mm * (1.0 + growth.si());
}

double rest_deg(const TableScenario& table, double axis_deg, double table_deg) {
    const long position = std::lround(table_deg / table.step_deg);
    return axis_deg - table_deg + of_turn(table.deviation_arcsec, position) / 3600.0;
}

std::optional<double> face_arcsec(const PolygonScenario& polygon, double axis_deg) {
    const double step_deg = 360.0 / polygon.faces;
    const long face = std::lround(axis_deg / step_deg);
    const double shown = (axis_deg - static_cast<double>(face) * step_deg) * 3600.0 +
                         of_turn(polygon.deviation_arcsec, face);
    return std::abs(shown) <= polygon.range_arcsec ? std::optional{shown} : std::nullopt;
}

SimulatedMachine::SimulatedMachine(const Scenario& scenario)
    : scenario_{scenario}
    , errors_{scenario.errors}
    , noise_{scenario.seed}
    , play_{std::max(std::abs(scenario.errors.reversal_um) * 1e-3, least_play_mm)}
    , beam_angle_rad_{scenario.laser.beam_tilt_mrad * 1e-3} {}

/// Its offset belongs to a stop by the place and the visit: a turning point between two moves,
/// which is seen as a stop or not by chance, changes no other.
std::uint64_t SimulatedMachine::index_of_stop(double drive_mm) {
    constexpr double places_per_mm = 1e3;
    const auto place = static_cast<std::int64_t>(std::llround(drive_mm * places_per_mm));
    return (static_cast<std::uint64_t>(place) << 20U) + ++visits_[place];
}

/// Each stop has its own random offset; the slide settles to it with the drive's time constant.
double SimulatedMachine::approach_offset_mm(double drive_mm, double dt_s) {
    const bool moves = std::abs(drive_mm - last_drive_mm_) > still_step_mm;
    if (moving_ && !moves)
        approach_goal_mm_ = scenario_.errors.approach_noise_um * 1e-3 *
                            noise_.normal(NoiseStream::approach, index_of_stop(drive_mm));
    moving_ = moves;
    approach_mm_ += (approach_goal_mm_ - approach_mm_) * (1.0 - std::exp(-dt_s / settle_s));
    return approach_mm_;
}

double SimulatedMachine::slide_mm(double drive_mm, double seconds, std::uint64_t sample) {
    const ErrorScenario& e = scenario_.errors;
    if (!started_) last_drive_mm_ = drive_mm, last_seconds_ = seconds, started_ = true;
    const double side = play_.follow(drive_mm); // -1 forward, +1 backward
    double deviation_um = errors_.pitch_um(drive_mm) - 0.5 * side * errors_.reversal_um(drive_mm);
    deviation_um += e.noise_um * noise_.normal(NoiseStream::axis, sample);
    deviation_um += e.vibration_um * std::sin(2.0 * std::numbers::pi * e.vibration_hz * seconds);
    deviation_um += e.drift_um_per_hour * seconds / 3600.0;
    const double offset_mm = approach_offset_mm(drive_mm, seconds - last_seconds_);
    last_drive_mm_ = drive_mm;
    last_seconds_ = seconds;
    const double at_20_mm = drive_mm + deviation_um * 1e-3 + offset_mm;
    if (scenario_.rotary()) return at_20_mm; // an angle does not grow
    return grown_mm(scenario_.thermal, at_20_mm, material_at(scenario_.thermal, seconds));
}

double SimulatedMachine::cycles(double slide_mm, double seconds) {
    const LaserScenario& laser = scenario_.laser;
    const double way_mm = laser.sign * (slide_mm - laser.zero_mm) + moved_mm_;
    if (laser.resolution_um) return cycles_of_scale(way_mm, seconds);
    return cycles_of_path(laser.dead_path_mm + way_mm * std::cos(beam_angle_rad_), seconds);
}

double SimulatedMachine::contrast_percent(double slide_mm) const {
    const LaserScenario& laser = scenario_.laser;
    if (!laser.beam_radius_mm) return laser.contrast_percent;
    const double walk_mm = 2 * (slide_mm - laser.zero_mm) * std::tan(beam_angle_rad_);
    const double share = walk_mm / *laser.beam_radius_mm;
    return laser.contrast_percent * std::exp(-0.5 * share * share);
}

double SimulatedMachine::cycles_of_scale(double way_mm, double seconds) {
    const LaserScenario& laser = scenario_.laser;
    const Ratio growth = um_per_m_kelvin(laser.scale_expansion_um_per_m_k) *
                         (scale_at(scenario_.thermal, seconds) - reference_temperature);
    const double marked_mm = way_mm / (1.0 + growth.si()); // what the lines under the head say
    if (!zeroed_) optical_zero_mm_ = marked_mm, zeroed_ = true;
    return (marked_mm - optical_zero_mm_) * 1e3 /
           (laser.resolution_um.value_or(1) * laser.counts_per_cycle);
}

double SimulatedMachine::cycles_of_rest(double rest_deg, double seconds) {
    const double rest_rad = rest_deg * std::numbers::pi / 180.0;
    const double arm_mm = scenario_.indexing_table ? scenario_.indexing_table->arm_mm : 0;
    return cycles_of_displacement(arm_mm * std::sin(rest_rad), seconds);
}

double SimulatedMachine::cycles_of_displacement(double shown_mm, double seconds) {
    return cycles_of_path(scenario_.laser.sign * shown_mm, seconds);
}

double SimulatedMachine::cycles_of_path(double length_mm, double seconds) {
    const LaserScenario& laser = scenario_.laser;
    const double index =
        1.0 + refractivity(air_at(scenario_.air, seconds), nm(laser.wavelength_nm));
    const double optical_mm = index * length_mm;
    if (!zeroed_) optical_zero_mm_ = optical_mm, zeroed_ = true;
    return laser.fold * (optical_mm - optical_zero_mm_) / (laser.wavelength_nm * 1e-6);
}

} // namespace axiscal::simulate
