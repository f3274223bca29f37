#pragma once
// One calibration of the simulated machine, drawn at random: what a station without an error of its
// own reads of this axis through these sensors. Drift, the sensors' steps and the pace of the run
// are part of the process. Pure; the same seed gives the same bits.

#include "scenario.hpp"
#include "seeded_noise.hpp"
#include "truth.hpp"

#include <vector>

namespace axiscal::simulate {

using Readings = std::vector<std::vector<double>>; ///< deviations, um [target][approach]

/// The environment that acts on a reading at one time, and what the sensors show of it.
struct Weather {
    double material_c = 20;      ///< true
    double material_error_k = 0; ///< shown minus true
    double index_error = 0;      ///< of the index of air by the shown values, minus the true one
    double scale_error_k = 0;    ///< shown minus true, of a linear scale in the laser's place
};
Weather weather_at(const Scenario& scenario, double seconds);
/// The air sensor with the coarsest steps decides.
struct AirSteps {
    double temperature_k = 0, pressure_pa = 0, humidity_percent = 0; ///< 0: shown exactly
};
AirSteps air_steps(const Scenario& scenario);

/// Standard deviation of one capture, um, without vibration: the offset of the stop, and what a
/// window leaves of the noise of its samples.
double capture_sigma_um(const Scenario& scenario);
/// Samples of the laser, or of the autocollimator, that one window holds, at least 1.
double samples_a_window(const Scenario& scenario);

class InjectedProcess {
public:
    InjectedProcess(const Scenario& scenario, const TruthPlan& plan);

    struct Run {
        Readings forward, backward; ///< backward is empty of a plan with one direction
    };
    /// The run of this number, from 0. It begins and ends within truth.duration_s and takes at
    /// least half of it; its captures follow each other evenly, up and down the axis by turns.
    [[nodiscard]] Run draw(std::uint64_t number) const;

private:
    /// How fast one run goes: capture k is made at begin_s + k step_s.
    struct Pace {
        double begin_s, step_s;
    };
    [[nodiscard]] Pace pace_of(std::uint64_t number) const;
    [[nodiscard]] const Weather& weather(double seconds) const;
    [[nodiscard]] double environment_um(double target_mm, double seconds, double begin_s) const;
    [[nodiscard]] double scatter_um(std::uint64_t capture) const;

    Scenario scenario_;
    TruthPlan plan_;
    SeededNoise noise_;
    std::vector<double> up_um_, down_um_; ///< injected at 20 C, of each target
    std::vector<Weather> weather_;        ///< evenly over truth.duration_s
    std::uint64_t captures_;              ///< of one run
    double sigma_um_, vibration_um_;
};

} // namespace axiscal::simulate
