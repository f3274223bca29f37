#include "acquisition/console/stored_run_json.hpp"

#include "acquisition/console/optional_json.hpp"
#include "analysis/quantity/time.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace axiscal {
namespace {

using RowJson = nlohmann::ordered_json;

/// An incomplete run has no verdict, whatever a paper of it says.
std::string verdict_of_row(const StoredRun& run) {
    return run.facts && run.status == StoredStatus::complete ? run.facts->verdict : "";
}

std::string started_of(const StoredRun& run) {
    if (run.facts && !run.facts->started_utc.empty()) return run.facts->started_utc;
    return run.summary ? iso8601_utc(run.summary->opened_utc_ns) : "";
}

} // namespace

nlohmann::ordered_json to_json(const StoredRun& run) {
    static const RunSummary nothing;
    static const CertificateFacts no_facts;
    const RunSummary& summary = run.summary ? *run.summary : nothing;
    const CertificateFacts& facts = run.facts ? *run.facts : no_facts;
    const bool judged = run.status == StoredStatus::complete && !facts.partial;
    RowJson figures = RowJson::array();
    for (const CertifiedFigure& figure : facts.figures)
        figures.push_back({{"parameter", figure.parameter},
                           {"value", or_null(figure.value)},
                           {"U", or_null(figure.expanded_uncertainty)},
                           {"limit", or_null(figure.limit)},
                           {"verdict", judged ? figure.verdict : std::string{}},
                           {"reason", figure.reason}});
    return {{"id", run.id},
            {"status", name_of(run.status)},
            {"sentence", run.sentence},
            {"kind", run.summary ? name_of(summary.kind) : std::string_view{}},
            {"axis", summary.axis},
            {"machine", summary.machine},
            {"machine_serial", summary.machine_serial},
            {"machine_state", summary.machine_state},
            {"started_utc", started_of(run)},
            {"points", summary.points},
            {"planned", summary.planned},
            {"left_out", facts.left_out},
            {"verdict", verdict_of_row(run)},
            {"limits", facts.limits},
            {"rule", facts.rule},
            {"standard", facts.standard},
            {"unit", facts.unit},
            {"figures", std::move(figures)},
            {"paper", name_of(run.paper)},
            {"paper_sentence", run.paper_sentence},
            {"number", facts.number}};
}

nlohmann::ordered_json runs_json(const RunsPage& page) {
    RowJson rows = RowJson::array();
    for (const StoredRun& run : page.runs)
        rows.push_back(to_json(run));
    return {{"runs", std::move(rows)}, {"next", page.next}, {"passed_over", page.passed_over}};
}

std::string run_with_papers_text(const RunWithPapers& found) {
    RowJson body = to_json(found.run);
    body["papers"] = RowJson::array();
    for (const PaperFile& paper : found.papers)
        body["papers"].push_back({{"name", paper.name}, {"bytes", paper.bytes}});
    std::string text = json_text(body);
    text.back() = ','; // the certificate is the last member, untouched
    text += "\"certificate\":";
    text += found.certificate.empty() ? "null" : found.certificate;
    return text += "}\n";
}

} // namespace axiscal
