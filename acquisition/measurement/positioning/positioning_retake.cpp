// Points taken again and readings left out: while the run is open, and after it was closed as long
// as the set-up stands. The run machine decides; here it is made durable.
#include "acquisition/capture/wording.hpp"
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/another_boot.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {

Result<void> PositioningMeasurement::order_is_known() const {
    if (!revision_unknown_) return {};
    return fail(Fault::not_durable,
                "an earlier order could not be written, and the run file cannot be read to "
                "tell what it holds of it: 'axiscal verify " +
                    run_.path + "' says why");
}

/// What counts still counts from the datum. An autocollimator counts nothing, and sees a face at
/// the targets alone.
Result<void> PositioningMeasurement::datum_stands() const {
    const MonotonicTime now = context_.scheduler.now();
    if (reads_polygon(context_.config))
        return autocollimator_speaks(context_.readings, context_.roles, context_.instruments, now);
    const std::string word = reference_word(context_.config);
    const auto reading = context_.readings.reference().newest();
    if (!reading || now - reading->at > laser_limit || !reading->value())
        return fail(Fault::link_timeout, "the " + word + " gives no good reading now");
    if (reading->epoch != datum_epoch_)
        return fail(Fault::datum_lost, "the " + word + "'s counter lost its zero: arm a new run");
    return {};
}

/// For a run that was closed: the same instruments, and the datum that it was measured from.
Result<void> PositioningMeasurement::set_up_stands() const {
    if (!set_up_.lost().empty()) return fail(Fault::datum_lost, set_up_.lost() + ": arm a new run");
    AXISCAL_CHECK(datum_stands());
    // Behind those of the station file stands the artefact of a rotary axis, which nobody reads.
    const std::size_t read =
        std::min(context_.config.instruments.size(), header_.instruments.size());
    for (std::size_t i = 0; i < read; ++i) {
        const InstrumentRecord& then = header_.instruments[i];
        const std::string& serial = context_.instruments.identity(static_cast<int>(i)).serial;
        if (!serial.empty() && serial != then.serial)
            return fail(Fault::unknown_instrument, then.name + " has the serial number '" + serial +
                                                       "', the run's has '" + then.serial +
                                                       "': arm a new run");
    }
    return context_.readings.environment_is_fresh(context_.scheduler.now());
}

Task<Result<void>> PositioningMeasurement::write_revision(Answer order, OrderRecord ordered) {
    Journal& journal = context_.journal;
    const bool reopens =
        (order.retake && order.retake->reopens) || (order.exclusion && order.exclusion->reopens);
    if (reopens) {
        std::optional<RetakeRecord> retake;
        if (order.retake) retake = std::move(order.retake->retake);
        std::vector<ExclusionRecord> left_out;
        if (order.exclusion) left_out = std::move(order.exclusion->exclusions);
        std::vector<OrderRecord> orders{std::move(ordered)};
        co_return co_await journal.reopen_closed(run_.path, std::move(retake), std::move(left_out),
                                                 std::move(orders));
    }
    if (order.retake) journal.note(std::move(order.retake->retake));
    if (order.exclusion) journal.note(std::move(order.exclusion->exclusions));
    journal.note(std::move(ordered));
    co_return co_await journal.flush();
}

/// Makes durable what the machine has just decided; on failure the order is taken back, and nothing
/// else: what came in meanwhile, a commit that failed too, stays.
Task<Result<void>> PositioningMeasurement::keep_revision(Answer order, Orderer by) {
    Scheduler& scheduler = context_.scheduler;
    OrderRecord ordered = order.retake ? order_now(scheduler, "retake", by,
                                                   std::to_string(order.retake->retake.number))
                                       : order_now(scheduler, "exclude", by);
    auto kept = co_await write_revision(std::move(order), std::move(ordered));
    if (kept) {
        feed(RevisionKept{scheduler.now()});
    } else {
        feed(RevisionLost{scheduler.now()});
        // Else nothing was written: a reader held the file, or it takes no orders.
        if (kept.error().fault == Fault::not_durable) revision_unknown_ = true;
    }
    co_return kept;
}

void PositioningMeasurement::run_is_open_again() {
    run_.stage = RunState::Stage::open;
    run_.complete = written_ = false;
    run_.reason.clear();
    run_.fault = Fault::none;
    run_.certificate.clear();
    run_.no_certificate.reset();
    refusal_.reset();
    if (!restart_.empty()) record(EventKind::interrupted, std::exchange(restart_, {}));
    log_environment_anew();
}

/// A program of points taken again begins with it, whatever was shown meanwhile.
Task<void> PositioningMeasurement::show_last_number() {
    const RunView view = machine_.view();
    if (view.last_durable == 0) co_return;
    Journal& journal = context_.journal;
    auto receipt = view.last_skipped ? co_await journal.receipt_for_skip(view.last_durable,
                                                                         view.last_durable_step)
                                     : co_await journal.receipt_for(view.last_durable_step);
    if (!receipt) co_return; // its next commit brings one
    last_receipt_ = *receipt;
    publish_done(view.last_durable, view.last_skipped);
}

Task<Result<RetakeAnswer>> PositioningMeasurement::retake(RevisionRequest request) {
    const bool was_closed = !is_open();
    if (was_closed)
        if (auto stands = set_up_stands(); !stands) co_return tl::unexpected<Error>(stands.error());
    Answer order = ask(Retake{request.selection, request.reason, context_.scheduler.now()});
    if (order.refusal) co_return tl::unexpected<Error>(*order.refusal);
    const std::vector<RetakePoint> points = order.retake->retake.points;
    auto kept = co_await keep_revision(std::move(order), request.by);
    if (!kept) co_return tl::unexpected<Error>(kept.error());
    if (was_closed) {
        run_is_open_again();
        co_await show_last_number();
    }
    RetakeAnswer answer;
    answer.last_request = machine_.view().last_durable;
    for (const RetakePoint& point : points)
        answer.points.push_back(
            {point.step, header_.plan.points[static_cast<std::size_t>(point.planned_step)]});
    note(counted(static_cast<long>(answer.points.size()), "point") + " of run " + run_.run_id +
         " to be taken again: " + request.reason + "; ordered by " + name_of(request.by));
    co_return answer;
}

Task<Result<int>> PositioningMeasurement::exclude(RevisionRequest request) {
    Answer order = ask(Exclude{request.selection, request.reason, context_.scheduler.now()});
    if (order.refusal) co_return tl::unexpected<Error>(*order.refusal);
    const int count = static_cast<int>(order.exclusion->exclusions.size());
    const bool was_closed = !is_open();
    auto kept = co_await keep_revision(std::move(order), request.by);
    if (kept && was_closed) kept = co_await close_again();
    if (!kept) co_return tl::unexpected<Error>(kept.error());
    note(counted(count, "reading") + " of run " + run_.run_id + " left out: " + request.reason +
         "; ordered by " + name_of(request.by));
    co_return count;
}

/// The run stays closed to the CNC; only its file was opened for a moment. Who ordered it does not
/// wait for a reader of the file: its certificate does.
Task<Result<void>> PositioningMeasurement::close_again() {
    if (taken_over_) note_another_boot(context_, header_.boot_id, context_.boot_id);
    written_ = false;
    auto closed = co_await context_.files.close_for_now(run_.run_id, true, run_.reason);
    if (!closed) co_return closed; // the disk is waited for
    written_ = true;
    run_.certificate.clear();
    run_.no_certificate.reset();
    spawn(context_.scheduler, certify_once_unread(held()));
    co_return closed;
}

Task<void> PositioningMeasurement::certify_once_unread(Self test) {
    co_await test->context_.files.wait_for_readers(test->runs_folder());
    co_await test->certify();
}

} // namespace axiscal
