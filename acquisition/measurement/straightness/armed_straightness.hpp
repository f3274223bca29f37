#pragma once
// What a straightness run begins with. As armed_run(), with the set-up of the optics.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/run/reading_rule.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_attachments.hpp"
#include "config/station_config.hpp"

#include <memory>
#include <optional>

namespace axiscal {

/// How the mirror stands: as was said at arming, else as the station file says.
/// @errors Fault::bad_request for a word that is no position of it.
Result<MirrorPosition> mirror_of(const StraightnessConfig& config, const ArmRequest& request);

/// The plan of the table under the pass of this kind, from the datum that was said at arming.
RunPlan plan_of_order(const StraightnessConfig& config, TestKind kind, const ArmRequest& request);

/// @param parts  of the kind that is armed, with the plan
/// @param eve    of the drift test that the table points to, if it does
/// @param other  of the run with the mirror in the other position, if there is one
/// @returns attachments.setup is a StraightnessSetup whatever the kind: another one takes it over
/// @errors as armed_run() and mirror_of().
Result<ArmedRun> armed_straightness(const RunHeaderParts& parts,
                                    const StraightnessConfig& config,
                                    const ArmRequest& request,
                                    const std::optional<FoundEve>& eve,
                                    std::optional<RecordedLine> other);

/// By which the points of a straightness or a squareness run are read, also of one that an earlier
/// daemon left: the range of the optics is that of the station file.
std::shared_ptr<const ReadingRule> reading_across(const StationConfig& station,
                                                  const RunAttachments& attachments);

} // namespace axiscal
