#include "acquisition/measurement/recovery.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/another_boot.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/measurement_kind.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/run/run_machine.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_store.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>
#include <filesystem>
#include <malloc.h>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration after_the_start = std::chrono::seconds{1};

} // namespace

Recovery::Recovery(const PositioningContext& context, LatestTests& tests, const bool& arming)
    : context_(context)
    , tests_{tests}
    , arming_{arming}
    , set_up_since_start_{reference_word(context.config)} {}

std::string Recovery::runs_folder() const {
    return context_.config.state_directory + "/runs";
}

Task<Result<void>> Recovery::take_over_stored_runs() {
    Journal& journal = context_.journal;
    Result<StoredRuns> stored = co_await journal.stored_runs(runs_folder(), context_.boot_id);
    // On a full disk a run that was left open cannot be read: its index would have to grow.
    if (!stored || stored->unreadable != 0) {
        const std::optional<Error> trouble = co_await context_.files.trouble_in(runs_folder());
        if (trouble) co_return tl::unexpected<Error>(*trouble);
    }
    if (!stored) co_return tl::unexpected<Error>(stored.error());
    if (stored->newest)
        tests_.keep_newest(
            LatestTests::Newest{stored->newest->run_id, stored->newest->opened_utc_ns});
    for (RunSummary& run : stored->looked_into) {
        if (run.closed) continue;
        const Result<void> resumed = co_await resume_or_close(run.path);
        if (!resumed && !tests_.run_open()) {
            const std::optional<Error> trouble = co_await context_.files.trouble_in(runs_folder());
            if (trouble) co_return tl::unexpected<Error>(*trouble);
        }
        if (!resumed)
            context_.notices.note("The open run " + run.path +
                                      " could not be continued: " + describe(resumed.error()),
                                  {resumed.error().fault, run.run_id});
        auto now = co_await journal.summarize(run.path);
        if (now) run = *std::move(now);
    }
    // Of one that was not completed `done` stays 65535: it takes no requests.
    if (stored->newest && stored->newest->complete)
        co_await publish_done_of_closed(stored->newest->path);
    keep_hold_of_broken_off(*stored);
    spawn(context_.scheduler, certify_left_over(*std::move(stored)));
    co_return Result<void>{};
}

/// A program that stands at a request of it is to hold, also after a restart: no restart may
/// release an axis that nobody has answered.
void Recovery::keep_hold_of_broken_off(const StoredRuns& stored) {
    if (!stored.newest || tests_.run_open()) return;
    const auto now = std::ranges::find(stored.looked_into, stored.newest->path, &RunSummary::path);
    const RunSummary& last = now != stored.looked_into.end() ? *now : *stored.newest;
    left_broken_off_ = last.closed && !last.complete && kind_row(last.kind).driven_by_cnc &&
                       last.closing_reason != ended_by_cnc;
}

Task<Result<void>> Recovery::resume_or_close(std::string path) {
    AXISCAL_CO_TRY(RunFileContents contents, read_run_file_contents(path));
    const MeasurementKind& kind = kind_row(contents.run.kind);
    const bool by_cnc = kind.driven_by_cnc;
    const std::int64_t opened_utc_ns = contents.run.opened.utc_ns;
    // Reopened for points to be taken again: what was measured before still makes a whole run.
    const bool whole =
        by_cnc && contents.revisions.closings > 0 && check_complete(contents.run).has_value();
    LeftRun left{path, std::move(contents), whole};
    if (by_cnc && tests_.run_open()) {
        LeftClosing closing =
            left.closed_for("Another run was open too; only one can go on.", Fault::busy);
        co_return co_await close(std::move(path), std::move(closing));
    }
    AXISCAL_CO_TRY(TakenOver taken, co_await kind.take_over(context_, std::move(left)));
    if (taken.test) co_return co_await go_on(std::move(taken), opened_utc_ns);
    Result<void> closed = co_await close(std::move(path), std::move(taken.closing));
    if (!by_cnc) why_not_.reset(); // no CNC waits for it
    co_return closed;
}

Task<Result<void>> Recovery::go_on(TakenOver taken, std::int64_t opened_utc_ns) {
    tests_.put_on(taken.test, opened_utc_ns);
    why_not_.reset();
    context_.notices.nothing_refused();
    co_return co_await taken.test->go_on();
}

