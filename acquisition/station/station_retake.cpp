// Points taken again and readings left out: while the run is open, and after it was closed as long
// as the set-up stands. The run machine decides; here it is made durable.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/station/held.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
Result<void> Station::run_may_be_revised() const {
    if (circles_)
        return fail(Fault::no_run_armed, "the last run is a circular test: its circles are driven "
                                         "again");
    if (!run_ || !machine_) return fail(Fault::no_run_armed, "there is no run to add to");
    if (waiting_for_disk_)
        return fail(Fault::not_durable, "the disk cannot store the records of the run yet; "
                                        "'axiscal status' shows why");
    if (revision_unknown_)
        return fail(Fault::not_durable,
                    "an earlier order could not be written, and the run file cannot be read to "
                    "tell what it holds of it: 'axiscal verify " +
                        run_->path + "' says why");
    if (arming_ || revising_) return fail(Fault::busy, "somebody else is at it just now");
    if (drift_open()) return fail(Fault::busy, "a drift test is going on; let it end");
    if (run_->closing) return fail(Fault::busy, "the run is being closed; ask again");
    return {};
}

/// What counts still counts from the datum. An autocollimator counts nothing, and sees a face at
/// the targets alone.
Result<void> Station::datum_stands() const {
    if (reads_polygon()) return autocollimator_speaks();
    const auto reading = readings_.reference().newest();
    if (!reading || scheduler_.now() - reading->at > laser_limit || !reading->value())
        return fail(Fault::link_timeout, "the " + reference_word() + " gives no good reading now");
    if (reading->epoch != datum_epoch_)
        return fail(Fault::datum_lost,
                    "the " + reference_word() + "'s counter lost its zero: arm a new run");
    return {};
}

/// For a run that was closed: the same instruments, and the datum that it was measured from.
Result<void> Station::set_up_stands() const {
    if (!set_up_.lost().empty()) return fail(Fault::datum_lost, set_up_.lost() + ": arm a new run");
    AXISCAL_CHECK(datum_stands());
    // Behind those of the station file stands the artefact of a rotary axis, which nobody reads.
    const std::size_t read = std::min(config_.instruments.size(), run_->header.instruments.size());
    for (std::size_t i = 0; i < read; ++i) {
        const InstrumentRecord& then = run_->header.instruments[i];
        const std::string& serial = supervisor_.identity(static_cast<int>(i)).serial;
        if (!serial.empty() && serial != then.serial)
            return fail(Fault::unknown_instrument, then.name + " has the serial number '" + serial +
                                                       "', the run's has '" + then.serial +
                                                       "': arm a new run");
    }
    return readings_.environment_is_fresh(scheduler_.now());
}

Task<Result<void>> Station::write_revision(Answer order, OrderRecord ordered) {
    const bool reopens =
        (order.retake && order.retake->reopens) || (order.exclusion && order.exclusion->reopens);
    if (reopens) {
        std::optional<RetakeRecord> retake;
        if (order.retake) retake = std::move(order.retake->retake);
        std::vector<ExclusionRecord> left_out;
        if (order.exclusion) left_out = std::move(order.exclusion->exclusions);
        std::vector<OrderRecord> orders{std::move(ordered)};
        co_return co_await journal_.reopen_closed(run_->path, std::move(retake),
                                                  std::move(left_out), std::move(orders));
    }
    if (order.retake) journal_.note(std::move(order.retake->retake));
    if (order.exclusion) journal_.note(std::move(order.exclusion->exclusions));
    journal_.note(std::move(ordered));
    co_return co_await journal_.flush();
}

/// Makes durable what the machine has just decided; on failure the order is taken back, and nothing
/// else: what came in meanwhile, a commit that failed too, stays.
Task<Result<void>> Station::keep_revision(Answer order, Orderer by) {
    OrderRecord ordered = order.retake
                              ? order_of("retake", by, std::to_string(order.retake->retake.number))
                              : order_of("exclude", by);
    auto kept = co_await write_revision(std::move(order), std::move(ordered));
    if (kept) {
        feed(RevisionKept{scheduler_.now()});
    } else {
        feed(RevisionLost{scheduler_.now()});
        // Else nothing was written: a reader held the file, or it takes no orders.
        if (kept.error().fault == Fault::not_durable) find_out_about_order();
    }
    co_return kept;
}

