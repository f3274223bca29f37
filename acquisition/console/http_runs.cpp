#include "acquisition/console/http_runs.hpp"

#include "acquisition/console/stored_run_json.hpp"

#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <utility>

namespace axiscal {
namespace {

namespace runs_http = boost::beast::http;

constexpr long large_answers = 4; // of 32 MiB at most
/// A disk that takes longer hangs: published may lead to one that is away.
constexpr auto longest_look = std::chrono::seconds{20};

/// What a page may do applies to its papers, too: none runs a script, none lies in a frame.
void set_paper_fields(HttpResponse& response, const PaperBytes& paper) {
    const bool pdf = paper.type == "application/pdf";
    // A browser's own viewer of PDF is kept from working by default-src 'none'.
    response.set("Content-Security-Policy",
                 pdf ? "frame-ancestors 'none'" : "default-src 'none'; frame-ancestors 'none'");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    // The name is an id: nothing in it needs an escape.
    response.set(runs_http::field::content_disposition, std::string{pdf ? "inline" : "attachment"} +
                                                            "; filename=\"" + paper.file_name +
                                                            "\"");
}

bool is_closed_state(const std::string& state) {
    return state == "complete" || state == "incomplete";
}

std::string id_of_path(const std::string& file) {
    return std::filesystem::path{file}.stem().string();
}

HttpResponse no_seat(const HttpRequest& request) {
    return answer_in_words(request, runs_http::status::service_unavailable,
                           "four large answers are under way: ask again in a moment");
}

/// What is thrown on the thread would end the daemon.
template <class T>
Result<T> guarded(RunHistory& history, const std::function<Result<T>(RunHistory&)>& job) {
    try {
        return job(history);
    } catch (const std::exception& bug) {
        return fail(Fault::internal, std::string{"this request ended with: "} + bug.what());
    }
}

} // namespace

RunsDoor::RunsDoor(Scheduler& scheduler, StationInterface& station)
    : scheduler_{scheduler}
    , station_{station}
    , seats_{std::make_shared<const int>(0)} {}

void RunsDoor::show(std::string state_directory) {
    history_ = std::make_shared<RunHistory>(std::move(state_directory));
}

void RunsDoor::stop() {
    stopped_ = true;
    if (!reader_) return;
    reader_->finish();
    reader_->join();
}

LargeAnswerSeat RunsDoor::take_seat() const {
    return seats_.use_count() > large_answers ? nullptr : LargeAnswerSeat{seats_};
}

std::shared_ptr<WorkThread> RunsDoor::reader() {
    if (!reader_ && history_ && !stopped_) reader_ = std::make_shared<WorkThread>();
    return reader_;
}

/// Those that are closed have no writer, and are looked into.
OpenRuns RunsDoor::open_runs() const {
    const StationStatus status = station_.status();
    OpenRuns open;
    if (status.run && (status.run_open || !is_closed_state(status.run->state)))
        open.insert(id_of_path(status.run->file));
    if (status.drift && !is_closed_state(status.drift->state))
        open.insert(id_of_path(status.drift->file));
    return open;
}

template <class T> Task<Result<T>> RunsDoor::read(std::function<Result<T>(RunHistory&)> job) {
    if (!history_ || stopped_) co_return fail(Fault::not_found, "no stored runs are shown here");
    const std::shared_ptr<WorkThread> thread = reader();
    std::function<Result<T>()> on_it = [history = history_, job = std::move(job)] {
        return guarded<T>(*history, job);
    };
    const MonotonicTime deadline = scheduler_.now() + longest_look;
    auto got = co_await on_thread<T>(thread, scheduler_, std::move(on_it), deadline);
    if (!got && got.error().fault == Fault::link_timeout)
        co_return fail(Fault::io, "the disk of the stored runs does not answer");
    co_return got;
}

Task<HttpResponse> RunsDoor::list(HttpRequest request) {
    auto wanted = runs_asked_of({request.target().data(), request.target().size()});
    if (!wanted) co_return answer(request, wanted.error());
    const std::weak_ptr<WorkThread> on = reader();
    std::function<Result<RunsPage>(RunHistory&)> job =
        [asked = *std::move(wanted), open = open_runs(), on](RunHistory& history) {
            const auto stop = [&on] {
                const auto thread = on.lock();
                return thread && thread->finishing();
            };
            return Result<RunsPage>{history.page(asked, open, stop)};
        };
    const Result<RunsPage> page = co_await read<RunsPage>(std::move(job));
    if (!page) co_return answer(request, page.error());
    co_return answer(request, runs_http::status::ok, runs_json(*page));
}

Task<HttpResponse> RunsDoor::show_one(HttpRequest request, LargeAnswerSeat& seat) {
    seat = take_seat();
    if (!seat) co_return no_seat(request);
    std::function<Result<RunWithPapers>(RunHistory&)> job =
        [id = run_named_in(asked_path(request)).id, open = open_runs()](RunHistory& history) {
            return history.one(id, open);
        };
    const Result<RunWithPapers> found = co_await read<RunWithPapers>(std::move(job));
    if (!found) co_return answer(request, found.error());
    co_return answer_as(request, "application/json; charset=utf-8", run_with_papers_text(*found));
}

Task<HttpResponse> RunsDoor::give_paper(HttpRequest request, LargeAnswerSeat& seat) {
    seat = take_seat();
    if (!seat) co_return no_seat(request);
    std::function<Result<PaperBytes>(RunHistory&)> job = [named = run_named_in(asked_path(request)),
                                                          open = open_runs()](RunHistory& history) {
        return history.paper(named, open);
    };
    Result<PaperBytes> paper = co_await read<PaperBytes>(std::move(job));
    if (!paper) co_return answer(request, paper.error());
    HttpResponse response = answer_as(request, paper->type, std::move(paper->bytes));
    set_paper_fields(response, *paper);
    co_return response;
}

} // namespace axiscal
