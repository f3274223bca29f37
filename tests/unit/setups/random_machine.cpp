#include "tests/unit/setups/random_machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace axiscal::setups_test {
namespace {

double to_digit(double value, double digit) {
    return std::round(value / digit) * digit;
}

} // namespace

std::string_view name_of(Mistake mistake) {
    constexpr std::array<std::string_view, 13> names{"none",
                                                     "inch for millimetre",
                                                     "reversed sign",
                                                     "exchanged directions",
                                                     "loose optic",
                                                     "no dead path",
                                                     "sensor in air",
                                                     "cold machine",
                                                     "wrong expansion",
                                                     "no overrun",
                                                     "one step late",
                                                     "other instrument",
                                                     "frozen air"};
    return names[static_cast<std::size_t>(mistake)];
}

RandomMachine::RandomMachine(std::uint64_t seed, Mistake mistake)
    : mistake_{mistake}
    , dice_{seed * 64 + static_cast<std::uint64_t>(mistake)} {
    length_mm_ = between(400, 1000);
    dead_path_mm_ = between(30, 600);
    stated_expansion_ = between(8, 12);
    true_expansion_ = stated_expansion_ + between(-0.5, 0.5);
    if (mistake == Mistake::wrong_expansion)
        true_expansion_ += between(0, 1) < 0.5 ? between(8, 12) : -between(6, 8);
    mean_air_C_ = between(18, 25);
    swing_K_ = between(0.1, 0.3);
    period_s_ = between(600, 2400);
    phase_ = between(0, 2 * std::numbers::pi);
    trend_K_per_h_ = between(-0.3, 0.3);
    pressure_Pa_ = between(97'000, 103'000);
    pressure_Pa_per_h_ = between(-60, 60);
    time_constant_s_ = between(3000, 20'000);
    machine_K_ = between(-0.5, 1.5);
    hidden_K_per_h_ = between(-0.3, 0.3);
    warming_K_ = mistake == Mistake::cold_machine ? between(5, 10) : 0;
    drift_um_per_h_ = between(-2, 2);
    slope_um_per_m_ = between(-20, 20);
    play_um_ = between(0, 8);
    cyclic_um_ = between(0, 1);
    cyclic_mm_ = between(4, 20);
    scatter_um_ = between(0.2, 1);
    sign_ = between(0, 1) < 0.5 ? -1 : 1;
    jump_um_ = sign_ * between(5, 20);
    jump_s_ = between(1000, 2000);
    frozen_from_s_ = mistake == Mistake::frozen_air ? between(0, 60) : HUGE_VAL;
    if (mistake == Mistake::wrong_expansion) { // elsewhere it changes no reading against another
        time_constant_s_ = between(900, 2000);
        swing_K_ = between(3, 5);
        period_s_ = between(1800, 3600);
    }
}

double RandomMachine::between(double low, double high) {
    return std::uniform_real_distribution{low, high}(dice_);
}

double RandomMachine::swing_K(double s, double gain, double lag) const {
    return swing_K_ * gain * std::sin(2 * std::numbers::pi * s / period_s_ + phase_ - lag);
}

double RandomMachine::air_C(double s) const {
    return mean_air_C_ + swing_K(s, 1, 0) + trend_K_per_h_ * s / 3600;
}

double RandomMachine::pressure_Pa(double s) const {
    return pressure_Pa_ + pressure_Pa_per_h_ * s / 3600;
}

double RandomMachine::humidity_percent(double s) const {
    return 45 - 2 * swing_K(s, 1, 0);
}

/// The air's swing through a lag of first order; a machine that was switched on late warms up with
/// half an hour.
double RandomMachine::machine_C(double s) const {
    constexpr double warming_s = 1800;
    const double w_tau = 2 * std::numbers::pi / period_s_ * time_constant_s_;
    return mean_air_C_ + machine_K_ + trend_K_per_h_ * s / 3600 +
           swing_K(s, 1 / std::hypot(1, w_tau), std::atan(w_tau)) -
           warming_K_ * std::exp(-s / warming_s);
}

double RandomMachine::shown_material_C(int sensor, double s) {
    const bool in_air = mistake_ == Mistake::sensor_in_air && sensor == 0;
    const double noise = std::normal_distribution{0.0, 0.004}(dice_);
    return to_digit((in_air ? air_C(s - 40) : machine_C(s) + 0.1 * sensor) + noise, 0.01);
}

double RandomMachine::shown_air(int channel, double s) {
    if (s > frozen_from_s_) {
        s = frozen_from_s_;
        const std::array held{air_C(s), pressure_Pa(s), humidity_percent(s)};
        return to_digit(held.at(static_cast<std::size_t>(channel)), channel == 1 ? 1 : 0.01);
    }
    std::normal_distribution<double> noise{0, 1};
    if (channel == 0) return to_digit(air_C(s) + 0.01 * noise(dice_), 0.01);
    if (channel == 1) return to_digit(pressure_Pa(s) + 2 * noise(dice_), 1);
    return to_digit(humidity_percent(s) + 0.05 * noise(dice_), 0.01);
}

double RandomMachine::stop_at(double commanded_mm, bool from_below) {
    const double scatter = std::normal_distribution{0.0, scatter_um_}(dice_);
    const double error_um =
        slope_um_per_m_ * commanded_mm * 1e-3 +
        cyclic_um_ * std::sin(2 * std::numbers::pi * commanded_mm / cyclic_mm_) +
        (from_below ? 0 : play_um_) + scatter;
    return commanded_mm + error_um * 1e-3;
}

/// Dry air by the gas law, 2.7176e-4 at 101325 Pa and 20 degC; water vapour left out, as it is the
/// same at all times but for less than 0.02e-6.
double RandomMachine::refractivity(double s) const {
    return 2.7176e-4 * pressure_Pa(s) / 101'325 * 293.15 / (273.15 + air_C(s));
}

double RandomMachine::reading_m(double position_mm, double s, double datum_mm, double datum_s) {
    const double hidden_K = hidden_K_per_h_ * s / 3600;
    const double strain = true_expansion_ * 1e-6 * (machine_C(s) + hidden_K - 20);
    double along_mm = (position_mm - datum_mm) * (1 + strain) + drift_um_per_h_ * s / 3600 * 1e-3;
    if (mistake_ == Mistake::loose_optic && s > jump_s_)
        along_mm += jump_um_ * (1.5 - 0.5 * std::exp(-(s - jump_s_) / 300)) * 1e-3;
    const double n = 1 + refractivity(s), n_at_datum = 1 + refractivity(datum_s);
    const double path_mm = n * (dead_path_mm_ + along_mm) - n_at_datum * dead_path_mm_;
    const double noise_mm = std::normal_distribution{0.0, 2e-5}(dice_);
    return (mistake_ == Mistake::reversed_sign ? -1 : 1) * (path_mm + noise_mm) * 1e-3;
}

} // namespace axiscal::setups_test
