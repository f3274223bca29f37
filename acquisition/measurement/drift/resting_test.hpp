#pragma once
// What a drift test begins with: its order held against the station, and the header of its file.
// Pure but for the run's id, which looks at what is stored.

#include "acquisition/live/roles.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/alignment_record.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "config/station_config.hpp"

#include <optional>

namespace axiscal {

/// capture.minimum_samples speaks of a laser's points; a gauge that is asked for each reading gives
/// few, and each of them is steady.
inline constexpr int fewest_of_bar = 2;

struct RestingTest {
    RunRecord header;
    DriftSetup setup;
    int watched = 0;                          ///< channel of the laser, scale or ballbar
    std::optional<AlignmentRecord> alignment; ///< of the beam, where it was watched
};

/// How long, how often, and where the axis rests. The far end of the travel unless the order says
/// more: the reading rises away from the interferometer. A rotary axis rests at its datum, where
/// the reflectors are square to the beam.
/// @param plan  of a run of this axis
/// @errors Fault::refused before a polygon; Fault::bad_request for spans or a place that cannot be.
Result<DriftSetup> drift_setup_of(const StationConfig& config,
                                  const StationRoles& roles,
                                  const DriftRequest& request,
                                  const RunPlan& plan);

/// Of the axis, which a laser or a scale measures.
/// @param parts  of TestKind::drift, with the plan of a run of this axis
/// @errors as make_run_header.
Result<RestingTest>
axis_at_rest(RunHeaderParts parts, const DriftRequest& request, const DriftSetup& setup);

/// Of the ballbar, which the station has.
/// @param parts    of TestKind::drift
/// @param rate_hz  readings of the ballbar a second; 0: not known yet
/// @errors Fault::bad_request for spans that cannot be, or a place; Fault::refused where it sends
/// too few readings; those of make_run_header.
Result<RestingTest> bar_at_rest(RunHeaderParts parts, const DriftRequest& request, double rate_hz);

} // namespace axiscal
