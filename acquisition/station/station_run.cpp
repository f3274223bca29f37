// The run machine's actions, carried out: windows, commits, answers to the CNC, closing.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/stillness.hpp"
#include "acquisition/station/certificate_writer.hpp"
#include "drivers/spawn.hpp"

namespace axiscal {
namespace {

constexpr Duration look_every = std::chrono::milliseconds{20}; // adds at most this to a capture

} // namespace

void Station::feed(const RunInput& input) {
    if (!machine_) return;
    if (const auto* environment = std::get_if<EnvironmentNow>(&input);
        environment && environment->refractive_index_minus_1)
        refractivity_ = *environment->refractive_index_minus_1;
    for (RunAction& action : machine_->handle(input))
        std::visit([this](auto& step) { perform(std::move(step)); }, action);
    const RunView view = machine_->view();
    if (view.datum && (!datum_ || datum_->id != view.datum->id)) {
        laser_epoch_ = view.datum->epoch;
        datum_lost_told_ = false;
    }
    datum_ = view.datum;
}

void Station::perform(PublishArmed) {
    port_->publish_armed();
}

void Station::perform(OpenWindow action) {
    open_window_ = action.window;
    spawn(scheduler_, watch_window(std::move(action)));
}

void Station::perform(CloseWindow action) {
    if (open_window_ == action.window) open_window_ = 0;
}

Task<void> Station::watch_window(OpenWindow window) {
    while (open_window_ == window.window && !stopping_) {
        const MonotonicTime now = scheduler_.now();
        const WindowSearch search = find_still_window(history_, window.from, now, config_.capture);
        Result<Capture> found = fail(Fault::none, "");
        if (search.failure)
            found = tl::unexpected(*search.failure);
        else if (search.window)
            found = make_capture(history_, *search.window, window.approach, config_.capture);
        else if (now >= window.deadline)
            found = tl::unexpected(give_up(search, now - window.from));
        if (found || found.error().fault != Fault::none) {
            feed(EnvironmentNow{refractivity_now()});
            feed(WindowResult{window.window, std::move(found), now});
            co_return;
        }
        co_await scheduler_.sleep_for(look_every);
    }
}

void Station::perform(CommitPoint action) {
    spawn(scheduler_, commit(std::move(action.point)));
}
void Station::perform(CommitDatum action) {
    spawn(scheduler_, commit(std::move(action.datum)));
}
void Station::perform(CommitEvent action) {
    spawn(scheduler_, commit_event(std::move(action)));
}

template <class Record> Task<void> Station::commit(Record record) {
    settle(co_await journal_.commit(std::move(record)));
}

Task<void> Station::commit_event(CommitEvent action) {
    action.event.utc_ns = scheduler_.clock_tie().utc_ns;
    settle(co_await journal_.commit(std::move(action.event), action.step));
}

void Station::settle(Result<JournalReceipt> receipt) {
    const MonotonicTime now = scheduler_.now();
    if (!receipt) {
        note("Not durable: " + describe(receipt.error()));
        return feed(CommitFailed{describe(receipt.error()), now});
    }
    last_receipt_ = *receipt;
    last_refusal_.reset();
    feed(Committed{receipt->sequence(), receipt->step(), now});
}

void Station::perform(Acknowledge action) {
    if (last_receipt_ && last_receipt_->sequence() == action.sequence)
        port_->acknowledge(*last_receipt_);
}

void Station::perform(RepublishDone action) {
    perform(Acknowledge{action.sequence, -1});
}

void Station::perform(Refuse action) {
    last_refusal_ = Error{action.fault, action.sentence, {}, {}};
    note("Refused request " + std::to_string(action.sequence) + ": " + describe(*last_refusal_));
    if (action.origin != TriggerOrigin::manual) port_->refuse(action.sequence, action.fault);
}

void Station::perform(RecordEvent action) {
    action.event.utc_ns = scheduler_.clock_tie().utc_ns;
    journal_.note(std::move(action.event));
}

void Station::perform(SetState action) {
    port_state_ = action.state;
    publish_to_port();
}

void Station::perform(Close action) {
    closing_ = true;
    open_window_ = 0;
    spawn(scheduler_, close_run(std::move(action)));
}

Task<void> Station::close_run(Close action) {
    const Result<void> closed = co_await journal_.close(action.complete, action.reason);
    if (!closed) note("The run file could not be closed: " + describe(closed.error()));
    note("Run " + run_->header.run_id +
         (action.complete ? " is complete." : " is closed as incomplete: " + action.reason));
    last_outcome_ = action;
    closed_ = true;
    closing_ = false;
    if (!action.complete || !closed) co_return;
    auto entry = co_await write_certificate(scheduler_, report_program_, run_->path,
                                            config_.state_directory + "/outbox");
    if (entry)
        certificate_ = *entry;
    else
        last_refusal_ = entry.error();
    note(entry ? "Certificate written: " + *entry : "No certificate: " + describe(entry.error()));
}

} // namespace axiscal
