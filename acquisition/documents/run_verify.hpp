#pragma once
// Everything that can be proved of a run file: its chain, its figures computed anew, and the
// certificate that was made of it. Reads only.

#include "acquisition/runfile/run_file_verify.hpp"
#include "acquisition/runfile/run_signature.hpp"
#include "analysis/record/imported_readings.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// A figure or a mark of the certificate that is not what the run file gives.
struct CertificateFinding {
    std::string place; ///< "/parameters/A/value"
    std::string sentence;
};

struct VerifyReport {
    std::string run_file, run_id, file_sha256;
    ChainReport chain;
    std::string result_digest;               ///< computed now; empty where there are no figures
    std::optional<std::string> no_figures;   ///< why none could be computed
    std::optional<std::string> wrong_result; ///< the stored result is not what is computed now
    std::optional<ImportedReadings> imported; ///< where its figures come from, if not from here
    std::string certificate;                 ///< path; empty: none was held against the run
    std::vector<CertificateFinding> certificate_findings;
    SignatureReport signature;
    AnchorReport anchor;
    [[nodiscard]] bool run_file_intact() const {
        return chain.intact() && !wrong_result && signature.verdict != SignatureVerdict::bad &&
               anchor.verdict != AnchorVerdict::differs;
    }
    [[nodiscard]] bool intact() const { return run_file_intact() && certificate_findings.empty(); }
};

/// What the run file is held against: paths; an empty one is left out, but for a certificate.json
/// beside the run file where that is of the same run.
struct VerifyAgainst {
    std::string certificate;
    std::string public_keys; ///< PEM, one or more, that came by another way than the run file
    std::string receipt;     ///< of the publisher
};

/// The figures of a damaged file are not computed.
/// @errors Fault::not_found; Fault::bad_run_file; Fault::bad_case for a certificate, a key or a
/// receipt that is none.
Result<VerifyReport> verify_run(const std::string& run_file, const VerifyAgainst& against = {});

nlohmann::ordered_json to_json(const VerifyReport& report);
/// One line each finding, a verdict last.
std::string to_text(const VerifyReport& report);

} // namespace axiscal
