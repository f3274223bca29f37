// The run machine's actions, carried out: windows, commits, answers to the CNC, closing.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/stillness.hpp"
#include "acquisition/live/time_limits.hpp"
#include "drivers/loop/spawn.hpp"

#include <filesystem>
#include <malloc.h>

namespace axiscal {
namespace {

constexpr Duration after_the_start = std::chrono::seconds{1};

} // namespace

void Station::feed(RunInput input) {
    if (!machine_) return;
    inputs_.push_back({std::move(input), nullptr});
    take_up_inputs();
}

void Station::take_up_inputs() {
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
Station::Answer Station::ask(RunInput input) {
    const auto answer = std::make_shared<Answer>();
    refresh_air();
    inputs_.push_back({std::move(input), answer});
    take_up_inputs();
    return *answer;
}

void Station::refresh_air() {
    const Result<double> scale = live_scale_now();
    if (scale) readings_.keep_scale(*scale); // also while nothing is captured
    feed(EnvironmentNow{within_limits(scale)});
}

void Station::feed_with_air(RunInput input) {
    if (!machine_) return;
    refresh_air();
    feed(std::move(input));
}

void Station::handle(const RunInput& input) {
    if (const auto* environment = std::get_if<EnvironmentNow>(&input);
        environment && environment->scale_minus_1)
        readings_.keep_scale(*environment->scale_minus_1);
    for (RunAction& action : machine_->handle(input))
        std::visit([this](auto& step) { perform(std::move(step)); }, action);
    const RunView view = machine_->view();
    if (view.datum && (!datum_ || datum_->id != view.datum->id)) {
        datum_lost_told_ = false;
    }
    datum_ = view.datum;
    datum_epoch_ = view.datum_epoch;
}

void Station::perform(PublishArmed) {
    publish_armed();
}

void Station::perform(OpenWindow action) {
    open_window_ = action.window;
    const bool not_looked_for = reads_polygon() && (!reads_faces() || !action.approach);
    spawn(scheduler_, not_looked_for ? await_typed(action) : watch_window(action));
}

void Station::perform(CloseWindow action) {
    if (open_window_ == action.window) open_window_ = 0;
}

/// From which side the axis came, an autocollimator cannot see.
Task<void> Station::watch_window(OpenWindow window) {
    const std::optional<ApproachClaim> claim = reads_faces() ? std::nullopt : window.approach;
    StillWindowSearch still{window.from, config_.capture};
    while (open_window_ == window.window && !stopping_) {
        const MonotonicTime now = scheduler_.now();
        if (drop_order_of_who_has_gone(now)) co_return;
        const WindowSearch search = still.look(readings_.reference(), now);
        Result<Capture> found = fail(Fault::none, "");
        if (search.failure)
            found = tl::unexpected(*search.failure);
        else if (search.window)
            found = make_capture(readings_.reference(), *search.window, claim, config_.capture);
        else if (now >= window.deadline)
            found = tl::unexpected(reads_faces() ? no_still_face(search.verdict)
                                                 : not_still(search, now - window.from));
        if (found || found.error().fault != Fault::none) {
            feed_with_air(WindowResult{window.window, std::move(found), now});
            co_return;
        }
        co_await scheduler_.sleep_for(look_every);
    }
}

/// Asked in each look for the datum, so that none is tied for nobody: the part program waits for
/// that alone, and goes on by itself.
bool Station::drop_order_of_who_has_gone(MonotonicTime now) {
    if (datum_ || !run_->orderer_has_gone || !run_->orderer_has_gone()) return false;
    feed(Abort{"Who armed the run hung up before its datum was tied.", now});
    run_->not_tied =
        Error{Fault::refused, "who armed the run hung up before its datum was tied", {}, {}};
    return true;
}

void Station::perform(CommitPoint action) {
    spawn(scheduler_, commit(std::move(action.point), action.synchronisation));
}
void Station::perform(CommitDatum action) {
    spawn(scheduler_, commit(std::move(action.datum), action.synchronisation));
}
void Station::perform(CommitEvent action) {
    spawn(scheduler_, commit_event(std::move(action)));
}

template <class Record>
Task<void> Station::commit(Record record, std::optional<Synchronisation> synchronisation) {
    settle(co_await journal_.commit(std::move(record), synchronisation));
}

Task<void> Station::commit_event(CommitEvent action) {
    action.event.utc_ns = scheduler_.clock_tie().utc_ns;
    settle(co_await journal_.commit(std::move(action.event), action.step));
}

void Station::settle(Result<JournalReceipt> receipt) {
    const MonotonicTime now = scheduler_.now();
    if (!receipt) return feed(CommitFailed{disk_text(receipt.error()), now});
    last_receipt_ = *receipt;
    run_->refusal.reset();
    notices_.nothing_refused();
    if (receipt->step() >= 0) {
        if (run_->taken++ == 0) run_->first_taken = now;
        run_->last_taken = now;
    }
    feed(Committed{receipt->sequence(), receipt->step(), now});
}

void Station::perform(Acknowledge action) {
    publish_done(action.sequence, action.skipped);
    if (action.skipped) warn_of_skip(action);
}

void Station::publish_done(std::uint16_t sequence, bool skipped) {
    if (!last_receipt_ || last_receipt_->sequence() != sequence) return;
    if (skipped)
        port_->acknowledge_skip(*last_receipt_);
    else
        port_->acknowledge(*last_receipt_);
}

/// At once: the certificate needs this point, and nobody looks at a run that seems to go well.
void Station::warn_of_skip(const Acknowledge& action) {
    const PlannedPoint point = machine_->planned_at(action.step);
    const bool up = point.direction == Direction::positive;
    note("Warning: request " + std::to_string(action.sequence) +
         " of the CNC skipped a point: target " + std::to_string(point.target_index + 1) + " " +
         (up ? "upwards" : "downwards") + ", cycle " + std::to_string(point.approach + 1) +
         ". It stays open: 'axiscal retake --target " + std::to_string(point.target_index + 1) +
         " --direction " + (up ? "up" : "down") + " --cycle " + std::to_string(point.approach + 1) +
         " --reason ...' takes it, without it the run is not complete.");
}

void Station::perform(RepublishDone action) {
    publish_done(action.sequence, action.skipped);
}

void Station::perform(const Refuse& action) {
    Error error{action.fault, action.sentence, {}, {}};
    if (answering_) answering_->refusal = error;
    if (action.origin == TriggerOrigin::manual) return refused_manually(action, std::move(error));
    run_->refusal = error;
    refuse_on_port(action.sequence, error);
}

/// Where somebody waits for the answer, the refusal is that person's alone. Of a capture, or of the
/// arming, that ends later the run tells.
void Station::refused_manually(const Refuse& action, Error error) {
    if (answering_) return;
    note("Refused: " + describe(error));
    (action.sequence == 0 ? run_->not_tied : run_->refusal) = std::move(error);
}

void Station::perform(RecordEvent action) {
    action.event.utc_ns = scheduler_.clock_tie().utc_ns;
    journal_.note(std::move(action.event));
}

void Station::record(EventKind kind, std::string sentence, Fault fault) {
    perform(RecordEvent{{kind, scheduler_.now(), 0, std::move(sentence), fault, 0}});
}

void Station::perform(RecordRetake action) {
    action.retake.utc_ns = scheduler_.clock_tie().utc_ns;
    if (answering_) answering_->retake = std::move(action);
}

void Station::perform(RecordExclusion action) {
    for (ExclusionRecord& exclusion : action.exclusions)
        exclusion.utc_ns = scheduler_.clock_tie().utc_ns;
    if (answering_) answering_->exclusion = std::move(action);
}

void Station::perform(SetState action) {
    show(action.state);
}

void Station::perform(Close action) {
    run_->closing = true;
    run_->broken_off = !action.complete && !action.answers_cnc;
    open_window_ = 0;
    if (!action.complete)
        port_->publish_no_run(action.answers_cnc ? RunEnd::once_answered : RunEnd::at_once);
    publish_to_port();
    spawn(scheduler_, close_run(std::move(action)));
}

Task<void> Station::close_run(Close action) {
    const Result<void> closed = co_await files_.close(action.complete, action.reason);
    if (!closed) note("The run file could not be closed: " + describe(closed.error()));
    note("Run " + run_->header.run_id +
         (action.complete ? " is complete." : " is closed as incomplete: " + action.reason));
    run_->outcome = action;
    run_->closed = true;
    run_->closing = false;
    run_->closing_row_durable = closed.has_value();
    if (!closed) run_->closing_error = closed.error();
    set_up_.begin();
    interruption_.clear();
    if (action.complete && closed) co_await certify(run_->header.run_id, run_->path);
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
    return (run_ && run_->path == path) || (circles_ && circles_->run().path == path) ||
           (resting_ && resting_->run().path == path);
}

/// The closed ones are looked into one by one and late: beside the loop, and behind whoever waited
/// for the station.
Task<void> Station::certify_left_over(StoredRuns stored) {
    co_await wait_for_readers();
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

/// Meanwhile a new run may have been armed: the answer belongs to the run named here.
Task<void> Station::certify(std::string run_id, std::string path) {
    const auto entry = co_await certificates_.make(run_id, std::move(path));
    if (!run_ || run_->header.run_id != run_id) co_return;
    if (entry)
        run_->certificate = *entry;
    else
        run_->no_certificate = entry.error();
}

} // namespace axiscal
