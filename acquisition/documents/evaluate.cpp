#include "acquisition/documents/evaluate.hpp"

#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/paper_identity.hpp"
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "config/json_text.hpp"

#include <utility>
#include <variant>

namespace axiscal {
namespace {

/// Why figures are no longer those of the first evaluation.
std::string differs_from(const std::string& software_version) {
    return "; this program computes differently from version " + software_version;
}

/// By the paper of its kind: the first of TestResult's from `index` on.
template <std::size_t index = 0>
Result<TestResult> computed(const std::string& path, RunFileContents contents) {
    using Test = std::variant_alternative_t<index, TestResult>;
    if (contents.run.kind == PaperOf<Test>::kind) {
        AXISCAL_TRY(Test made, PaperOf<Test>::evaluated(path, std::move(contents)));
        return TestResult{std::move(made)};
    }
    if constexpr (index + 1 < std::variant_size_v<TestResult>)
        return computed<index + 1>(path, std::move(contents));
    else
        return fail(Fault::bad_run_file, path + " holds a test of a kind that has no paper: " +
                                             std::string{name_of(contents.run.kind)});
}

template <class Test> std::string& number_in(Test& one) {
    if constexpr (requires { one.run; })
        return one.run.statements.certificate_number;
    else
        return one.measured.run.statements.certificate_number;
}

tl::unexpected<Error> no_certificate(const std::string& closing_reason) {
    return fail(Fault::incomplete_run,
                "no certificate is issued of a run that was not closed as complete (" +
                    closing_reason +
                    "); 'axiscal analyze' and 'axiscal export' give its partial result");
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

/// A paper without a number has no `replaces` either.
void name_paper(TestResult& result, const PaperIdentity& identity) {
    std::visit(
        [&](auto& one) {
            if constexpr (requires { one.replaces; }) {
                number_in(one) = identity.number;
                one.replaces = identity.replaces;
                if (!identity.replaces.empty()) one.remarks.push_back(amendment_remark(identity));
            }
        },
        result);
}

} // namespace

Result<TestResult> evaluate_run_file(const std::string& path, const Issue* issue) {
    AXISCAL_TRY(std::string sha256, sha256_of_file(path));
    AXISCAL_TRY(RunFileContents contents, read_run_file_contents(path));
    const PaperOfRun paper = paper_of(contents);
    const std::string version = contents.run.software_version;
    const std::string closing_reason = contents.run.closing_reason;
    AXISCAL_TRY(TestResult result, computed(path, std::move(contents)));
    if (is_partial(result)) { // is neither stored nor numbered, whatever the file held before
        if (issue != nullptr) return no_certificate(closing_reason);
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
