#pragma once
// Everything that can be proved of a run file: its chain, its figures computed anew, and the
// certificate that was made of it. Reads only.

#include "acquisition/journal/run_file_verify.hpp"

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
    std::string certificate;                 ///< path; empty: none was held against the run
    std::vector<CertificateFinding> certificate_findings;
    [[nodiscard]] bool intact() const {
        return chain.intact() && !wrong_result && certificate_findings.empty();
    }
};

/// `certificate` empty: certificate.json beside the run file where it is of the same run, else
/// none. The figures of a damaged file are not computed.
/// @errors Fault::not_found; Fault::bad_run_file; Fault::bad_case for a certificate that is none.
Result<VerifyReport> verify_run(const std::string& run_file, const std::string& certificate = {});

nlohmann::ordered_json to_json(const VerifyReport& report);
/// One line each finding, a verdict last.
std::string to_text(const VerifyReport& report);

} // namespace axiscal
