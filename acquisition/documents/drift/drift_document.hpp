#pragma once
// A closed drift test as the documents that leave the station. Pure, but for reading the run file.

#include "acquisition/runfile/ed25519.hpp"
#include "analysis/drift/run_drift.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

struct DriftDocument {
    RunRecord run;
    RunAttachments attachments;
    std::vector<OrderRecord> orders; ///< who began it
    RunDrift drift;
    std::string run_file_sha256, result_digest;
};

/// Reads and verifies the run file and computes everything, as certificate_of_run_file does.
/// @errors Fault::refused when it is no drift test; Fault::incomplete_run; Fault::bad_run_file,
/// also for figures that are not those stored; Fault::not_found.
Result<DriftDocument> drift_of_run_file(const std::string& run_file);

/// The first evaluation: stores digest and figures in the closed run file, once; signed by `key`.
Result<void> seal_drift(const std::string& run_file, const SecretKey* key = nullptr);

/// "ISO 230-2 E_VE, ISO 230-3 ETVE"; E_VE of a ballbar is that of ISO/TR 230-9.
std::string drift_standards(const RunDrift& drift);
/// By which paper a later budget takes E_VE: "ISO 230-2 annex A", of a rotary axis "annex B", of a
/// ballbar "ISO/TR 230-9".
std::string drift_budget_by(const DriftDocument& document);

nlohmann::ordered_json drift_to_json(const DriftDocument& document);
std::string drift_json_text(const DriftDocument& document);
/// Every reading: channel, unit, minute, value. Lengths as change against the first, in um. Then
/// the figures of each channel: "# range" | "# slope_per_h" | "# E_VE", channel, unit, value.
std::string drift_csv(const DriftDocument& document);

} // namespace axiscal
