// A person adds to a run: points taken again, readings left out, answers to findings; also after it
// was closed. The newest one of an earlier daemon is taken over when a person asks for it.
#include "acquisition/station/station.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/station/held.hpp"
#include "drivers/loop/spawn.hpp"

#include <utility>

namespace axiscal {

/// Until a run is known, for the one of an earlier daemon.
void Station::watch_set_up(const Sample& sample) {
    if (has_run()) return;
    set_up_since_start_.take(sample, {false, 0, true, config_.capture.fastest});
}

Task<Result<RunSummary>> Station::newest_closed_run() {
    AXISCAL_CO_TRY(const StoredRuns stored, co_await journal_.stored_runs(runs_folder(), boot_id_));
    if (!stored.newest) co_return fail(Fault::no_run_armed, "no run was measured yet: arm one");
    const RunSummary& newest = *stored.newest;
    if (!newest.complete)
        co_return fail(Fault::no_run_armed,
                       "the last run, " + newest.run_id + ", was " +
                           (newest.closed ? "closed as incomplete" : "left open") +
                           ": arm a new one");
    if (newest.kind == TestKind::drift)
        co_return fail(Fault::no_run_armed,
                       "the last test, " + newest.run_id +
                           ", is a drift test of an earlier start: a run before it cannot be added "
                           "to, arm a new one");
    if (newest.kind == TestKind::circular)
        co_return fail(Fault::no_run_armed,
                       "the last run, " + newest.run_id +
                           ", is a circular test: its circles are driven again");
    co_return newest;
}

/// Only when a person asks: a station that is started shows no old run. An exclusion needs no
/// set-up; a retake is refused with what it lost.
Task<Result<void>> Station::take_over_closed_run() {
    if (has_run() || arming_) co_return Result<void>{};
    AXISCAL_CO_TRY(const RunSummary newest, co_await newest_closed_run());
    if (has_run() || arming_) co_return fail(Fault::busy, "somebody else is at it just now");
    AXISCAL_CO_TRY(RunFileContents contents, co_await journal_.contents(newest.path));
    const PositioningContext context = positioning_context();
    ClosedBefore before = co_await judge_closed_run(context, set_up_since_start_, contents.run);
    if (has_run() || arming_) // meanwhile
        co_return fail(Fault::busy, "somebody else is at it just now");
    before.last_receipt = done_of_closed_;
    positioning_ = PositioningMeasurement::of_closed(context, newest.path, std::move(contents),
                                                     std::move(before));
    co_return Result<void>{};
}

Result<void> Station::run_may_be_revised() const {
    if (circles_)
        return fail(Fault::no_run_armed, "the last run is a circular test: its circles are driven "
                                         "again");
    if (!positioning_) return fail(Fault::no_run_armed, "there is no run to add to");
    if (waiting_for_disk_)
        return fail(Fault::not_durable, "the disk cannot store the records of the run yet; "
                                        "'axiscal status' shows why");
    AXISCAL_CHECK(positioning_->order_is_known());
    if (arming_ || revising_) return fail(Fault::busy, "somebody else is at it just now");
    if (drift_open()) return fail(Fault::busy, "a drift test is going on; let it end");
    if (is_being_closed()) return fail(Fault::busy, "the run is being closed; ask again");
    return {};
}

Task<Result<void>> Station::run_to_revise() {
    if (auto taken = co_await take_over_closed_run(); !taken) co_return taken;
    co_return run_may_be_revised();
}

/// Also of a closed run, under which nobody else waits for the disk.
void Station::find_out_about_order(const PositioningMeasurement& test) {
    if (test.order_is_lost() && !std::exchange(waiting_for_disk_, true))
        spawn(scheduler_, wait_for_disk());
}

Task<Result<RetakeAnswer>> Station::retake(RevisionRequest request) {
    if (auto may = co_await run_to_revise(); !may) co_return tl::unexpected<Error>(may.error());
    const auto test = positioning_;
    const Held revising{revising_};
    auto taken = co_await test->retake(std::move(request));
    find_out_about_order(*test);
    co_return taken;
}

Task<Result<int>> Station::exclude(RevisionRequest request) {
    if (auto may = co_await run_to_revise(); !may) co_return tl::unexpected<Error>(may.error());
    const auto test = positioning_;
    const Held revising{revising_};
    auto left_out = co_await test->exclude(std::move(request));
    find_out_about_order(*test);
    co_return left_out;
}

Task<Result<void>> Station::answer_finding(AnswerRequest request) {
    if (auto may = co_await run_to_revise(); !may) co_return may;
    const auto test = positioning_;
    if (test->is_open())
        co_return fail(Fault::busy,
                       "the run is open; its set-up is searched when it has its certificate");
    const Held revising{revising_};
    auto kept = co_await test->answer_finding(std::move(request));
    find_out_about_order(*test);
    co_return kept;
}

} // namespace axiscal
