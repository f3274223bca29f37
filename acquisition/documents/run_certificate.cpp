#include "acquisition/documents/run_certificate.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/documents/circular/circular_json.hpp"
#include "acquisition/documents/circular/circular_run_file.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/paper_identity.hpp"
#include "acquisition/documents/result_digest.hpp"
#include "acquisition/documents/positioning/result_json.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

tl::unexpected<Error> still_open(const std::string& run_file) {
    return fail(Fault::incomplete_run, run_file + " is still open: close the run first");
}

tl::unexpected<Error> no_certificate(const RunRecord& run) {
    return fail(Fault::incomplete_run,
                "no certificate is issued of a run that was not closed as complete (" +
                    run.closing_reason +
                    "); 'axiscal analyze' and 'axiscal export' give its partial result");
}

/// Why figures are no longer those of the first evaluation.
std::string differs_from(const std::string& software_version) {
    return "; this program computes differently from version " + software_version;
}

Json circular_figures_of(const CircularCertificate& certificate) {
    return circular_to_json({certificate.measured.test, certificate.measured.axes,
                             certificate.parameters, certificate.diagnosis, certificate.budget});
}

/// What was evaluated just now.
struct FirstResult {
    std::string digest;
    Json document;
    int year = 0; ///< in which the certificate is issued
};

int year_in(const std::string& iso_date) {
    constexpr std::size_t digits = 4;
    int year = 0;
    for (const char digit : iso_date.substr(0, digits))
        year = 10 * year + (digit - '0');
    return year;
}

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

Result<FirstResult> first_result_of(const std::string& run_file) {
    AXISCAL_TRY(const RunSummary run, summarize_run_file(run_file));
    if (run.kind != TestKind::circular) {
        AXISCAL_TRY(const Certificate certificate, certificate_of_run_file(run_file));
        if (certificate.completeness.partial()) return no_certificate(certificate.run);
        return FirstResult{certificate.result_digest, result_to_json(certificate.result),
                           year_in(certificate.finished_utc)};
    }
    AXISCAL_TRY(const CircularCertificate certificate, circular_certificate_of_run_file(run_file));
    return FirstResult{certificate.result_digest, circular_figures_of(certificate),
                       year_in(certificate.measured.finished_utc)};
}

} // namespace

Result<Certificate> certificate_of_run_file(const std::string& run_file) {
    AXISCAL_TRY(std::string sha256, sha256_of_file(run_file));
    AXISCAL_TRY(RunFileContents contents, read_run_file_contents(run_file));
    if (contents.run.kind == TestKind::drift)
        return fail(Fault::refused, run_file + " is a drift test: it has no points");
    if (contents.run.kind == TestKind::probing)
        return fail(Fault::refused, run_file + " is a probing test: it has no points");
    AXISCAL_TRY(const PaperIdentity identity, identity_of(run_file, contents));
    if (!contents.closed) take_as_open(contents.run);
    AXISCAL_TRY(Certificate certificate,
                make_certificate(std::move(contents.run), std::move(contents.revisions),
                                 std::move(sha256)));
    certificate.attachments = std::move(contents.attachments);
    if (!certificate.attachments.eve_source.empty())
        certificate.remarks.push_back(source_of_eve(certificate));
    certificate.result_digest = result_digest(certificate.result);
    const auto document = [&certificate] { return result_to_json(certificate.result); };
    // No partial result is stored or bears a number; of a run that is open again, what it held before is.
    if (certificate.completeness.partial()) return certificate;
    certificate.run.statements.certificate_number = identity.number;
    certificate.replaces = identity.replaces;
    if (!identity.replaces.empty()) certificate.remarks.push_back(amendment_remark(identity));
    // A run that was added to is evaluated anew: the stored result is of what it held before.
    if (contents.results < certificate.revisions.closings) return certificate;
    AXISCAL_TRY(certificate.result_digest,
                standing_digest(
                    run_file, {certificate.result_digest, agreement_of(certificate.run), document},
                    differs_from(certificate.run.software_version)));
    return certificate;
}

Result<CircularCertificate> circular_certificate_of_run_file(const std::string& run_file) {
    AXISCAL_TRY(std::string sha256, sha256_of_file(run_file));
    AXISCAL_TRY(const RunFileContents contents, read_run_file_contents(run_file));
    if (!contents.closed) return still_open(run_file);
    AXISCAL_TRY(CircularRun run, circular_run_of(contents));
    AXISCAL_TRY(const PaperIdentity identity, identity_of(run_file, contents));
    run.statements.certificate_number = identity.number;
    AXISCAL_TRY(CircularMeasurement measured, measurement_of(std::move(run)));
    AXISCAL_TRY(CircularCertificate certificate,
                evaluate_measurement(std::move(measured), std::move(sha256)));
    certificate.replaces = identity.replaces;
    if (!identity.replaces.empty()) certificate.remarks.push_back(amendment_remark(identity));
    certificate.result_digest = result_digest(certificate.parameters);
    if (contents.results < contents.revisions.closings) return certificate;
    const auto document = [&certificate] { return circular_figures_of(certificate); };
    AXISCAL_TRY(certificate.result_digest,
                standing_digest(run_file,
                                {certificate.result_digest, rounding_of_the_library, document},
                                differs_from(certificate.measured.run.software_version)));
    return certificate;
}

Result<void> seal_result(const std::string& run_file, const Issue& issue) {
    AXISCAL_TRY(const RunFileContents contents, read_run_file_contents(run_file));
    if (contents.closed && contents.results >= contents.revisions.closings) return {};
    AXISCAL_TRY(FirstResult result, first_result_of(run_file));
    AXISCAL_TRY(const PaperIdentity identity,
                new_identity(run_file, contents, issue.state_directory, result.year));
    result.document["certificate"] = identity_json(identity);
    return store_result(run_file, {result.digest, json_text(result.document)}, issue.key);
}

} // namespace axiscal
