// Requests before the circles, and the end of the test.
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/circular/circle_measurement.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "drivers/loop/spawn.hpp"

#include <utility>

namespace axiscal {

bool CircleMeasurement::on_trigger(const TriggerEvent& event) {
    if (records()) {
        take(event);
        return true;
    }
    if (!repeats_last(event)) return false;
    context_.cnc.acknowledge(*last_receipt_);
    return true;
}

/// The answer to its last request was lost, and the test is closed by now.
bool CircleMeasurement::repeats_last(const TriggerEvent& event) const {
    return run_.complete && last_receipt_ && event.command == TriggerCommand::capture &&
           last_receipt_->sequence() == event.sequence;
}

Result<void> CircleMeasurement::trigger() {
    if (!records()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    TriggerEvent event;
    event.at = context_.scheduler.now();
    event.origin = TriggerOrigin::manual;
    if (auto refusal = take(event)) return tl::unexpected<Error>(*std::move(refusal));
    return {};
}

std::optional<Error> CircleMeasurement::take(const TriggerEvent& event) {
    if (watch_ && watch_->whole()) order_.circle_seen();
    const CircleVerdict verdict = order_.judge(event);
    switch (verdict.answer) {
    case CircleAnswer::ignore: break;
    case CircleAnswer::again: acknowledge_again(verdict.sequence); break;
    case CircleAnswer::abort: end(false, verdict.sentence, Fault::none); break;
    case CircleAnswer::broken: {
        Error error = refused(verdict, Fault::incomplete_run, event.origin);
        end(false, verdict.sentence, Fault::incomplete_run);
        return error;
    }
    case CircleAnswer::refuse: return refused(verdict, verdict.fault, event.origin);
    case CircleAnswer::begin:
    case CircleAnswer::end:
        watch_.reset();
        if (verdict.once_more) watch_.emplace(setup_);
        spawn(context_.scheduler, commit(held(), event, verdict));
    }
    return std::nullopt;
}

void CircleMeasurement::acknowledge_again(std::uint16_t sequence) {
    if (last_receipt_ && last_receipt_->sequence() == sequence)
        context_.cnc.acknowledge(*last_receipt_);
}

/// A person who waits for the answer hears it alone.
Error CircleMeasurement::refused(const CircleVerdict& verdict, Fault fault, TriggerOrigin origin) {
    Error error{fault, verdict.sentence, {}, {}};
    if (origin != TriggerOrigin::manual) refuse(verdict.sequence, error, origin);
    return error;
}

void CircleMeasurement::refuse(std::uint16_t sequence, Error error, TriggerOrigin origin) {
    if (origin == TriggerOrigin::manual)
        context_.notices.note("Refused: " + describe(error), {error.fault});
    else
        context_.cnc.refuse_on_port(sequence, error);
    refusal_ = std::move(error);
}

/// A busy computer may read the CNC before the bar, whose last feed-out then still waits in a
/// buffer.
Task<void> CircleMeasurement::bar_is_read_until(MonotonicTime at) {
    const MonotonicTime limit = context_.scheduler.now() + bar_limit;
    const auto is_behind = [this, at] {
        const auto& reading = context_.readings.latest(bar_);
        return !reading || reading->at < at;
    };
    while (records() && is_behind() && context_.scheduler.now() < limit)
        co_await context_.scheduler.sleep_for(look_every);
}

/// The stretch up to here goes into the same commit. The event's time is that of the request: what
/// was sampled before belongs to what came before.
Task<void> CircleMeasurement::commit(std::shared_ptr<CircleMeasurement> test,
                                     TriggerEvent event,
                                     CircleVerdict verdict) {
    const bool last = verdict.answer == CircleAnswer::end;
    if (last) co_await test->bar_is_read_until(event.at);
    if (!test->records()) co_return;
    test->keep_rest();
    EventRecord mark{EventKind::note,
                     event.at,
                     test->context_.scheduler.clock_tie().utc_ns,
                     std::move(verdict.sentence),
                     Fault::none,
                     verdict.sequence};
    const auto receipt = co_await test->context_.journal.commit(
        std::move(mark), static_cast<int>(verdict.sequence) - 1);
    if (!test->records()) co_return;
    test->settle(receipt, verdict.sequence, event.origin);
    if (receipt && last) test->end(true, "Every circle was driven.", Fault::none);
}

void CircleMeasurement::settle(const Result<JournalReceipt>& receipt,
                               std::uint16_t sequence,
                               TriggerOrigin origin) {
    if (!receipt) {
        order_.failed();
        context_.notices.note("Not durable: " + describe(receipt.error()), {Fault::not_durable});
        return refuse(sequence, Error{Fault::not_durable, describe(receipt.error()), {}, {}},
                      origin);
    }
    order_.durable();
    last_receipt_ = *receipt;
    refusal_.reset();
    context_.notices.nothing_refused();
    context_.cnc.acknowledge(*receipt);
}

void CircleMeasurement::end(bool complete, std::string reason, Fault fault) {
    keep_rest();
    record(complete ? EventKind::closed : EventKind::aborted, reason, fault);
    context_.cnc.show(PortState::idle);
    run_.stage = RunState::Stage::closing;
    broken_off_ = !complete;
    if (!complete) context_.cnc.publish_no_run();
    context_.cnc.show(PortState::idle); // a program that stands at a request is to hold now
    spawn(context_.scheduler, close(held(), RunEnding{complete, std::move(reason)}, fault));
}

Task<void>
CircleMeasurement::close(std::shared_ptr<CircleMeasurement> test, RunEnding ending, Fault fault) {
    const MeasurementContext& context = test->context_;
    RunState& run = test->run_;
    const Result<void> closed = co_await context.files.close(ending.complete, ending.reason);
    if (!closed)
        context.notices.note("The run file could not be closed: " + describe(closed.error()),
                             {closed.error().fault});
    context.notices.note(
        "Run " + run.run_id +
            (ending.complete ? " is complete." : " is closed as incomplete: " + ending.reason),
        {fault});
    run.complete = ending.complete;
    run.reason = std::move(ending.reason);
    run.fault = fault;
    if (!closed) run.closing_error = closed.error();
    run.stage = RunState::Stage::closed;
    if (run.complete && closed) co_await test->certify();
}

Task<void> CircleMeasurement::certify() {
    const auto entry = co_await context_.certificates.make(run_.run_id, run_.path);
    if (entry)
        run_.certificate = *entry;
    else
        run_.no_certificate = entry.error();
}

Task<Result<RunEnding>> CircleMeasurement::abort(std::string reason, Orderer by) {
    if (!records()) co_return fail(Fault::no_run_armed, "there is nothing to abort");
    context_.journal.note(order_now(context_.scheduler, "abort", by));
    context_.notices.note("Run " + run_.run_id + " was aborted by " + name_of(by) + ".");
    end(false, std::move(reason), Fault::none);
    co_return co_await await_closing();
}

/// What did not close is told to the one who asked.
Task<Result<RunEnding>> CircleMeasurement::await_closing() {
    const MonotonicTime limit = context_.scheduler.now() + closing_limit;
    while (is_open() && context_.scheduler.now() < limit && !context_.stopping)
        co_await context_.scheduler.sleep_for(look_every);
    if (is_open()) co_return context_.files.not_closed_yet();
    if (run_.closing_error)
        co_return file_not_closed(*run_.closing_error, context_.config.state_directory);
    co_return RunEnding{run_.complete, run_.reason};
}

/// The first thing written is how long nothing was. A test that ended meanwhile has its closing row
/// due.
Task<Result<void>> CircleMeasurement::on_disk_back(MonotonicTime since) {
    co_await context_.journal.let_go();
    if (run_.is_written()) co_return Result<void>{};
    const auto opened = co_await context_.journal.reopen(run_.path);
    if (!opened && !is_open() && opened.error().fault == Fault::refused)
        co_return co_await finish_after_disk();
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const auto contents = co_await context_.files.written_again(run_.path, since);
    if (!contents) co_return tl::unexpected<Error>(contents.error());
    if (is_open()) {
        refusal_.reset();
        co_return Result<void>{};
    }
    const auto closed = co_await context_.files.close(run_.complete, run_.reason);
    if (!closed) co_return closed;
    co_return co_await finish_after_disk();
}

/// The closing row is there; what may be left is to fold the file and to report.
Task<Result<void>> CircleMeasurement::finish_after_disk() {
    const auto tidied = co_await context_.journal.tidy(context_.config.state_directory + "/runs");
    if (!tidied) co_return tidied;
    run_.closing_error.reset();
    if (run_.complete) co_await certify();
    co_return Result<void>{};
}

} // namespace axiscal
