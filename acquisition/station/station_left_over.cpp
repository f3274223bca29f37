// What an earlier daemon left: runs that were open go on or are closed, certificates that it could
// not make are made.
#include "acquisition/station/station.hpp"

#include "acquisition/measurement/another_boot.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>
#include <filesystem>
#include <malloc.h>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration after_the_start = std::chrono::seconds{1};

} // namespace

Task<Result<void>> Station::take_over_stored_runs() {
    Result<StoredRuns> stored = co_await journal_.stored_runs(runs_folder(), boot_id_);
    // On a full disk a run that was left open cannot be read: its index would have to grow.
    if (!stored || stored->unreadable != 0) {
        const std::optional<Error> trouble = co_await files_.trouble_in(runs_folder());
        if (trouble) co_return tl::unexpected<Error>(*trouble);
    }
    if (!stored) co_return tl::unexpected<Error>(stored.error());
    if (stored->newest) {
        newest_run_ = stored->newest->run_id;
        newest_run_utc_ns_ = stored->newest->opened_utc_ns;
    }
    for (RunSummary& run : stored->looked_into) {
        if (run.closed) continue;
        const Result<void> resumed = co_await resume_or_close(run.path);
        if (!resumed && !run_open()) {
            const std::optional<Error> trouble = co_await files_.trouble_in(runs_folder());
            if (trouble) co_return tl::unexpected<Error>(*trouble);
        }
        if (!resumed)
            note("The open run " + run.path +
                 " could not be continued: " + describe(resumed.error()));
        auto now = co_await journal_.summarize(run.path);
        if (now) run = *std::move(now);
    }
    // Of one that was not completed `done` stays 65535: it takes no requests.
    if (stored->newest && stored->newest->complete)
        co_await publish_done_of_closed(stored->newest->path);
    keep_hold_of_broken_off(*stored);
    spawn(scheduler_, certify_left_over(*std::move(stored)));
    co_return Result<void>{};
}

/// A program that stands at a request of it is to hold, also after a restart: no restart may
/// release an axis that nobody has answered.
void Station::keep_hold_of_broken_off(const StoredRuns& stored) {
    if (!stored.newest || run_open()) return;
    const auto now = std::ranges::find(stored.looked_into, stored.newest->path, &RunSummary::path);
    const RunSummary& last = now != stored.looked_into.end() ? *now : *stored.newest;
    left_broken_off_ = last.closed && !last.complete && last.kind != TestKind::drift &&
                       last.closing_reason != ended_by_cnc;
}

Task<Result<void>> Station::resume_or_close(std::string path) {
    AXISCAL_CO_TRY(RunFileContents contents, read_run_file_contents(path));
    if (const auto* drift = std::get_if<DriftSetup>(&contents.attachments.setup)) {
        const bool of_bar = drift->of_bar;
        std::string why = std::string{"Nobody watched the resting "} +
                          (of_bar ? "ballbar" : "axis") + " while the station was away.";
        auto closed = co_await close_left_over(path, std::move(why), Fault::datum_lost, false);
        left_over_fault_.reset(); // no CNC waits for it
        co_return closed;
    }
    // Reopened for points to be taken again: what was measured before still makes a whole run.
    const bool whole = contents.revisions.closings > 0 && check_complete(contents.run);
    if (run_open())
        co_return co_await close_left_over(path, "Another run was open too; only one can go on.",
                                           Fault::busy, whole);
    if (contents.run.kind == TestKind::circular)
        co_return co_await resume_or_close_circles(std::move(path), std::move(contents));
    if (!roles_.laser) {
        const std::string why =
            reads_polygon() ? std::string{"What was "} + (reads_faces() ? "read" : "typed") +
                                  " before a restart is not gone on with: nobody knows whether "
                                  "autocollimator and polygon were touched meanwhile."
                            : "The station file names no laser any more.";
        co_await close_left_over(path, why, Fault::bad_configuration, whole);
        co_return Result<void>{};
    }
    co_return co_await resume_or_close_axis(std::move(path), std::move(contents), whole);
}

