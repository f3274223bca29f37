#pragma once
// What a squareness run begins with: as armed_straightness(), with the optical square and the lines
// that were measured before.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/measurement/squareness/squareness_config.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/runfile/complete_runs.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/squareness_setup.hpp"
#include "config/station_config.hpp"

#include <optional>

namespace axiscal {

/// Both tables; the station has them.
struct SquareTables {
    const StraightnessConfig& across;
    const SquarenessConfig& square;
};
/// Nothing of a station that lacks one of them: it measures no squareness.
std::optional<SquareTables> square_tables_of(const StationConfig& station);

/// How the square stands: as was said at arming, else as the station file says.
/// @errors Fault::bad_request for a word that is no position of it.
Result<SquarePosition> square_of(const SquarenessConfig& config, const ArmRequest& request);

/// Optics, square and what is stated of it; the lines are not in it yet.
/// @errors those of square_of() and mirror_of().
Result<SquarenessSetup> squareness_before_lines(const SquareTables& tables,
                                                const ArmRequest& request);

/// The run of the other axis, as was said at arming, else as the station file says.
WantedRun wanted_first_line(const SquareTables& tables, const ArmRequest& request);
/// The run with the square in the other position; nothing where none is named.
/// @param station  names its axis
std::optional<WantedRun> wanted_other_square(const StationConfig& station,
                                             const SquareTables& tables,
                                             const ArmRequest& request);

/// @param parts  of TestKind::squareness, with the plan
/// @param setup  with its lines
/// @param eve    as of armed_straightness()
/// @errors those of armed_straightness().
Result<ArmedRun> armed_squareness(const RunHeaderParts& parts,
                                  const SquareTables& tables,
                                  const ArmRequest& request,
                                  const std::optional<FoundEve>& eve,
                                  SquarenessSetup setup);

} // namespace axiscal
