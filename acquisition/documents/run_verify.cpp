#include "acquisition/documents/run_verify.hpp"

#include "acquisition/documents/evaluate.hpp"
#include "acquisition/documents/figure_agreement.hpp"
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/receipt.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/schema.hpp"
#include "config/json_text.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

/// What a certificate says of the run. The rest of its document (words, summaries of the
/// environment) may be told in another way by a later version.
constexpr std::array computed_places{
    "/parameters", "/positions", "/expanded_uncertainty", "/run/deviations",
    "/zones",      "/repeats",   "/run/circles",          "/run/synchronisation"};
/// What it only repeats, and what names it: the same, whatever the figures may differ by.
constexpr std::array repeated_places{"/standard",
                                     "/certificate",
                                     "/unit",
                                     "/run/id",
                                     "/run/plan",
                                     "/run/bar",
                                     "/run/config_sha256",
                                     "/run/datums",
                                     "/run/imported",
                                     "/run/result_digest",
                                     "/run/run_file_sha256"};

Result<Json> read_certificate(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file || std::filesystem::is_directory(path))
        return fail(Fault::not_found, "cannot read " + path);
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    Json document = Json::parse(text, nullptr, false);
    const Json::json_pointer id{"/run/id"};
    if (!document.is_object() || !document.contains(id) || !document[id].is_string())
        return fail(Fault::bad_case, path + " is no certificate.json of a run");
    return document;
}

/// The certificate to hold against the run: the one named, or the one beside it, if it is its own.
Result<std::optional<Json>>
certificate_for(const std::string& run_file, const std::string& run_id, std::string& path) {
    if (!path.empty()) {
        AXISCAL_TRY(Json document, read_certificate(path));
        return std::optional{std::move(document)};
    }
    const std::string beside = folder_of(run_file) + "/certificate.json";
    std::error_code error;
    if (!std::filesystem::is_regular_file(beside, error)) return std::optional<Json>{};
    auto document = read_certificate(beside);
    if (document && (*document)["run"]["id"] != run_id) return std::optional<Json>{};
    path = beside;
    if (!document) return tl::unexpected<Error>(document.error());
    return std::optional{*std::move(document)};
}

std::string shown(const Json& value) {
    constexpr std::size_t longest = 80;
    const std::string text = json_text(value);
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

/// One place of the certificate against the same of the document due.
void compare_at(const char* text,
                const Json& printed,
                const Json& right,
                const FigureAgreement& agreement,
                VerifyReport& report) {
    const Json::json_pointer place{text};
    const Json there = printed.contains(place) ? printed[place] : Json{};
    const Json due = right.contains(place) ? right[place] : Json{};
    for (const std::string& step : disagreements(there, due, agreement)) {
        const std::string where = text + step;
        const Json::json_pointer at{step};
        report.certificate_findings.push_back(
            {where, where + " says " + (there.contains(at) ? shown(there[at]) : "nothing") +
                        ", the run file gives " + (due.contains(at) ? shown(due[at]) : "nothing")});
    }
}

void compare(const Json& printed,
             const Json& right,
             const FigureAgreement& agreement,
             VerifyReport& report) {
    for (const char* place : computed_places)
        compare_at(place, printed, right, agreement, report);
    for (const char* place : repeated_places)
        compare_at(place, printed, right, same_bits, report);
}

/// Without figures the marks that need none are held: the file's own hash, the run, the datums.
Json marks_of(const VerifyReport& report, const Json& printed) {
    Json right = printed;
    right["run"]["id"] = report.run_id;
    right["run"]["run_file_sha256"] = report.file_sha256;
    return right;
}

Json findings_json(const ChainReport& chain) {
    Json list = Json::array();
    for (const RowFinding& finding : chain.findings)
        list.push_back({{"table", finding.table.empty() ? Json{} : Json(finding.table)},
                        {"row", finding.link},
                        {"what", name_of(finding.damage)},
                        {"about", finding.row.empty() ? Json{} : Json(finding.row)},
                        {"sentence", finding.sentence}});
    return list;
}

std::string state_text(const ChainReport& chain) {
    if (!chain.closed) return "the run is still open";
    return chain.complete ? "the run is complete" : "the run was closed as incomplete";
}

} // namespace

namespace {

Result<std::vector<PublicKey>> keys_from(const std::string& path) {
    if (path.empty()) return std::vector<PublicKey>{};
    std::ifstream file{path, std::ios::binary};
    if (!file || std::filesystem::is_directory(path))
        return fail(Fault::not_found, "cannot read " + path);
    auto keys = public_keys_of(std::string{std::istreambuf_iterator<char>{file}, {}});
    if (!keys) return fail(keys.error().fault, path + ": " + keys.error().detail);
    return keys;
}

/// What came by another way than the file: whose key signed it, and what was said of it before.
Result<void> hold_against(const VerifyAgainst& against, VerifyReport& report) {
    AXISCAL_TRY(const auto keys, keys_from(against.public_keys));
    AXISCAL_TRY(report.signature, check_signatures(report.run_file, keys));
    if (report.signature.verdict == SignatureVerdict::good && !report.chain.intact())
        report.signature = {SignatureVerdict::bad,
                            "rows of the file are not those that were signed"};
    report.anchor.sentence = "--receipt was not given";
    if (against.receipt.empty()) return {};
    AXISCAL_TRY(report.anchor,
                compare_with_receipt(report.run_file, report.file_sha256, against.receipt));
    return {};
}

} // namespace

