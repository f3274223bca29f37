// The run machine's actions, carried out: commits, answers to the CNC, closing.
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "drivers/loop/spawn.hpp"

#include <utility>
#include <variant>

namespace axiscal {

void PositioningMeasurement::feed(RunInput input) {
    inputs_.push_back({std::move(input), nullptr});
    take_up_inputs();
}

void PositioningMeasurement::take_up_inputs() {
    if (std::exchange(handling_, true)) return;
    while (!inputs_.empty()) {
        const Input next = std::move(inputs_.front());
        inputs_.pop_front();
        answering_ = next.answer;
        handle(next.input);
        answering_.reset();
    }
    handling_ = false;
}

/// From a request of the console, never from within an action.
PositioningMeasurement::Answer PositioningMeasurement::ask(RunInput input) {
    const auto answer = std::make_shared<Answer>();
    refresh_air();
    inputs_.push_back({std::move(input), answer});
    take_up_inputs();
    return *answer;
}

Result<double> PositioningMeasurement::scale_now() const {
    return context_.readings.scale_minus_1(context_.scheduler.now(),
                                           header_.laser.vacuum_wavelength);
}

/// Outside the limits nothing is captured, unless the run was armed in spite of that.
Result<double> PositioningMeasurement::within_limits(Result<double> scale) const {
    const auto& outside = context_.readings.outside();
    if (scale && outside && !limits_waived_) return tl::unexpected<Error>(*outside);
    return scale;
}

void PositioningMeasurement::refresh_air() {
    const Result<double> scale = scale_now();
    if (scale) context_.air.keep_scale(*scale); // also while nothing is captured
    feed(EnvironmentNow{within_limits(scale)});
}

void PositioningMeasurement::feed_with_air(RunInput input) {
    refresh_air();
    feed(std::move(input));
}

void PositioningMeasurement::handle(const RunInput& input) {
    if (const auto* environment = std::get_if<EnvironmentNow>(&input);
        environment && environment->scale_minus_1)
        context_.air.keep_scale(*environment->scale_minus_1);
    for (RunAction& action : machine_.handle(input))
        std::visit([this](auto& step) { perform(std::move(step)); }, action);
    const RunView view = machine_.view();
    if (view.datum && (!datum_ || datum_->id != view.datum->id)) datum_lost_told_ = false;
    datum_ = view.datum;
    datum_epoch_ = view.datum_epoch;
}

void PositioningMeasurement::perform(PublishArmed) {
    context_.port.publish_armed();
}

void PositioningMeasurement::perform(OpenWindow action) {
    open_window_ = action.window;
    const bool not_looked_for =
        reads_polygon(context_.config) && (!reads_faces() || !action.approach);
    spawn(context_.scheduler,
          not_looked_for ? await_typed(held(), action) : watch_window(held(), action));
}

void PositioningMeasurement::perform(CloseWindow action) {
    if (open_window_ == action.window) open_window_ = 0;
}

void PositioningMeasurement::perform(CommitPoint action) {
    spawn(context_.scheduler, commit(held(), std::move(action.point), action.synchronisation));
}
void PositioningMeasurement::perform(CommitDatum action) {
    spawn(context_.scheduler, commit(held(), std::move(action.datum), action.synchronisation));
}
void PositioningMeasurement::perform(CommitEvent action) {
    spawn(context_.scheduler, commit_event(held(), std::move(action)));
}

template <class Record>
Task<void>
PositioningMeasurement::commit(Self test, Record record, std::optional<Synchronisation> at) {
    test->settle(co_await test->context_.journal.commit(std::move(record), at));
}

Task<void> PositioningMeasurement::commit_event(Self test, CommitEvent action) {
    action.event.utc_ns = test->context_.scheduler.clock_tie().utc_ns;
    test->settle(co_await test->context_.journal.commit(std::move(action.event), action.step));
}

void PositioningMeasurement::settle(const Result<JournalReceipt>& receipt) {
    const MonotonicTime now = context_.scheduler.now();
    if (!receipt) {
        const std::string& folder = context_.config.state_directory;
        return feed(CommitFailed{disk_text(receipt.error(), folder), now});
    }
    last_receipt_ = *receipt;
    refusal_.reset();
    context_.notices.nothing_refused();
    if (receipt->step() >= 0) {
        if (taken_++ == 0) first_taken_ = now;
        last_taken_ = now;
    }
    feed(Committed{receipt->sequence(), receipt->step(), now});
}

void PositioningMeasurement::perform(Acknowledge action) {
    publish_done(action.sequence, action.skipped);
    if (action.skipped) warn_of_skip(action);
}

void PositioningMeasurement::publish_done(std::uint16_t sequence, bool skipped) {
    if (!last_receipt_ || last_receipt_->sequence() != sequence) return;
    if (skipped)
        context_.port.acknowledge_skip(*last_receipt_);
    else
        context_.port.acknowledge(*last_receipt_);
}

/// At once: the certificate needs this point, and nobody looks at a run that seems to go well.
void PositioningMeasurement::warn_of_skip(const Acknowledge& action) {
    const PlannedPoint point = machine_.planned_at(action.step);
    const bool up = point.direction == Direction::positive;
    note("Warning: request " + std::to_string(action.sequence) +
         " of the CNC skipped a point: target " + std::to_string(point.target_index + 1) + " " +
         (up ? "upwards" : "downwards") + ", cycle " + std::to_string(point.approach + 1) +
         ". It stays open: 'axiscal retake --target " + std::to_string(point.target_index + 1) +
         " --direction " + (up ? "up" : "down") + " --cycle " + std::to_string(point.approach + 1) +
         " --reason ...' takes it, without it the run is not complete.");
}

void PositioningMeasurement::perform(RepublishDone action) {
    publish_done(action.sequence, action.skipped);
}

void PositioningMeasurement::perform(const Refuse& action) {
    Error error{action.fault, action.sentence, {}, {}};
    if (answering_) answering_->refusal = error;
    if (action.origin == TriggerOrigin::manual) return refused_manually(action, std::move(error));
    refusal_ = error;
    context_.port.refuse_on_port(action.sequence, error);
}

/// Where somebody waits for the answer, the refusal is that person's alone. Of a capture, or of the
/// arming, that ends later the run tells.
void PositioningMeasurement::refused_manually(const Refuse& action, Error error) {
    if (answering_) return;
    context_.notices.note("Refused: " + describe(error), {error.fault});
    (action.sequence == 0 ? not_tied_ : refusal_) = std::move(error);
}

void PositioningMeasurement::perform(RecordEvent action) {
    action.event.utc_ns = context_.scheduler.clock_tie().utc_ns;
    context_.journal.note(std::move(action.event));
}

void PositioningMeasurement::perform(RecordRetake action) {
    action.retake.utc_ns = context_.scheduler.clock_tie().utc_ns;
    if (answering_) answering_->retake = std::move(action);
}

void PositioningMeasurement::perform(RecordExclusion action) {
    for (ExclusionRecord& exclusion : action.exclusions)
        exclusion.utc_ns = context_.scheduler.clock_tie().utc_ns;
    if (answering_) answering_->exclusion = std::move(action);
}

void PositioningMeasurement::perform(SetState action) {
    context_.port.show(action.state);
}

void PositioningMeasurement::perform(Close action) {
    run_.stage = RunState::Stage::closing;
    broken_off_ = !action.complete && !action.answers_cnc;
    open_window_ = 0;
    if (!action.complete)
        context_.port.end_requests(action.answers_cnc ? RunEnd::once_answered : RunEnd::at_once);
    context_.port.publish_anew();
    spawn(context_.scheduler, close(held(), std::move(action)));
}

Task<void> PositioningMeasurement::close(Self test, Close action) {
    RunState& run = test->run_;
    const Result<void> closed = co_await test->context_.files.close(action.complete, action.reason);
    Notices& notices = test->context_.notices;
    if (!closed)
        notices.note("The run file could not be closed: " + describe(closed.error()),
                     {closed.error().fault});
    notices.note(
        "Run " + run.run_id +
            (action.complete ? " is complete." : " is closed as incomplete: " + action.reason),
        {action.fault});
    run.complete = action.complete;
    run.reason = std::move(action.reason);
    run.fault = action.fault;
    run.stage = RunState::Stage::closed;
    test->written_ = closed.has_value();
    if (!closed) run.closing_error = closed.error();
    test->set_up_.begin();
    test->restart_.clear();
    if (run.complete && closed) co_await test->certify();
}

/// Meanwhile another run may have been armed: the answer belongs to this one.
Task<void> PositioningMeasurement::certify() {
    keep_certificate(co_await context_.certificates.make(run_.run_id, run_.path));
}

void PositioningMeasurement::keep_certificate(const Result<std::string>& entry) {
    if (entry)
        run_.certificate = *entry;
    else
        run_.no_certificate = entry.error();
}

} // namespace axiscal
