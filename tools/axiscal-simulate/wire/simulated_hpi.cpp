#include "wire/simulated_hpi.hpp"

#include <chrono>

namespace axiscal::simulate {

namespace {

constexpr double hpi_distances_per_s = 25;
/// Each sensor speaks once a second.
constexpr std::uint64_t hpi_distances_per_meteo = 25;
/// How long a command may wait.
constexpr std::chrono::milliseconds hpi_look{5};
/// A laser that floods sends each frame this often.
constexpr int hpi_flood_factor = 200;

} // namespace

SimulatedHpi::SimulatedHpi(const Scenario& scenario,
                           Pty pty,
                           SimClock clock,
                           std::function<double(double)> drive)
    : SimulatedDevice{"laser"}
    , scenario_{scenario}
    , pty_{std::move(pty)}
    , clock_{clock}
    , drive_{std::move(drive)}
    , machine_{scenario} {
    machine_.steer(scenario.laser.beam_tilt_mrad * 1e-3);
}

void SimulatedHpi::write(const std::string& frames) {
    if (frames.empty()) return;
    switch (behaviour()) {
    case Behaviour::on: return pty_.write(frames);
    case Behaviour::off: return;
    case Behaviour::garbage: return pty_.write(garbage_bytes(scenario_.seed, sample_));
    case Behaviour::flood:
        for (int i = 0; i < hpi_flood_factor; ++i)
            pty_.write(frames);
    }
}

std::string SimulatedHpi::sensors(double seconds) const {
    const TrueAir air = air_at(scenario_.air, seconds);
    std::string frames = device_.air(
        {air.temperature.in_celsius(), air.humidity.in(percent), air.pressure.in(pascal)});
    int number = 0;
    for (const double off_k : scenario_.thermal.sensor_difference_k)
        frames += device_.material(++number, scenario_.thermal.material.at(seconds) + off_k);
    return frames;
}

std::string SimulatedHpi::next_frames() {
    const LaserScenario& laser = scenario_.laser;
    const double seconds = static_cast<double>(sample_) / hpi_distances_per_s;
    const double slide_mm = machine_.slide_mm(drive_(seconds), seconds, sample_);
    const double vacuum_mm =
        machine_.cycles(slide_mm, seconds) * laser.wavelength_nm * 1e-6 / laser.fold;
    const double index = 1 + refractivity(air_at(scenario_.air, seconds), nm(laser.wavelength_nm));
    const double position_mm = laser.device_corrects ? vacuum_mm / index : vacuum_mm;
    std::string frames = device_.distance(position_mm, machine_.contrast_percent(slide_mm));
    if (sample_ % hpi_distances_per_meteo == 0) frames += sensors(seconds);
    ++sample_;
    return frames;
}

void SimulatedHpi::run(std::stop_token stop) {
    while (!stop.stop_requested()) {
        const std::string heard = pty_.read(hpi_look);
        const std::lock_guard lock{mutex_};
        typed_ += heard;
        write(device_.answer(typed_));
        // What a busy computer has delayed comes at once: a laser does not pause, its frames wait in a buffer meanwhile.
        std::string due;
        while (clock_.now_s() >= static_cast<double>(sample_) / hpi_distances_per_s)
            due += next_frames();
        write(due);
    }
}

nlohmann::json SimulatedHpi::place() const {
    return {{"path", scenario_.laser.path}};
}

void SimulatedHpi::set_beam(bool on) {
    const std::lock_guard lock{mutex_};
    device_.set_beam(on);
}

void SimulatedHpi::restart() {
    const std::lock_guard lock{mutex_};
    device_.restart();
    machine_.zero_counter();
}

void SimulatedHpi::steer(double angle_rad) {
    const std::lock_guard lock{mutex_};
    machine_.steer(angle_rad);
}

} // namespace axiscal::simulate
