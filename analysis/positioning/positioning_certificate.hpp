#pragma once
// Everything a certificate prints, computed once from a closed run. Rendering only formats it.
// Pure.

#include "analysis/conformity/conformity.hpp"
#include "analysis/positioning/chosen_standards.hpp"
#include "analysis/positioning/completeness.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/compensation/thermal_compensation.hpp"
#include "analysis/setup/setup_findings.hpp"
#include "analysis/uncertainty/run_uncertainty.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct EnvironmentSummary {
    std::string channel, place;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    double correction = 0; ///< already in every value
    bool by_table = false; ///< the correction is that of a ChannelCalibration's table instead
    int readings = 0;
    double first = 0, last = 0, minimum = 0, maximum = 0; ///< all in stored_unit_of(kind)
};

struct EnvironmentTrace { ///< for the plot: seconds since the first point, value
    std::string channel;
    ChannelKind kind = ChannelKind::temperature;
    Medium medium = Medium::none;
    std::vector<double> seconds, values;
};

struct Certificate {
    /// As read from the file (samples may be dropped), its times told by one clock (run_clock.hpp).
    RunRecord run;
    PositioningResult result;
    RunAt20C deviations;
    CompensationSummary compensation;
    std::vector<EnvironmentSummary> environment;
    std::vector<EnvironmentTrace> traces;
    std::string run_file_sha256; ///< of the closed file
    /// SHA-256 (lower-case hex) of canonical_bytes(result). Left empty by make_certificate(),
    /// because the analysis links no hash: filled by the caller
    /// (acquisition/documents/result_digest.hpp).
    std::string result_digest;
    std::string started_utc, finished_utc, issued_on,
        next_due;            ///< from the run, never from the clock
    bool preliminary = true; ///< `uncertainty.missing` is not empty: printed on each page
    std::vector<std::string> remarks;
    RunUncertainty uncertainty;
    RunRevisions revisions;
    std::vector<SetAside> set_aside; ///< drawn, listed and counted; in no figure
    /// Partial: the statements then bear no certificate number, nothing falls due, no target of U
    /// is judged.
    Completeness completeness;
    std::vector<double> planned_targets; ///< all of the plan, also those in no figure: mm or deg
    RunAttachments attachments;      ///< of the same file; left empty by make_certificate()
    /// The certificate that this one replaces; left empty by make_certificate(), and for the first.
    std::string replaces = {};
    /// By the other standards that were chosen; none of a partial result.
    std::vector<OtherResult> others = {};
    /// Of a complete result with limits.
    std::optional<Conformity> conformity = {};
    /// Of a complete result of a linear axis; also the last of `remarks`.
    std::vector<SetupFinding> setup_findings = {};
};

/// The whole road from a run to its certificate. Of a run that was not closed as complete
/// (RunRecord::complete) to its partial result: each target and direction counts with the n
/// readings it has.
/// @errors those of compensate_to_20C(): Fault::incomplete_run where no figure can be made.
Result<Certificate> make_certificate(RunRecord run, std::string run_file_sha256);
Result<Certificate>
make_certificate(RunRecord run, RunRevisions revisions, std::string run_file_sha256);

/// A result against other limits than those of its run; `travel` left out: what the targets of the
/// plan reach over. Nothing of a partial result, which has no verdict.
std::optional<Conformity> conformity_of(const Certificate& certificate,
                                        const std::optional<ToleranceRecord>& limits,
                                        std::optional<double> travel = {});

/// Every figure of the result in one fixed order, so that equal figures give equal bytes anywhere:
/// the text "axiscal.canonical/1"; k and n; A, A_forward, A_backward, E, E_forward, E_backward, M,
/// R, R_forward, R_backward, B, B_mean; m; then per target: target, mean_forward, mean_backward,
/// mean, B, s_forward, s_backward, R_forward, R_backward, R. Each figure is a byte 1 and the eight
/// IEEE-754 bytes, least significant first; an absent one is a byte 0. Counts are figures too.
/// The journal stores the hash of these bytes when a run is evaluated; recomputing must meet it.
std::vector<std::byte> canonical_bytes(const PositioningResult& result);

} // namespace axiscal