/// The journal has no other file open.
Task<Result<void>> Recovery::close(std::string path, LeftClosing closing) {
    Journal& journal = context_.journal;
    const auto stored = co_await journal.summarize(path);
    if (auto reopened = co_await journal.reopen(path); !reopened) co_return reopened;
    if (stored) note_another_boot(context_, stored->boot_id, context_.boot_id);
    Scheduler& scheduler = context_.scheduler;
    journal.note(EventRecord{EventKind::closed, scheduler.now(), scheduler.clock_tie().utc_ns,
                             closing.reason, closing.fault, 0});
    const bool again = closing.as == LeftClosing::As::again;
    const bool complete = closing.as != LeftClosing::As::incomplete;
    std::string reason = std::move(closing.reason);
    if (again) reason = "Every planned point is durable; not every retake was done: " + reason;
    // Another one may be open, which the log would take for it.
    std::string run_id = stored ? stored->run_id : std::filesystem::path{path}.stem().string();
    if (auto closed = co_await context_.files.close_for_now(run_id, complete, reason); !closed) {
        co_await journal.let_go();
        co_return closed;
    }
    const std::string how = again      ? " is closed again: "
                            : complete ? " is closed as complete: "
                                       : " is closed as incomplete: ";
    context_.notices.note("The open run " + path + how + reason,
                          {closing.fault, std::move(run_id)});
    if (closing.as != LeftClosing::As::complete)
        why_not_ = Error{closing.fault, std::move(reason), {}, {}};
    co_return Result<void>{};
}

/// The last daemon may have closed its run and died before the CNC could read `done` of the last
/// point: it stands there and waits for it.
Task<void> Recovery::publish_done_of_closed(std::string newest_path) {
    if (tests_.run_open() || why_not_) co_return;
    const auto receipt = co_await context_.journal.receipt_of_closed(std::move(newest_path));
    if (!receipt) co_return;
    done_of_closed_ = *receipt;
    context_.cnc.acknowledge(*receipt);
}

void Recovery::watch_set_up(const Sample& sample) {
    if (tests_.run()) return;
    SetUpWatch::Run unknown;
    unknown.fastest = context_.config.capture.fastest;
    set_up_since_start_.take(sample, unknown);
}

Task<Result<RunSummary>> Recovery::newest_closed_run() {
    AXISCAL_CO_TRY(const StoredRuns stored,
                   co_await context_.journal.stored_runs(runs_folder(), context_.boot_id));
    if (!stored.newest) co_return fail(Fault::no_run_armed, "no run was measured yet: arm one");
    const RunSummary& newest = *stored.newest;
    if (!newest.complete)
        co_return fail(Fault::no_run_armed,
                       "the last run, " + newest.run_id + ", was " +
                           (newest.closed ? "closed as incomplete" : "left open") +
                           ": arm a new one");
    const auto refuse_addition = kind_row(newest.kind).refuse_addition;
    if (refuse_addition != nullptr) co_return refuse_addition(newest);
    co_return newest;
}

Task<Result<void>> Recovery::take_over_closed_run() {
    if (somebody_else_began()) co_return Result<void>{};
    AXISCAL_CO_TRY(const RunSummary newest, co_await newest_closed_run());
    if (somebody_else_began()) co_return fail(Fault::busy, "somebody else is at it just now");
    AXISCAL_CO_TRY(RunFileContents contents, co_await context_.journal.contents(newest.path));
    const MeasurementKind& kind = kind_row(newest.kind);
    auto test = co_await kind.take_over_closed(context_, newest.path, std::move(contents),
                                               set_up_since_start_, done_of_closed_);
    if (somebody_else_began()) co_return fail(Fault::busy, "somebody else is at it just now");
    tests_.put_on_closed(std::move(test));
    co_return Result<void>{};
}

/// The report program makes its folder before it stores the result: a run that has a result and no
/// such folder has its certificate, perhaps published and cleared away since.
bool Recovery::lacks_certificate(const RunSummary& run) const {
    std::error_code error;
    const std::string outbox = context_.config.state_directory + "/outbox/";
    return run.complete &&
           (!run.evaluated ||
            std::filesystem::exists(outbox + "." + certificate_name(run) + ".staging", error));
}

/// The closed ones are looked into one by one and late: beside the loop, and behind whoever waited
/// for the station. What this daemon takes over it certifies by itself when it closes it.
Task<void> Recovery::certify_left_over(StoredRuns stored) {
    co_await context_.files.wait_for_readers(runs_folder());
    for (const RunSummary& run : stored.looked_into)
        if (!tests_.lies_at(run.path) && lacks_certificate(run))
            co_await certify(run.run_id, run.path);
    co_await context_.scheduler.sleep_for(after_the_start);
    for (const std::string& path : stored.folded) {
        if (context_.stopping) co_return;
        const auto run = co_await context_.journal.summarize(path);
        if (run && !tests_.lies_at(path) && lacks_certificate(*run))
            co_await certify(run->run_id, path);
    }
    stored = {};
    ::malloc_trim(0); // a thousand runs leave half a megabyte that an idle station has no use for
}

/// Meanwhile the run may have been taken over: then it shows its certificate.
Task<void> Recovery::certify(std::string run_id, std::string path) {
    const auto entry = co_await context_.certificates.make(run_id, std::move(path));
    const auto& test = tests_.run();
    if (test && test->run().run_id == run_id) test->keep_certificate(entry);
}

} // namespace axiscal