Result<VerifyReport> verify_run(const std::string& run_file, const VerifyAgainst& against) {
    VerifyReport report;
    report.run_file = run_file;
    AXISCAL_TRY(report.chain, verify_chain(run_file));
    AXISCAL_TRY(report.file_sha256, sha256_of_file(run_file));
    AXISCAL_TRY(const RunSummary summary, summarize_run_file(run_file));
    report.run_id = summary.run_id;
    report.certificate = against.certificate;
    AXISCAL_CHECK(hold_against(against, report));
    AXISCAL_TRY(const auto printed, certificate_for(run_file, report.run_id, report.certificate));
    std::optional<TestResult> right;
    if (!report.chain.intact()) {
        report.no_figures = "rows are not what they were";
    } else if (!report.chain.closed) {
        report.no_figures = state_text(report.chain);
    } else if (auto made = evaluate_run_file(run_file)) {
        right = *std::move(made);
        if (const auto* positioning = std::get_if<Certificate>(&*right))
            report.imported = positioning->run.imported;
        report.result_digest = digest_of(*right);
    } else if (const auto stored = read_stored_result(run_file)) {
        report.wrong_result = describe(made.error());
    } else {
        report.no_figures = describe(made.error());
    }
    if (printed && right) compare(*printed, json_of(*right), agreement_of(*right), report);
    if (printed && !right) compare(*printed, marks_of(report, *printed), same_bits, report);
    return report;
}

nlohmann::ordered_json to_json(const VerifyReport& report) {
    Json document;
    document["run_file"] = report.run_file;
    document["run_id"] = report.run_id;
    document["sha256"] = report.file_sha256;
    document["intact"] = report.intact();
    document["format"] = run_file_version;
    document["closed"] = report.chain.closed;
    document["complete"] = report.chain.complete;
    document["links"] = report.chain.links;
    document["chain_head"] = report.chain.chain_head;
    for (const auto& [table, count] : report.chain.rows)
        document["rows"][table] = count;
    document["findings"] = findings_json(report.chain);
    document["findings_untold"] = report.chain.untold;
    document["result_digest"] = report.result_digest.empty() ? Json{} : Json(report.result_digest);
    document["no_figures"] = report.no_figures ? Json(*report.no_figures) : Json{};
    document["wrong_result"] = report.wrong_result ? Json(*report.wrong_result) : Json{};
    document["imported"] = report.imported.has_value();
    document["certificate"] = report.certificate.empty() ? Json{} : Json(report.certificate);
    document["certificate_findings"] = Json::array();
    for (const auto& [place, sentence] : report.certificate_findings)
        document["certificate_findings"].push_back({{"place", place}, {"sentence", sentence}});
    document["signature"] = name_of(report.signature.verdict);
    document["signature_sentence"] = report.signature.sentence;
    document["anchor"] = name_of(report.anchor.verdict);
    document["anchor_sentence"] = report.anchor.sentence;
    return document;
}

namespace {

std::string name_with_article(SignatureVerdict verdict) {
    return verdict == SignatureVerdict::unknown_key ? "of an unknown key"
                                                    : std::string{name_of(verdict)};
}

} // namespace

std::string to_text(const VerifyReport& report) {
    std::string text;
    const auto line = [&](const std::string& words) { text += words + "\n"; };
    for (const RowFinding& finding : report.chain.findings)
        line(finding.sentence);
    if (report.chain.untold > 0) line("... and " + std::to_string(report.chain.untold) + " more");
    if (report.wrong_result) line(*report.wrong_result);
    for (const CertificateFinding& finding : report.certificate_findings)
        line(report.certificate + ": " + finding.sentence);
    if (report.signature.verdict == SignatureVerdict::bad)
        line("signature bad: " + report.signature.sentence);
    if (report.anchor.verdict == AnchorVerdict::differs)
        line("anchor differs: " + report.anchor.sentence);
    if (!report.run_file_intact()) {
        line(report.run_file + " is NOT what was written.");
        return text;
    }
    if (!report.certificate_findings.empty())
        line(report.certificate + " does NOT say what the run file gives.");
    line(report.run_file + ": " + std::to_string(report.chain.links) +
         " rows, each as it was written; " + state_text(report.chain) + ".");
    if (report.imported)
        line("  imported, readings by others: " + report.imported->file + ", SHA-256 " +
             report.imported->sha256 + "; no station measured them");
    line("  chain   " + report.chain.chain_head);
    line("  file    " + report.file_sha256);
    line(report.result_digest.empty() ? "  figures none: " + report.no_figures.value_or("")
                                      : "  figures " + report.result_digest + ", computed anew");
    if (report.certificate.empty())
        line("  no certificate.json beside it was held against it");
    else if (report.certificate_findings.empty())
        line("  " + report.certificate + " says the same");
    line("  signature " + name_with_article(report.signature.verdict) + ": " +
         report.signature.sentence);
    line("  anchor " + std::string{name_of(report.anchor.verdict)} + ": " + report.anchor.sentence);
    return text;
}

} // namespace axiscal
