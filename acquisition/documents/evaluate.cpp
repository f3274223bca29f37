#include "acquisition/documents/evaluate.hpp"

#include "acquisition/documents/circular/circular_run_file.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/paper_identity.hpp"
#include "acquisition/documents/positioning/positioning_run_file.hpp"
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "config/json_text.hpp"

namespace axiscal {
namespace {

/// Why figures are no longer those of the first evaluation.
std::string differs_from(const std::string& software_version) {
    return "; this program computes differently from version " + software_version;
}

/// The one place outside a kind's own folder that asks which kind a run is.
Result<TestResult> computed(const std::string& path, RunFileContents contents) {
    switch (contents.run.kind) {
    case TestKind::circular: {
        AXISCAL_TRY(CircularCertificate made, circular_certificate_of(path, contents));
        return TestResult{std::move(made)};
    }
    case TestKind::drift: {
        AXISCAL_TRY(DriftResult made, drift_result_of(path, std::move(contents)));
        return TestResult{std::move(made)};
    }
    case TestKind::probing: {
        AXISCAL_TRY(ProbingResult made, probing_result_of(path, std::move(contents)));
        return TestResult{std::move(made)};
    }
    case TestKind::positioning: break;
    }
    AXISCAL_TRY(Certificate made, certificate_of(std::move(contents)));
    return TestResult{std::move(made)};
}

bool is_partial(const TestResult& result) {
    const auto* positioning = std::get_if<Certificate>(&result);
    return positioning != nullptr && positioning->completeness.partial();
}

tl::unexpected<Error> no_certificate(const RunRecord& run) {
    return fail(Fault::incomplete_run,
                "no certificate is issued of a run that was not closed as complete (" +
                    run.closing_reason +
                    "); 'axiscal analyze' and 'axiscal export' give its partial result");
}

/// In which the certificate is issued; empty of a test whose paper gets no number.
std::string finished_utc_of(const TestResult& result) {
    if (const auto* positioning = std::get_if<Certificate>(&result))
        return positioning->finished_utc;
    const auto* circular = std::get_if<CircularCertificate>(&result);
    return circular != nullptr ? circular->measured.finished_utc : std::string{};
}

int year_in(const std::string& iso_date) {
    constexpr std::size_t digits = 4;
    int year = 0;
    for (const char digit : iso_date.substr(0, digits))
        year = 10 * year + (digit - '0');
    return year;
}

/// Stores the result; what is printed of it afterwards bears the number that it took.
Result<PaperIdentity> store_first(const std::string& path,
                                  const TestResult& result,
                                  const PaperOfRun& paper,
                                  const Issue& issue) {
    nlohmann::ordered_json figures = stored_figures_of(result);
    PaperIdentity identity;
    if (const std::string finished = finished_utc_of(result); !finished.empty()) {
        AXISCAL_TRY(identity, new_identity(path, paper, issue.state_directory, year_in(finished)));
        figures["certificate"] = identity_json(identity);
    }
    AXISCAL_CHECK(store_result(path, {digest_of(result), json_text(figures)}, issue.key));
    return identity;
}

void name_paper(TestResult& result, const PaperIdentity& identity) {
    const auto name = [&](auto& certificate, auto& run) {
        run.statements.certificate_number = identity.number;
        certificate.replaces = identity.replaces;
        if (!identity.replaces.empty()) certificate.remarks.push_back(amendment_remark(identity));
    };
    if (auto* positioning = std::get_if<Certificate>(&result)) name(*positioning, positioning->run);
    if (auto* circular = std::get_if<CircularCertificate>(&result))
        name(*circular, circular->measured.run);
}

} // namespace

Result<TestResult> evaluate_run_file(const std::string& path, const Issue* issue) {
    AXISCAL_TRY(std::string sha256, sha256_of_file(path));
    AXISCAL_TRY(RunFileContents contents, read_run_file_contents(path));
    const PaperOfRun paper = paper_of(contents);
    const std::string version = contents.run.software_version;
    AXISCAL_TRY(TestResult result, computed(path, std::move(contents)));
    if (is_partial(result)) { // is neither stored nor numbered, whatever the file held before
        if (issue != nullptr) return no_certificate(std::get<Certificate>(result).run);
        set_file_sha256(result, std::move(sha256));
        return result;
    }
    PaperIdentity identity;
    if (issue != nullptr && !paper.stored()) {
        AXISCAL_TRY(identity, store_first(path, result, paper, *issue));
        AXISCAL_TRY(sha256, sha256_of_file(path));
    } else {
        AXISCAL_TRY(identity, identity_of(path, paper));
    }
    if (paper.stored()) {
        AXISCAL_TRY(std::string digest,
                    standing_digest(path,
                                    {digest_of(result), agreement_of(result),
                                     [&result] { return stored_figures_of(result); }},
                                    differs_from(version)));
        set_digest(result, std::move(digest));
    }
    name_paper(result, identity);
    set_file_sha256(result, std::move(sha256));
    return result;
}

} // namespace axiscal
