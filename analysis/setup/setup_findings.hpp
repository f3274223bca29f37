#pragma once
// What of a run's scatter is the set-up's and not the machine's: an optic that moved, a dead path
// or an expansion that is not what the station file says, a machine that warmed up. Pure.

#include "analysis/setup/run_course.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class SetupError : std::uint8_t {
    moved_optic,  ///< from one reading on all are off by the same
    dead_path,    ///< all move with the index of air, wherever the axis stands
    expansion,    ///< they move with the material's temperature, in proportion to the distance
    growth,       ///< they grow with time in proportion to the distance, and no sensor shows it
    frozen_air,   ///< an air sensor repeats its last reading (sensor_findings.hpp)
    sensor_in_air ///< a material sensor shows what the air does (sensor_findings.hpp)
};
/// "moved_optic", "dead_path", "expansion", "growth", "frozen_air", "sensor_in_air".
std::string_view name_of(SetupError error);

struct SetupFinding {
    SetupError error = SetupError::moved_optic;
    /// Step um, missing dead path m, missing expansion 1e-6/K, growth um/(m h), minutes without a
    /// change, share of the air's swings.
    double value = 0;
    double standard_uncertainty = 0; ///< of `value`, by the scatter that is left
    double range_um = 0;             ///< largest - smallest of what it does to the readings
    double log_odds = 0; ///< natural logarithm, against the best explanation without a set-up error
    std::optional<PlannedPoint> from;    ///< of a moved optic: the first reading behind the step
    std::string sensor;                  ///< name of the instrument or channel; else empty
    std::vector<SetupError> or_else;     ///< what explains the readings nearly as well
    std::string seen, probably, look_at; ///< a sentence each
    std::string answer, answered_by;     ///< of a person; empty: none yet
};

/// From what on a finding is told. Defaults where the station file states nothing.
struct SetupLimits {
    double least_range_um = 0.5;   ///< a smaller effect changes no figure that is printed
    double least_log_odds = 6.9;   ///< 1000 to 1
    double dead_path_m = 0.02;     ///< as well as a person measures it
    double expansion_per_K = 2e-6; ///< expanded uncertainty of the stated coefficient
    double growth_um_per_m = 12;   ///< within a run: steel whose temperature is known to 1 K
};
/// What the run itself states of them.
SetupLimits limits_of(const RunRecord& run);

/// The one error that explains the readings best, or none. A run of less than two readings in each
/// cell, or of less than twenty, tells nothing.
///
/// Beside the mean of its cell a reading is modelled as y = course + error + noise. Courses, which
/// are the machine's or the room's: none; a t; a t + b t^2; beside an error also a t + b t x.
/// Errors: a step at each time; D (n - n0); dalpha x (theta - 20 degC); growth, which is a t + b t
/// x alone. Models are compared by -v/2 ln(S) - k/2 ln(v) (Schwarz 1978: S the sum of squares that
/// is left, v = readings - cells, k coefficients, the time of a step counts as two); the difference
/// of two is the logarithm of the odds between them. A growth counts where it exceeds what the
/// stated width of the material's temperature explains. Readings are not taken to be known better
/// than 0.02 um: what is smaller is nobody's error.
std::optional<SetupFinding> find_setup_error(const RunCourse& course, const SetupLimits& limits);

} // namespace axiscal