Task<Result<void>>
Station::resume_or_close_axis(std::string path, RunFileContents contents, bool whole) {
    const PositioningContext context = positioning_context();
    StationNow now = co_await station_after_restart(context, contents.run);
    if (!waives_limits(contents.revisions.preflight)) {
        const MonotonicTime at = scheduler_.now();
        now.outside_limits = outside_limits(config_.environment, channels().environment(at), at);
    }
    ResumeVerdict verdict = decide_resume(contents.run, std::nullopt, now);
    if (verdict.decision != ResumeDecision::wait_for_request)
        co_return co_await close_left_over(path, verdict.sentence, verdict.fault, whole);
    AXISCAL_CO_TRY(const std::shared_ptr<PositioningMeasurement> test,
                   co_await PositioningMeasurement::reopen(
                       context, std::move(path), std::move(contents), std::move(verdict.sentence)));
    begin_positioning(test);
    co_return co_await test->go_on();
}

/// The last daemon may have closed its run and died before the CNC could read `done` of the last
/// point: it stands there and waits for it.
Task<void> Station::publish_done_of_closed(std::string newest_path) {
    if (run_open() || left_over_fault_) co_return;
    const auto receipt = co_await journal_.receipt_of_closed(std::move(newest_path));
    if (!receipt) co_return;
    done_of_closed_ = *receipt;
    port_->acknowledge(*receipt);
}

Task<Result<void>>
Station::close_left_over(std::string path, std::string reason, Fault fault, bool whole) {
    const auto stored = co_await journal_.summarize(path);
    if (auto reopened = co_await journal_.reopen(path); !reopened) co_return reopened;
    if (stored) note_another_boot(measurement_context(), stored->boot_id, boot_id_);
    record(EventKind::closed, reason, fault);
    if (whole) reason = "Every planned point is durable; not every retake was done: " + reason;
    if (auto closed = co_await files_.close_for_now(whole, reason); !closed) {
        co_await journal_.let_go();
        co_return closed;
    }
    const std::string how = whole ? " is closed again: " : " is closed as incomplete: ";
    note("The open run " + path + how + reason);
    left_over_fault_ = Error{fault, reason, {}, {}};
    co_return Result<void>{};
}

/// The report program makes its folder before it stores the result: a run that has a result and no
/// such folder has its certificate, perhaps published and cleared away since.
bool Station::lacks_certificate(const RunSummary& run) const {
    std::error_code error;
    return run.complete &&
           (!run.evaluated ||
            std::filesystem::exists(
                config_.state_directory + "/outbox/." + certificate_name(run) + ".staging", error));
}

/// What this daemon measures, or takes over, it certifies by itself when it closes it.
bool Station::is_of_this_daemon(const std::string& path) const {
    return (positioning_ && positioning_->run().path == path) ||
           (circles_ && circles_->run().path == path) || (resting_ && resting_->run().path == path);
}

/// The closed ones are looked into one by one and late: beside the loop, and behind whoever waited
/// for the station.
Task<void> Station::certify_left_over(StoredRuns stored) {
    co_await files_.wait_for_readers(runs_folder());
    for (const RunSummary& run : stored.looked_into)
        if (!is_of_this_daemon(run.path) && lacks_certificate(run))
            co_await certify(run.run_id, run.path);
    co_await scheduler_.sleep_for(after_the_start);
    for (const std::string& path : stored.folded) {
        if (stopping_) co_return;
        const auto run = co_await journal_.summarize(path);
        if (run && !is_of_this_daemon(path) && lacks_certificate(*run))
            co_await certify(run->run_id, path);
    }
    stored = {};
    ::malloc_trim(0); // a thousand runs leave half a megabyte that an idle station has no use for
}

/// Meanwhile the run may have been taken over: then it shows its certificate.
Task<void> Station::certify(std::string run_id, std::string path) {
    const auto entry = co_await certificates_.make(run_id, std::move(path));
    if (positioning_ && positioning_->run().run_id == run_id) positioning_->keep_certificate(entry);
}

} // namespace axiscal
