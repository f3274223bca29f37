#pragma once
// A run whose readings are deviations across an axis, as it was evaluated from its run file: what
// the papers of a straightness and of a squareness have in common. Pure.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/conformity/conformity.hpp"
#include "analysis/positioning/completeness.hpp"
#include "analysis/straightness/straightness_figures.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// The figure that a paper leads with; a station names no other so far.
inline constexpr LineReference main_reference = LineReference::least_squares;
inline constexpr std::array line_references{LineReference::end_points, LineReference::least_squares,
                                            LineReference::minimum_zone};

const ReferenceLine& line_against(const Straightness& against, LineReference reference);

/// With `completeness.partial()` it bears no number and no verdict.
struct AcrossRun {
    RunRecord run; ///< its times told by one clock (run_clock.hpp)
    RunRevisions revisions;
    RunAttachments attachments;
    StraightnessReadings readings;
    StraightnessFigures figures; ///< of these readings
    Completeness completeness;
    std::vector<std::string> remarks;
    std::optional<Conformity> conformity; ///< of a complete test with limits
    std::string replaces;                 ///< the certificate that this one replaces; empty: none
    std::string run_file_sha256, result_digest;

    /// Of the set-up, a straightness or a squareness.
    [[nodiscard]] const StraightnessSetup& optics() const;
};

/// Run, revisions and attachments; of a run that is open the end is that of its last reading.
/// @returns how far the clock was off, as tell_times_by_one_clock()
/// @errors Fault::bad_run_file naming `path` without the set-up of `kind` or of a rotary axis;
/// Fault::incomplete_run without a reading.
Result<Duration>
take_across_run(AcrossRun& taken, const std::string& path, RunFileContents contents, TestKind kind);

/// Readings, completeness and figures of what was taken.
/// @returns pooled s of a single reading in um, of angle steps of a single angle in rad; 0: unknown
/// @errors those of read_straightness() and evaluate_straightness().
Result<double> read_across_run(AcrossRun& taken);

} // namespace axiscal
