// A person's answer to a finding about the set-up: kept in the file of the closed run, printed on
// its next certificate.
#include "acquisition/journal/journal.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

/// The kinds of "setup_findings" in the document of a positioning run; of other tests none.
std::vector<std::string> findings_in(const std::string& document) {
    std::vector<std::string> kinds;
    const auto parsed = nlohmann::json::parse(document, nullptr, false);
    if (!parsed.is_object() || !parsed.contains("setup_findings")) return kinds;
    for (const auto& found : parsed["setup_findings"])
        if (found.is_object() && found.contains("error") && found["error"].is_string())
            kinds.push_back(found["error"].get<std::string>());
    return kinds;
}

std::string listed(const std::vector<std::string>& kinds) {
    std::string text;
    for (const std::string& kind : kinds)
        text += (text.empty() ? "" : ", ") + kind;
    return text;
}

} // namespace

/// Only what the newest certificate says can be answered.
Task<Result<void>> PositioningMeasurement::finding_stands(std::string finding) {
    const std::string run_id = run_.run_id, path = run_.path;
    AXISCAL_CO_TRY(const RunSummary run, co_await context_.journal.summarize(path));
    if (!run.evaluated)
        co_return fail(Fault::busy, "run " + run_id + " has no certificate yet; ask again");
    const auto result = co_await context_.journal.stored_result(path);
    if (!result) co_return tl::unexpected<Error>(result.error());
    const auto kinds = findings_in(result->document);
    if (std::ranges::find(kinds, finding) != kinds.end()) co_return Result<void>{};
    if (kinds.empty())
        co_return fail(Fault::bad_request,
                       "the certificate of run " + run_id + " has no finding about the set-up");
    co_return fail(Fault::bad_request, "the certificate of run " + run_id + " has no finding '" +
                                           finding + "'; it has " + listed(kinds));
}

Task<Result<void>> PositioningMeasurement::answer_finding(AnswerRequest request) {
    if (auto stands = co_await finding_stands(request.finding); !stands) co_return stands;
    const Scheduler& scheduler = context_.scheduler;
    AnswerRecord answer{request.finding, scheduler.now(), scheduler.clock_tie().utc_ns,
                        request.text};
    OrderRecord order = order_now(scheduler, "answer", request.by, request.finding);
    auto kept =
        co_await context_.journal.reopen_closed(run_.path, std::move(answer), std::move(order));
    if (!kept) {
        if (kept.error().fault == Fault::not_durable) revision_unknown_ = true;
        co_return kept;
    }
    ++answers_;
    kept = co_await close_again();
    if (kept)
        note("The finding " + request.finding + " of run " + run_.run_id +
             " is answered: " + request.text + "; by " + name_of(request.by));
    co_return kept;
}

} // namespace axiscal
