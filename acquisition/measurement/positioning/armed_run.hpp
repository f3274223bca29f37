#pragma once
// What a positioning run begins with: its pass, the header of its file, and what stands beside it.
// Reads the numbers of certificates, and what is stored for the run's id; no more I/O than that.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/run/reading_rule.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace axiscal {

struct ArmedRun {
    RunRecord header;
    RunAttachments attachments;
    std::shared_ptr<const ReadingRule> reading; ///< never null
    std::vector<PreflightRecord> checks;        ///< as they were judged
    bool datum_by_cnc = false;                  ///< its first command ties the datum
    std::function<bool()> orderer_has_gone;     ///< asked while the datum is sought; empty: stays
};

/// The pass that is asked for, drawn anew where the station file names no seed.
/// @errors those of plan_passes(); Fault::bad_request for a pass that is not planned.
Result<RunPlan> plan_for(const StationConfig& config, const ArmRequest& request);

/// @param parts  with the plan
/// @param eve    of positions: of the drift test that the station file points to, if it does
/// @returns the run with neither checks nor alignment, for nobody; read as positions
/// @errors those of make_run_header; Fault::refused for the number of another run's certificate.
Result<ArmedRun> armed_run(const RunHeaderParts& parts,
                           const ArmRequest& request,
                           const std::optional<FoundEve>& eve);

} // namespace axiscal
