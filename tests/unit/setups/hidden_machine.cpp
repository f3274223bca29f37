#include "tests/unit/setups/hidden_machine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace axiscal::hidden_truth_test {
namespace {

constexpr double turn = 2 * std::numbers::pi;

double to_digit(double value, double digit) {
    return std::round(value / digit) * digit;
}

struct Row {
    double mean = 0, s = 0;
};

Row row_of(const std::vector<double>& stops) {
    Row row;
    const auto n = static_cast<double>(stops.size());
    for (const double stop : stops)
        row.mean += stop / n;
    for (const double stop : stops)
        row.s += (stop - row.mean) * (stop - row.mean) / (n - 1);
    row.s = std::sqrt(row.s);
    return row;
}

/// Smallest and largest of what was put in.
struct Extent {
    double low = HUGE_VAL, high = -HUGE_VAL;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] double range() const { return high - low; }
};

} // namespace

std::map<std::string, double> true_figures_of(const Stops& stops) {
    const std::array<std::string, 2> side{"_forward", "_backward"};
    std::map<std::string, double> figures{{"R_forward", 0}, {"R_backward", 0}, {"R", 0}, {"B", 0}};
    Extent accuracy, systematic, middle;
    std::array<Extent, 2> accuracy_of, systematic_of;
    for (std::size_t i = 0; i < stops[0].size(); ++i) {
        const std::array<Row, 2> rows{row_of(stops[0][i]), row_of(stops[1][i])};
        for (std::size_t d = 0; d < 2; ++d) {
            const auto& [mean, s] = rows[d];
            for (Extent* extent : {&accuracy, &accuracy_of[d]})
                extent->add(mean - 2 * s), extent->add(mean + 2 * s);
            for (Extent* extent : {&systematic, &systematic_of[d]})
                extent->add(mean);
            double& largest = figures["R" + side[d]];
            largest = std::max(largest, 4 * s);
        }
        const double reversal = rows[0].mean - rows[1].mean;
        middle.add((rows[0].mean + rows[1].mean) / 2);
        figures["B"] = std::max(figures["B"], std::fabs(reversal));
        figures["B_mean"] += reversal / static_cast<double>(stops[0].size());
        figures["R"] = std::max({figures["R"], 4 * rows[0].s, 4 * rows[1].s,
                                 2 * rows[0].s + 2 * rows[1].s + std::fabs(reversal)});
    }
    figures["A"] = accuracy.range(), figures["E"] = systematic.range();
    figures["M"] = middle.range();
    for (std::size_t d = 0; d < 2; ++d)
        figures["A" + side[d]] = accuracy_of[d].range(),
                      figures["E" + side[d]] = systematic_of[d].range();
    return figures;
}

HiddenMachine::HiddenMachine(std::uint64_t seed)
    : dice_{seed} {
    stated_.length_mm = between(400, 1000);
    stated_.dead_path_mm = between(30, 300);
    stated_.laser_U_um_per_m = between(0.5, 2);
    stated_.beam_offset_mm = between(0.5, 2);
    stated_.expansion = between(8, 12);
    stated_.expansion_width = between(1, 2);
    stated_.temperature_width_K = between(0.2, 1);
    dead_path_mm_ = stated_.dead_path_mm + normal(2);
    laser_ = normal(stated_.laser_U_um_per_m / 2) * 1e-6;
    // a place in the circle, every one as likely: the square of its distance is even
    cosine_ = between(0, 1) * std::pow(stated_.beam_offset_mm / stated_.length_mm, 2) / 2;
    expansion_ = stated_.expansion + stated_.expansion_width * between(-0.5, 0.5);
    beside_sensors_K_ = stated_.temperature_width_K * between(-0.5, 0.5);
    air_mean_C_ = between(18, 25);
    swing_K_ = between(0.1, 0.4), period_s_ = between(900, 3600), phase_ = between(0, turn);
    trend_K_per_h_ = between(-0.3, 0.3);
    pressure_Pa_ = between(97'000, 103'000), pressure_Pa_per_h_ = between(-60, 60);
    machine_K_ = between(-0.5, 1.5);
    lag_s_ = between(300, 900), damping_ = between(0.05, 0.3), sensor_lag_s_ = between(20, 120);
    drift_um_ = between(0.1, 0.8), drift_period_s_ = between(900, 5400);
    drift_phase_ = between(0, turn), drift_um_per_h_ = between(-1, 1);
    noise_um_ = between(0.01, 0.05);
    slope_um_per_m_ = between(-20, 20), play_um_ = between(0, 8), cyclic_um_ = between(0, 1);
    cyclic_mm_ = between(4, 20), scatter_um_ = between(0.2, 1);
}

double HiddenMachine::between(double low, double high) {
    return std::uniform_real_distribution{low, high}(dice_);
}

double HiddenMachine::normal(double deviation) {
    return std::normal_distribution{0.0, deviation}(dice_);
}

double HiddenMachine::wave(double s, double lag_s) const {
    return swing_K_ * std::sin(turn * (s - lag_s) / period_s_ + phase_) +
           trend_K_per_h_ * (s - lag_s) / 3600;
}

double HiddenMachine::air_C(double s) const {
    return air_mean_C_ + wave(s, 0);
}

double HiddenMachine::pressure_Pa(double s) const {
    return pressure_Pa_ + pressure_Pa_per_h_ * s / 3600;
}

double HiddenMachine::machine_C(double s) const {
    return air_mean_C_ + machine_K_ + damping_ * wave(s, lag_s_);
}

/// Dry air by the gas law, 2.7176e-4 at 101325 Pa and 20 degC.
double HiddenMachine::refractivity(double s) const {
    return 2.7176e-4 * pressure_Pa(s) / 101'325 * 293.15 / (273.15 + air_C(s));
}

double HiddenMachine::stop_um(double commanded_mm, bool from_below) {
    return slope_um_per_m_ * commanded_mm * 1e-3 +
           cyclic_um_ * std::sin(turn * commanded_mm / cyclic_mm_) + (from_below ? 0 : play_um_) +
           normal(scatter_um_);
}

double HiddenMachine::reading_m(double position_mm, double s, double datum_mm, double datum_s) {
    const double strain = expansion_ * 1e-6 * (machine_C(s) + beside_sensors_K_ - 20);
    const double drift_um = drift_um_ * std::sin(turn * s / drift_period_s_ + drift_phase_) +
                            drift_um_per_h_ * s / 3600;
    const double along_mm = (position_mm - datum_mm) * (1 + strain) * (1 - cosine_) +
                            (drift_um + normal(noise_um_)) * 1e-3;
    const double n = 1 + refractivity(s), n_at_datum = 1 + refractivity(datum_s);
    return (n * (dead_path_mm_ + along_mm) - n_at_datum * dead_path_mm_) * (1 + laser_) * 1e-3;
}

double HiddenMachine::shown_material_C(int sensor, double s) {
    return to_digit(machine_C(s - sensor_lag_s_) + 0.1 * (sensor - 0.5) + normal(0.004), 0.01);
}

double HiddenMachine::shown_air(int channel, double s) {
    if (channel == 0) return to_digit(air_C(s - 10) + normal(0.01), 0.01);
    if (channel == 1) return to_digit(pressure_Pa(s) + normal(2), 1);
    return to_digit(45 + normal(0.05), 0.01);
}

} // namespace axiscal::hidden_truth_test
