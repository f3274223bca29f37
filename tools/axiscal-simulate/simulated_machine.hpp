#pragma once
// The one truth: where the slide of the simulated machine really is, and what the laser beam and
// the air see of it. Everything the wire faces show comes from here.

#include "scenario.hpp"
#include "seeded_noise.hpp"
#include "true_air.hpp"

#include <cstdint>
#include <map>
#include <optional>

namespace axiscal::simulate {

/// The errors of the axis at 20 C as functions of the coordinate. Pure.
class TrueErrors {
public:
    explicit TrueErrors(ErrorScenario errors)
        : errors_{std::move(errors)} {}
    /// Pitch and periodic error, um, without reversal.
    [[nodiscard]] double pitch_um(double position_mm) const;
    /// B at this coordinate, um: forward minus backward.
    [[nodiscard]] double reversal_um(double position_mm) const;
    /// The deviation after an approach from below (direction +1) or from above (-1), um.
    [[nodiscard]] double deviation_um(double position_mm, int direction) const {
        return pitch_um(position_mm) + 0.5 * direction * reversal_um(position_mm);
    }

private:
    ErrorScenario errors_;
};

/// Play of an axis without lost motion; only keeps the state of the operator defined.
inline constexpr double least_play_mm = 1e-7;
/// Lost motion: the slide follows the drive only when the play is used up. Not thread-safe.
/// State in [-1, 1]: -1 after a forward approach (the slide trails below), +1 after a backward one.
class Play {
public:
    explicit Play(double width_mm)
        : half_mm_{0.5 * width_mm} {}
    double follow(double drive_mm);

private:
    double half_mm_;
    double slide_mm_ = 0;
    bool started_ = false;
};

/// The environment at a time after the start. Pure.
TrueAir air_at(const AirScenario& air, double seconds);
Temperature material_at(const ThermalScenario& thermal, double seconds);
/// Of the linear scale in the laser's place.
Temperature scale_at(const ThermalScenario& thermal, double seconds);
/// Exact expansion of a coordinate about the fixed point of the machine, mm.
double grown_mm(const ThermalScenario& thermal, double position_20_mm, Temperature material);

/// What is left of the axis's angle after the table was turned back to `table_deg`: true steps, and
/// the deviation of the position that is nearest. Pure.
double rest_deg(const TableScenario& table, double axis_deg, double table_deg);

/// What an autocollimator shows of the face that is nearest to it; nothing beyond its range. Pure.
std::optional<double> face_arcsec(const PolygonScenario& polygon, double axis_deg);

/// Steps through samples in order. One thread.
class SimulatedMachine {
public:
    explicit SimulatedMachine(const Scenario& scenario);

    /// One sample: the drive stands at drive_mm at this time.
    /// @returns where the slide really is, mm, in the length of the machine at its temperature.
    double slide_mm(double drive_mm, double seconds, std::uint64_t sample);
    /// Optical cycles since the counter started, from the exact equation
    /// N = fold (n L - n0 L0) / lambda with L the length from interferometer to reflector.
    double cycles(double slide_mm, double seconds);
    /// The same of optics that show a displacement of their own: N = fold (n D - n0 D0) / lambda.
    double cycles_of_displacement(double shown_mm, double seconds);
    /// Of an angular interferometer D = arm sin(rest) between its reflectors, which stand square
    /// when the rest is 0.
    double cycles_of_rest(double rest_deg, double seconds);
    /// The counter starts anew: the next sample is its zero.
    void zero_counter() { zeroed_ = false; }
    /// The beam turns about the interferometer by this angle to the motion: of the way from the
    /// near end, where the axis stands at zero_mm, it sees the cosine.
    void steer(double angle_rad) { beam_angle_rad_ = angle_rad; }
    /// An optic creeps on its magnet, or the scale slips: from now on the path is so much longer.
    void move_optic(double by_mm) { moved_mm_ += by_mm; }
    /// Contrast of the signal, %. On the way D from the near end the return spot walks off by
    /// e = 2 D tan(angle), since a retroreflector doubles it. Two equal Gaussian beams of radius w
    /// that are e apart overlap by exp(-e^2 / (2 w^2)), and so falls their contrast.
    [[nodiscard]] double contrast_percent(double slide_mm) const;

private:
    /// Of a linear scale: its lines lie true at 20 C and move apart as it warms.
    double cycles_of_scale(double way_mm, double seconds);
    double cycles_of_path(double length_mm, double seconds);
    double approach_offset_mm(double drive_mm, double dt_s);
    std::uint64_t index_of_stop(double drive_mm);

    Scenario scenario_;
    TrueErrors errors_;
    SeededNoise noise_;
    Play play_;
    bool moving_ = false, started_ = false, zeroed_ = false;
    double last_drive_mm_ = 0, last_seconds_ = 0, approach_mm_ = 0, approach_goal_mm_ = 0,
           optical_zero_mm_ = 0, beam_angle_rad_ = 0, moved_mm_ = 0;
    std::map<std::int64_t, std::uint64_t> visits_; ///< stops at each place, um
};

} // namespace axiscal::simulate
