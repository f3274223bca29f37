#pragma once
// A closed drift test as the documents that leave the station. Pure.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/conformity/conformity.hpp"
#include "analysis/drift/run_drift.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// What a drift test gave.
struct DriftResult {
    RunRecord run;
    RunAttachments attachments;
    std::vector<OrderRecord> orders; ///< who began it
    RunDrift drift;
    std::optional<Conformity> conformity; ///< of a test with limits
    std::string run_file_sha256, result_digest;
};

/// Computes everything of a run file that was read; without its hash.
/// @errors Fault::incomplete_run naming `path` for an open run; those of evaluate_drift().
Result<DriftResult> drift_result_of(const std::string& path, RunFileContents contents);

/// What is stored at the first evaluation.
nlohmann::ordered_json drift_figures(const RunDrift& drift);

/// "ISO 230-2 E_VE, ISO 230-3 ETVE"; E_VE of a ballbar is that of ISO/TR 230-9.
std::string drift_standards(const RunDrift& drift);
/// By which paper a later budget takes E_VE: "ISO 230-2 annex A", of a rotary axis "after" it, of a
/// ballbar "ISO/TR 230-9".
std::string drift_budget_by(const DriftResult& document);

nlohmann::ordered_json drift_to_json(const DriftResult& document);
/// Every reading: channel, unit, minute, value. Lengths as change against the first, in um. Then
/// the figures of each channel: "# range" | "# slope_per_h" | "# E_VE", channel, unit, value.
std::string drift_csv(const DriftResult& document);

} // namespace axiscal
