// A closed run that may be added to: its set-up is watched, and the newest one of an earlier daemon
// is taken over when a person asks for it.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/run/resume.hpp"
#include "analysis/record/run_clock.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Duration answer_limit = std::chrono::seconds{5}; // for a station that was just started

} // namespace

/// While no run is open nobody captures; the counter's zero is watched by its readings: since the
/// run was closed, or, of a run that an earlier daemon closed, since the start.
void Station::watch_set_up(const Sample& sample) {
    if (circles_ || (run_ && (!run_->closed || !datum_))) return;
    set_up_.take(sample,
                 {run_.has_value(), datum_epoch_, interruption_.empty(), config_.capture.fastest});
}

/// What is written now counts by another monotonic clock: who tells its times has to know.
void Station::mark_another_boot(const BootId& boot_of_run) {
    if (is_same_boot(boot_of_run, boot_id_)) return;
    const bool certain = boot_of_run.known() && boot_id_.known();
    std::string sentence =
        certain ? "What follows was written after " : "What follows may count by another clock: ";
    sentence += restart_text(boot_of_run, boot_id_) + ".";
    record(EventKind::note, std::move(sentence));
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

/// Why the datum of a run of an earlier daemon cannot be relied on; empty when it holds, as for an
/// open run that is resumed, and the proof is kept for the record.
Task<std::string> Station::doubt_about_datum(const RunRecord& run) {
    const MonotonicTime limit = scheduler_.now() + answer_limit;
    while (!set_up_.settled() && set_up_.lost().empty() && scheduler_.now() < limit)
        co_await scheduler_.sleep_for(look_every);
    StationNow now;
    now.config_hash = config_hash_;
    now.boot_id = boot_id_;
    now.laser_serial = laser_serial();
    now.laser = set_up_.settled();
    now.limits.fastest = config_.capture.fastest;
    if (roles_.laser)
        now.limits.count_modulus =
            supervisor_.instrument(channel_of(*roles_.laser).instrument).count_modulus();
    if (!counting_rate_hz(run)) now.limits.rate_hz = co_await laser_rate_hz(limit);
    const ResumeVerdict verdict = decide_resume(run, std::nullopt, now);
    interruption_ = "axiscald was restarted after the run had been closed. " + verdict.sentence;
    if (verdict.decision == ResumeDecision::wait_for_request) co_return std::string{};
    std::string doubt = "axiscald was restarted after the run had been closed, and nothing proves "
                        "that its set-up stands. " +
                        verdict.sentence;
    if (doubt.ends_with('.')) doubt.pop_back();
    co_return doubt;
}

/// Only when a person asks: a station that is started shows no old run. An exclusion needs no
/// set-up; a retake is refused with what it lost.
Task<Result<void>> Station::take_over_closed_run() {
    if (run_ || circles_ || arming_) co_return Result<void>{};
    AXISCAL_CO_TRY(const RunSummary newest, co_await newest_closed_run());
    if (run_ || circles_ || arming_) co_return fail(Fault::busy, "somebody else is at it just now");
    AXISCAL_CO_TRY(RunFileContents contents, co_await journal_.contents(newest.path));
    std::string doubt = co_await doubt_about_datum(contents.run);
    if (run_ || circles_ || arming_) // meanwhile
        co_return fail(Fault::busy, "somebody else is at it just now");
    CurrentRun last;
    last.path = newest.path;
    last.closed = last.closing_row_durable = last.taken_over = true;
    last.outcome = Close{true, contents.run.closing_reason, Fault::none};
    RunSetup setup = setup_of(contents.run);
    last.answers = contents.revisions.answers.size();
    last.limits_waived = waives_limits(contents.revisions.preflight);
    setup.revisions = std::move(contents.revisions);
    const std::uint32_t epoch = set_up_.first_epoch();
    machine_.emplace(
        RunMachine::of_closed(std::move(setup), contents.run, epoch, scheduler_.now()));
    contents.run.points.clear();
    last.header = std::move(contents.run);
    run_ = std::move(last);
    datum_ = machine_->view().datum;
    datum_epoch_ = epoch;
    set_up_.lose(std::move(doubt));
    co_return Result<void>{};
}

} // namespace axiscal
