#pragma once
// From the readings of a straightness run to deviations across the axis. Pure.

#include "analysis/positioning/completeness.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/straightness_setup.hpp"
#include "analysis/straightness/straightness_budget.hpp"
#include "analysis/straightness/straightness_figures.hpp"

#include <vector>

namespace axiscal {

/// Angle of the beams that leave a Wollaston prism -> factor: a motion d across the axis changes
/// the path of one beam by d sin(angle / 2) and of the other by as much the other way, both go
/// there and back, and the laser shows half of the difference: d = shown / (2 sin(angle / 2)). 1.59
/// deg gives 36, 0.159 deg gives 360. @errors Fault::bad_case "angle" outside 0.01 ... 10 deg.
Result<double> wollaston_factor(double angle_rad);

/// What a Wollaston set-up shows of a displacement since the datum, in um across the axis:
/// sign * factor * displacement / n. `n_minus_1` of the air; 2.71e-4 near 20 degC, where it is not
/// known: what that may be wrong by (5e-5) is far below any factor's uncertainty.
double deviation_um_of(const StraightnessSetup& setup, Length since_datum, double n_minus_1);
inline constexpr double usual_n_minus_1 = 2.71e-4;

/// Of angle steps: m angles by target and approach become m + 1 positions from targets_mm.front(),
/// deviations 0 at the first of each run; each run is integrated by itself. `angles_rad` positive
/// where the deviation rises along the axis.
struct AngleReadings {
    std::vector<double> targets_mm; ///< of the end of the foot that lies lower; a base apart
    std::vector<std::vector<double>> forward_rad, backward_rad; ///< m rows of n; or no backward
};
/// @errors Fault::bad_case "base" not positive; "targets[i]" not one base above the one before
/// (to 1 % of the base: a gap or an overlap is an error of the foot's next angle); "forward[i]" for
/// rows of other lengths.
Result<StraightnessReadings> integrated(const AngleReadings& readings, double base_mm);

struct ReadStraightness {
    StraightnessReadings readings;
    Completeness completeness;
    double scatter = 0; ///< angle steps: pooled s of the single angles, rad; else 0
};

/// The readings of a run that count (retakes, exclusions: usable_readings()). Those of a Wollaston
/// set-up are deviations from the datum; PointRecord::reading is what the laser counted. Of angle
/// steps PointRecord::reading holds the angle, one millimetre for one degree, as before a polygon.
/// Nothing is brought to 20 degC.
/// @errors Fault::bad_run_file for a run without a datum (Wollaston), a factor or base that is not
/// above 0, a sign that is none; those of check_complete() or check_points() and of
/// usable_readings(); Fault::incomplete_run for angle steps with a reading that is left out: the
/// line would begin anew behind it.
Result<ReadStraightness> read_straightness(const RunRecord& run,
                                           const RunRevisions& revisions,
                                           const StraightnessSetup& setup);

/// What the set-up states, for the budget; with StraightnessSetup::reversal that of the mean of
/// both positions of the mirror. `scatter`: of a single deviation, or of a single angle.
StraightnessInputs inputs_of(const StraightnessSetup& setup, double scatter, int readings_a_mean);

} // namespace axiscal
