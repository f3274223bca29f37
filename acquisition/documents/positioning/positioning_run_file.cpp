#include "acquisition/documents/positioning/positioning_run_file.hpp"

#include "acquisition/documents/result_digest.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// Also of a run that is open again, whose earlier closing no longer says what it holds.
void take_as_open(RunRecord& run) {
    run.complete = false;
    run.closing_reason = "the run is still open";
    run.closed = {};
}

/// With its length and place, where the pre-flight check told them.
std::string source_of_eve(const Certificate& certificate) {
    const auto& checks = certificate.revisions.preflight;
    const auto check = std::ranges::find(checks, "eve", &PreflightRecord::name);
    if (check != checks.end()) return check->verdict;
    return "E_VE is the range of the drift test " + certificate.attachments.eve_source + ".";
}

} // namespace

Result<Certificate> certificate_of(RunFileContents contents) {
    if (!contents.closed) take_as_open(contents.run);
    AXISCAL_TRY(Certificate certificate,
                make_certificate(std::move(contents.run), std::move(contents.revisions), {}));
    certificate.attachments = std::move(contents.attachments);
    if (!certificate.attachments.eve_source.empty())
        certificate.remarks.push_back(source_of_eve(certificate));
    certificate.result_digest = result_digest(certificate.result);
    return certificate;
}

} // namespace axiscal
