#pragma once
// A machine of a shop, drawn at random, its air and how it is measured: all that a good run may
// have, and the one thing that a person does wrong. The truth; it knows nothing of what finds it.
// Tests only.

#include <cstdint>
#include <random>
#include <string_view>

namespace axiscal::setups_test {

enum class Mistake : std::uint8_t {
    none,
    inch_for_millimetre,
    reversed_sign,
    exchanged_directions,
    loose_optic,
    no_dead_path,
    sensor_in_air,
    cold_machine,
    wrong_expansion,
    no_overrun,
    one_step_late,
    other_instrument,
    frozen_air
};
std::string_view name_of(Mistake mistake);

class RandomMachine {
public:
    RandomMachine(std::uint64_t seed, Mistake mistake);

    [[nodiscard]] Mistake mistake() const { return mistake_; }
    /// Uniform; each call draws anew.
    double between(double low, double high);

    [[nodiscard]] double length_mm() const { return length_mm_; }
    [[nodiscard]] double dead_path_mm() const { return dead_path_mm_; }
    /// Of scale or screw, 1e-6/K, as the station file would state it; the true one differs within
    /// its stated standard uncertainty of 0.5, and by 8 or more where it is the mistake.
    [[nodiscard]] double stated_expansion() const { return stated_expansion_; }

    [[nodiscard]] double air_C(double s) const;
    [[nodiscard]] double pressure_Pa(double s) const;
    [[nodiscard]] double humidity_percent(double s) const;
    [[nodiscard]] double machine_C(double s) const;

    /// What the two material sensors and the three of air show, to the last digit of usual ones.
    double shown_material_C(int sensor, double s);
    double shown_air(int channel, double s);

    /// The axis stands where the control says `commanded_mm`, reached from below or above: form,
    /// play, cyclic error and scatter, drawn anew at each call. At 20 degC, mm.
    double stop_at(double commanded_mm, bool from_below);
    /// What the counter holds, in vacuum wavelengths, with the axis at `position_mm` at 20 degC and
    /// the datum at `datum_mm`, tied at `datum_s`. m.
    [[nodiscard]] double reading_m(double position_mm, double s, double datum_mm, double datum_s);

private:
    [[nodiscard]] double refractivity(double s) const;
    [[nodiscard]] double swing_K(double s, double gain, double lag) const;

    Mistake mistake_;
    std::mt19937_64 dice_;
    double length_mm_, dead_path_mm_, stated_expansion_, true_expansion_, mean_air_C_, swing_K_,
        period_s_, phase_, trend_K_per_h_, pressure_Pa_, pressure_Pa_per_h_, time_constant_s_,
        machine_K_, hidden_K_per_h_, warming_K_, drift_um_per_h_, slope_um_per_m_, play_um_,
        cyclic_um_, cyclic_mm_, scatter_um_, sign_, jump_um_, jump_s_, frozen_from_s_;
};

} // namespace axiscal::setups_test