/// Also of a closed run, under which nobody else waits for the disk.
void Station::find_out_about_order() {
    revision_unknown_ = true;
    if (!std::exchange(waiting_for_disk_, true)) spawn(scheduler_, wait_for_disk());
}

void Station::run_is_open_again() {
    run_->closed = run_->closing_row_durable = false;
    run_->outcome.reset();
    run_->certificate.clear();
    run_->no_certificate.reset();
    run_->refusal.reset();
    if (!interruption_.empty()) record(EventKind::interrupted, std::exchange(interruption_, {}));
    log_environment_anew();
}

/// A program of points taken again begins with it, whatever was shown meanwhile.
Task<void> Station::show_last_number() {
    const RunView view = machine_->view();
    if (view.last_durable == 0) co_return;
    auto receipt = view.last_skipped ? co_await journal_.receipt_for_skip(view.last_durable,
                                                                          view.last_durable_step)
                                     : co_await journal_.receipt_for(view.last_durable_step);
    if (!receipt) co_return; // its next commit brings one
    last_receipt_ = *receipt;
    publish_done(view.last_durable, view.last_skipped);
}

Task<Result<RetakeAnswer>> Station::retake(RevisionRequest request) {
    if (auto taken = co_await take_over_closed_run(); !taken)
        co_return tl::unexpected<Error>(taken.error());
    if (auto may = run_may_be_revised(); !may) co_return tl::unexpected<Error>(may.error());
    const bool was_closed = run_->closed;
    if (was_closed)
        if (auto stands = set_up_stands(); !stands) co_return tl::unexpected<Error>(stands.error());
    Answer order = ask(Retake{request.selection, request.reason, scheduler_.now()});
    if (order.refusal) co_return tl::unexpected<Error>(*order.refusal);
    const std::vector<RetakePoint> points = order.retake->retake.points;
    const Held revising{revising_};
    auto kept = co_await keep_revision(std::move(order), request.by);
    if (!kept) co_return tl::unexpected<Error>(kept.error());
    if (was_closed) {
        run_is_open_again();
        co_await show_last_number();
    }
    RetakeAnswer answer;
    answer.last_request = machine_->view().last_durable;
    for (const RetakePoint& point : points)
        answer.points.push_back(
            {point.step, run_->header.plan.points[static_cast<std::size_t>(point.planned_step)]});
    note(counted(static_cast<long>(answer.points.size()), "point") + " of run " +
         run_->header.run_id + " to be taken again: " + request.reason + "; ordered by " +
         name_of(request.by));
    co_return answer;
}

Task<Result<int>> Station::exclude(RevisionRequest request) {
    if (auto taken = co_await take_over_closed_run(); !taken)
        co_return tl::unexpected<Error>(taken.error());
    if (auto may = run_may_be_revised(); !may) co_return tl::unexpected<Error>(may.error());
    Answer order = ask(Exclude{request.selection, request.reason, scheduler_.now()});
    if (order.refusal) co_return tl::unexpected<Error>(*order.refusal);
    const int count = static_cast<int>(order.exclusion->exclusions.size());
    const bool was_closed = run_->closed;
    const Held revising{revising_};
    auto kept = co_await keep_revision(std::move(order), request.by);
    if (kept && was_closed) {
        if (run_->taken_over) mark_another_boot(run_->header.boot_id);
        kept = co_await close_again();
    }
    if (!kept) co_return tl::unexpected<Error>(kept.error());
    note(counted(count, "reading") + " of run " + run_->header.run_id +
         " left out: " + request.reason + "; ordered by " + name_of(request.by));
    co_return count;
}

/// The run stays closed to the CNC; only its file was opened for a moment. Who ordered it does not
/// wait for a reader of the file: its certificate does.
Task<Result<void>> Station::close_again() {
    run_->closing_row_durable = false;
    auto closed = co_await close_file_for_now(true, run_->outcome->reason);
    if (!closed) co_return closed; // the disk is waited for
    run_->closing_row_durable = true;
    run_->certificate.clear();
    run_->no_certificate.reset();
    spawn(scheduler_, certify_once_unread(run_->header.run_id, run_->path));
    co_return closed;
}

Task<void> Station::certify_once_unread(std::string run_id, std::string path) {
    co_await wait_for_readers();
    co_await certify(std::move(run_id), std::move(path));
}

} // namespace axiscal
