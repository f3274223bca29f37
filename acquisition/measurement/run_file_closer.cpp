#include "acquisition/measurement/run_file_closer.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "analysis/record/run_record.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Duration ask_reader_every = std::chrono::seconds{1};

} // namespace

RunFileCloser::RunFileCloser(Scheduler& scheduler,
                             Journal& journal,
                             Notices& notices,
                             const bool& stopping)
    : scheduler_{scheduler}
    , journal_{journal}
    , notices_{notices}
    , stopping_{stopping} {}

Task<Result<void>> RunFileCloser::close(bool complete, std::string reason) {
    for (;;) {
        Result<void> closed = co_await journal_.close(complete, reason);
        const bool is_read = !closed && closed.error().fault == Fault::busy;
        const bool reported = !reader_.empty();
        reader_ = is_read ? closed.error().detail : "";
        if (!is_read || stopping_) co_return closed;
        if (!reported) notices_.note("The run is closed and safe. " + reader_ + ".");
        co_await scheduler_.sleep_for(ask_reader_every);
    }
}

Task<Result<void>>
RunFileCloser::close_for_now(std::string run_id, bool complete, std::string reason) {
    Result<void> closed = co_await journal_.close(complete, std::move(reason));
    if (closed || closed.error().fault != Fault::busy) co_return closed;
    notices_.note("The run is closed and safe. " + closed.error().detail + ".",
                  {Fault::none, std::move(run_id)});
    co_await journal_.let_go();
    co_return Result<void>{};
}

Task<void> RunFileCloser::wait_for_readers(std::string folder) {
    while (!stopping_) {
        const auto tidied = co_await journal_.tidy(folder);
        if (tidied || tidied.error().fault != Fault::busy) co_return;
        co_await scheduler_.sleep_for(ask_reader_every);
    }
}

Task<std::optional<Error>> RunFileCloser::trouble_in(std::string folder) {
    const Result<void> tried = co_await journal_.try_folder(std::move(folder));
    std::optional<Error> trouble;
    if (!tried) trouble = Error{Fault::not_durable, tried.error().detail, tried.error().cause, {}};
    co_return trouble;
}

tl::unexpected<Error> RunFileCloser::not_closed_yet() const {
    if (!reader_.empty())
        return fail(Fault::busy,
                    "nothing more is taken and the closing is on disk, but " + reader_);
    return fail(Fault::busy,
                "nothing more is taken, but the file is not closed yet: a record is on its way to "
                "the disk; it is closed as soon as the disk has answered");
}

Task<Result<RunFileContents>> RunFileCloser::written_again(std::string path, MonotonicTime since) {
    if (auto kept = co_await journal_.flush(); !kept) co_return tl::unexpected<Error>(kept.error());
    const MonotonicTime now = scheduler_.now();
    std::string away = "The disk took no records for " + in_seconds(now - since) +
                       "; the file was verified and synced anew.";
    journal_.note(EventRecord{EventKind::interrupted, now, scheduler_.clock_tie().utc_ns,
                              std::move(away), Fault::not_durable, 0});
    if (auto flushed = co_await journal_.flush(); !flushed)
        co_return tl::unexpected<Error>(flushed.error());
    auto contents = co_await journal_.contents(std::move(path));
    if (contents) notices_.note("The run file is written again.");
    co_return contents;
}

std::string disk_text(const Error& error, const std::string& folder) {
    const std::string advice = way_out(error.cause, folder);
    const std::string cause = error.cause ? " (" + error.cause.message() + ")" : "";
    return error.detail + cause + "." + (advice.empty() ? "" : " " + advice);
}

tl::unexpected<Error> file_not_closed(const Error& why, const std::string& folder) {
    return fail(Fault::not_durable,
                "the run takes nothing more, but its file could not be closed: " +
                    disk_text(why, folder) + " The station closes it once the disk takes records",
                why.cause);
}

} // namespace axiscal
