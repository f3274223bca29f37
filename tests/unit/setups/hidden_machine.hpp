#pragma once
// A machine and a way to measure it whose every error is drawn from what a station file states of
// it: the truth, and what the instruments read. It knows nothing of what finds it. Tests only.

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace axiscal::hidden_truth_test {

/// What a station file states; the true values are drawn within it.
struct Stated {
    double length_mm = 0, dead_path_mm = 0;
    double laser_U_um_per_m = 0; ///< k = 2, air sensors included
    double beam_offset_mm = 0;   ///< largest one over the length: the true one lies in its circle
    double expansion = 0;        ///< um/(m K)
    double expansion_width = 0;  ///< full
    double temperature_width_K = 0; ///< full: between sensors and machine
};

/// [forward, backward][target][approach], um at 20 degC.
using Stops = std::array<std::vector<std::vector<double>>, 2>;

/// ISO 230-2 of stops that were not measured but are known; k = 2. By the contract's keys.
std::map<std::string, double> true_figures_of(const Stops& stops);

class HiddenMachine {
public:
    explicit HiddenMachine(std::uint64_t seed);

    [[nodiscard]] const Stated& stated() const { return stated_; }
    /// Off the commanded place, at 20 degC, um; scatter drawn anew at each call.
    double stop_um(double commanded_mm, bool from_below);
    /// What the counter holds, in vacuum wavelengths, with the axis at `position_mm` at 20 degC and
    /// the datum at `datum_mm`, tied at `datum_s`. m.
    double reading_m(double position_mm, double s, double datum_mm, double datum_s);
    double shown_material_C(int sensor, double s);
    double shown_air(int channel, double s);

private:
    double between(double low, double high);
    double normal(double deviation);
    [[nodiscard]] double wave(double s, double lag_s) const;
    [[nodiscard]] double air_C(double s) const;
    [[nodiscard]] double pressure_Pa(double s) const;
    [[nodiscard]] double machine_C(double s) const;
    [[nodiscard]] double refractivity(double s) const;

    std::mt19937_64 dice_;
    Stated stated_;
    double dead_path_mm_, laser_, cosine_, expansion_, beside_sensors_K_; // the true ones
    double air_mean_C_, swing_K_, period_s_, phase_, trend_K_per_h_, pressure_Pa_,
        pressure_Pa_per_h_, machine_K_, lag_s_, damping_, sensor_lag_s_;
    double drift_um_, drift_period_s_, drift_phase_, drift_um_per_h_, noise_um_;
    double slope_um_per_m_, play_um_, cyclic_um_, cyclic_mm_, scatter_um_;
};

} // namespace axiscal::hidden_truth_test
