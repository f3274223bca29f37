#include "wire/simulated_bar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

namespace axiscal::simulate {

namespace {
double play_mm(double backlash_um) {
    return std::max(backlash_um * 1e-3, least_play_mm);
}

LaserScenario counter_of(const BallbarScenario& bar) {
    LaserScenario laser;
    laser.kind = bar.resolution_um ? "umd2-homodyne" : "umd2-heterodyne";
    laser.path = bar.path;
    laser.counts_per_cycle = bar.resolution_um ? 4 : 1; // A-quad-B: every edge of a line
    laser.rate_hz = bar.rate_hz;
    return laser;
}

/// Lines of the scale, or fringes of the laser.
double cycles_per_mm_of(const BallbarScenario& bar, const LaserScenario& counter) {
    if (bar.resolution_um) return 1e3 / (*bar.resolution_um * counter.counts_per_cycle);
    return counter.fold / (counter.wavelength_nm * 1e-6);
}

/// A counter that is faster than this hands over what it has once a frame, as one behind USB does.
constexpr double frame_s = 1e-3;
/// A late reader finds everything of so long, in records of at most so many characters.
constexpr double kept_s = 1.5;
constexpr double longest_record = 64;
} // namespace

TrueCircle::TrueCircle(const BallbarScenario& bar, std::uint64_t seed)
    : bar_{bar}
    , noise_{seed}
    , first_{play_mm(bar.backlash_first_um)}
    , second_{play_mm(bar.backlash_second_um)} {}

double TrueCircle::reading_mm(PlanePoint drive, std::uint64_t sample) {
    const double a = drive[0] - bar_.centre_first_mm, b = drive[1] - bar_.centre_second_mm;
    // the slide trails the drive by half the lost motion: Play gives -1 after a forward way
    const double first_lag = first_.follow(drive[0]) * bar_.backlash_first_um * 0.5e-3;
    const double second_lag = second_.follow(drive[1]) * bar_.backlash_second_um * 0.5e-3;
    const double cyclic =
        bar_.cyclic_first_um * 1e-3 * std::sin(2 * std::numbers::pi * a / bar_.cyclic_period_mm);
    // an angle of more than 90 degrees: a way along the second + axis goes back along the first
    const double x = a * (1 + bar_.scale_first_um_per_m * 1e-6) -
                     b * bar_.squareness_um_per_m * 1e-6 + first_lag + cyclic;
    const double y = b * (1 + bar_.scale_second_um_per_m * 1e-6) + second_lag;
    const double reading_mm = std::hypot(x, y) - bar_.radius_mm +
                              bar_.noise_um * 1e-3 * noise_.normal(NoiseStream::axis, sample);
    if (!bar_.stroke_um) return reading_mm;
    return std::clamp(reading_mm, -*bar_.stroke_um * 1e-3, *bar_.stroke_um * 1e-3);
}

SimulatedBar::SimulatedBar(const Scenario& scenario,
                           Pty pty,
                           SimClock clock,
                           const CommandedPlane& plane)
    : SimulatedDevice{"ballbar"}
    , path_{scenario.ballbar->path}
    , pty_{std::move(pty)}
    , clock_{clock}
    , plane_{plane}
    , circle_{*scenario.ballbar, scenario.seed}
    , laser_{counter_of(*scenario.ballbar)}
    , cycles_per_mm_{cycles_per_mm_of(*scenario.ballbar, laser_)}
    , counter_{laser_} {
    pty_.keep(static_cast<std::size_t>(counter_.rate_hz() * kept_s * longest_record));
}

/// The next record; empty where the counter leaves one out.
std::string SimulatedBar::record(PlanePoint drive) {
    const double reading_mm = circle_.reading_mm(drive, sample_++);
    const UmdRecord next = counter_.next(reading_mm * cycles_per_mm_);
    if (left_out_ == 0) return encode(next);
    --left_out_;
    return {};
}

void SimulatedBar::feed(PlanePoint drive) {
    const std::lock_guard lock{mutex_};
    const std::string one = record(drive);
    if (behaviour() == Behaviour::on) pty_.write(one);
}

void SimulatedBar::run(std::stop_token stop) {
    const double rate_hz = counter_.rate_hz();
    const auto together = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rate_hz * frame_s));
    const auto due_s = [&](std::uint64_t sample) { return static_cast<double>(sample) / rate_hz; };
    while (!stop.stop_requested()) {
        std::this_thread::sleep_until(clock_.at(due_s(sample_ + together - 1)));
        const std::lock_guard lock{mutex_};
        latest_s_ = std::max(latest_s_, clock_.now_s() - due_s(sample_ + together - 1));
        std::string frame;
        for (std::uint64_t i = 0; i < together; ++i)
            frame += record(plane_.position(due_s(sample_)));
        if (behaviour() == Behaviour::on) pty_.write(frame);
    }
}

void SimulatedBar::leave_out(std::uint64_t records) {
    const std::lock_guard lock{mutex_};
    left_out_ += records;
}

nlohmann::json SimulatedBar::status() const {
    const std::lock_guard lock{mutex_};
    return {{"path", path_},
            {"samples", sample_},
            {"sequence", counter_.sequence()},
            {"dropped", pty_.dropped()},
            {"records_dropped", pty_.lines_dropped()},
            {"latest_s", latest_s_}};
}

} // namespace axiscal::simulate
