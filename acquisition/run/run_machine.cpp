#include "acquisition/run/run_machine.hpp"

#include "acquisition/run/resume.hpp"
#include "acquisition/run/sequence.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

// A window result that does not come is a broken promise of the station; the CNC must not wait for
// ever because of it.
constexpr Duration answer_grace = capture_answer_grace;

AcceptedPoint as_accepted(const PointRecord& point) {
    return {point.step, point.sequence, point.planned, point.live_deviation};
}

int count_of(const std::vector<bool>& flags) {
    return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

} // namespace

RunMachine::RunMachine(RunSetup setup)
    : setup_{std::move(setup)}
    , done_(setup_.plan.points.size())
    , skipped_(setup_.plan.points.size())
    , last_reading_(setup_.plan.points.size(), -1) {
    for (const RetakeRecord& retake : setup_.revisions.retakes)
        append_retakes(retake.points);
    retakes_ = static_cast<int>(setup_.revisions.retakes.size());
    for (const ExclusionRecord& exclusion : setup_.revisions.exclusions)
        excluded_.push_back(exclusion.step);
}

RunMachine::RunMachine(RunSetup setup,
                       const RunRecord& open_run,
                       std::uint32_t epoch,
                       MonotonicTime now)
    : RunMachine{std::move(setup)} {
    state_ = PortState::armed;
    armed_ = first_request_after_resume_ = any_accepted_ = true;
    const auto durable = last_durable_request(open_run);
    last_durable_ = durable.sequence;
    last_durable_step_ = durable.step;
    using Readings = std::vector<PointRecord>;
    const Readings& superseded = setup_.revisions.superseded;
    for (const Readings* readings : {&superseded, &open_run.points})
        for (const auto& point : *readings) {
            accepted_.push_back(as_accepted(point));
            if (const auto step = static_cast<std::size_t>(point.step); step < done_.size())
                done_[step] = true;
            if (const auto of = static_cast<std::size_t>(point.planned.step);
                of < last_reading_.size())
                last_reading_[of] = point.step;
        }
    std::ranges::sort(accepted_, {}, &AcceptedPoint::step);
    for (const auto& event : open_run.events)
        if (const auto step = skipped_step(event);
            step && static_cast<std::size_t>(*step) < skipped_.size())
            skipped_[static_cast<std::size_t>(*step)] = true;
    if (!open_run.datums.empty()) {
        datum_ = open_run.datums.back();
        datum_epoch_ = epoch;
        datum_count_ = static_cast<int>(open_run.datums.size());
    }
    // The way began where the run was left; of what was not watched nothing is held against it.
    approach_since_ = now;
    if (datum_) approach_since_ = datum_->at;
    for (const auto& point : open_run.points)
        approach_since_ = std::max(approach_since_, point.window_end);
    approach_unseen_ = datum_.has_value();
}

RunMachine RunMachine::of_closed(RunSetup setup,
                                 const RunRecord& run,
                                 std::uint32_t epoch,
                                 MonotonicTime now) {
    RunMachine machine{std::move(setup), run, epoch, now};
    machine.state_ = PortState::idle;
    machine.closed_ = true;
    machine.complete_ = run.complete;
    machine.first_request_after_resume_ = false; // no program was interrupted
    return machine;
}

RunActions RunMachine::handle(const RunInput& input) {
    RunActions out;
    std::visit([&](const auto& value) { on(value, out); }, input);
    return out;
}

void RunMachine::on(const Arm& arm, RunActions& out) {
    if (armed_ || closed_ || pending_) {
        object(0, {Fault::busy, "This run was armed before.", {}, {}}, out);
        return;
    }
    if (arm.tie_datum) {
        TriggerEvent tie;
        tie.command = TriggerCommand::prepare;
        tie.origin = TriggerOrigin::manual;
        tie.at = arm.at;
        start_datum(tie, out);
        return;
    }
    armed_ = true;
    out.push_back(PublishArmed{});
    record(EventKind::armed, arm.at, "Armed; the CNC ties the datum.", Fault::none, 0, out);
    set_state(PortState::armed, out);
}

void RunMachine::on(const Committed& committed, RunActions& out) {
    if (!pending_ || !pending_->committing || committed.sequence != pending_->sequence ||
        committed.step != pending_->step) {
        ++counters_.stray;
        return;
    }
    const auto settled = std::move(*pending_);
    pending_.reset();
    if (settled.step >= static_cast<int>(done_.size())) { // its order was taken back meanwhile
        ++counters_.stray;
        return close_as_wanted(out);
    }
    last_refusal_.reset();
    if (settled.sequence != 0) {
        last_durable_ = settled.sequence;
        last_durable_step_ = settled.step;
        out.push_back(
            Acknowledge{settled.sequence, settled.step, settled.purpose == Purpose::skip});
    }
    settle_commit(settled, out);
    if (closed_) return;
    if (!next_step() && without_point() == 0) // a skipped one waits for its retake
        return close(true, "Every planned point is durable.", Fault::none, out);
    close_as_wanted(out);
}

void RunMachine::close_as_wanted(RunActions& out) {
    if (!wanted_close_) return;
    const Close wanted = *std::exchange(wanted_close_, std::nullopt);
    close(wanted.complete, wanted.reason, wanted.fault, out);
}

void RunMachine::settle_commit(const Pending& settled, RunActions& out) {
    switch (settled.purpose) {
    case Purpose::datum:
        datum_ = settled.datum;
        datum_epoch_ = settled.datum.epoch;
        datum_broken_ = false;
        approach_since_ = settled.datum.at;
        approach_unseen_ = false;
        if (!std::exchange(armed_, true)) {
            out.push_back(PublishArmed{});
            record(EventKind::armed, settled.datum.at, "Armed at the datum.", Fault::none, 0, out);
        }
        return set_state(PortState::armed, out);
    case Purpose::point:
        done_[static_cast<std::size_t>(settled.step)] = true;
        last_reading_[static_cast<std::size_t>(settled.point.planned.step)] = settled.step;
        accepted_.push_back(as_accepted(settled.point));
        approach_since_ = settled.point.window_end;
        approach_unseen_ = false;
        return set_state(PortState::captured, out);
    case Purpose::skip:
        skipped_[static_cast<std::size_t>(settled.step)] = true;
        return set_state(PortState::armed, out);
    case Purpose::end:
        close(false, ended_by_cnc, Fault::none, out);
        return answer_with_close(out);
    }
}

/// The CNC reads its acknowledgement after the run is closed.
void RunMachine::answer_with_close(RunActions& out) {
    if (auto* closing = std::get_if<Close>(&out.back())) closing->answers_cnc = true;
}

bool RunMachine::is_without_point(int planned_step) const {
    const auto place = static_cast<std::size_t>(planned_step);
    return skipped_[place] && last_reading_[place] < 0;
}

int RunMachine::without_point() const {
    return static_cast<int>(
        std::ranges::count_if(setup_.plan.points, [this](const PlannedPoint& point) {
            return is_without_point(point.step);
        }));
}

bool RunMachine::last_was_skipped() const {
    return last_durable_step_ >= 0 && skipped_[static_cast<std::size_t>(last_durable_step_)];
}

void RunMachine::on(const CommitFailed& failed, RunActions& out) {
    if (!pending_ || !pending_->committing) {
        ++counters_.stray;
        return;
    }
    unwritten_ = std::move(pending_);
    pending_.reset();
    stopped_ = true; // a failed sync is final: what is on disk now is not known
    refuse(
        unwritten_->sequence, unwritten_->origin,
        {Fault::not_durable,
         failed.reason + " Nothing is acknowledged until the disk takes it; then the run goes on.",
         {},
         {}},
        failed.at, out);
    // A point of an order that was taken back meanwhile is not written again.
    if (unwritten_->step >= static_cast<int>(done_.size())) unwritten_.reset();
    set_state(PortState::error, out);
    close_as_wanted(out);
}

/// The record that was captured is written again: the axis stood still for it, whatever it did
/// since. A CNC that has asked anew in the meantime finds its number finished.
void RunMachine::on(const DiskBack& back, RunActions& out) {
    if (back.orders) adopt_orders(*back.orders, *back.on_disk);
    if (back.reopened && closed_) reopen(back.at, out);
    if (!std::exchange(stopped_, false)) return;
    const auto lost = std::exchange(unwritten_, std::nullopt);
    if (closed_) {
        if (lost && holds(*back.on_disk, *lost)) adopt(*lost);
        return;
    }
    set_state(PortState::armed, out);
    if (!lost || pending_) return;
    pending_ = lost;
    if (holds(*back.on_disk, *lost)) return on(Committed{lost->sequence, lost->step, back.at}, out);
    switch (lost->purpose) {
    case Purpose::point: return out.push_back(CommitPoint{lost->point, lost->synchronisation});
    case Purpose::datum: return out.push_back(CommitDatum{lost->datum, lost->synchronisation});
    case Purpose::skip:
    case Purpose::end: return out.push_back(CommitEvent{lost->event, lost->step});
    }
}

/// A sync that fails may have written all the same.
bool RunMachine::holds(const RunRecord& run, const Pending& record) {
    switch (record.purpose) {
    case Purpose::point:
        return std::ranges::find(run.points, record.step, &PointRecord::step) != run.points.end();
    case Purpose::datum:
        return std::ranges::find(run.datums, record.datum.id, &DatumRecord::id) != run.datums.end();
    case Purpose::skip:
    case Purpose::end: break;
    }
    return record.sequence != 0 && last_durable_request(run).sequence == record.sequence;
}

/// The run was closed meanwhile, and nobody is answered: but a retake must not take it twice.
void RunMachine::adopt(const Pending& record) {
    if (record.step < 0) return;
    const auto place = static_cast<std::size_t>(record.step);
    if (record.purpose == Purpose::skip) {
        skipped_[place] = true;
    } else {
        done_[place] = true;
        last_reading_[static_cast<std::size_t>(record.point.planned.step)] = record.step;
        accepted_.push_back(as_accepted(record.point));
    }
    if (record.sequence == 0) return; // a person's
    last_durable_ = record.sequence;
    last_durable_step_ = record.step;
}

void RunMachine::on(const EnvironmentNow& environment, RunActions& /*out*/) {
    scale_minus_1_ = environment.scale_minus_1;
}

void RunMachine::on(const LaserFault& fault, RunActions& out) {
    if (closed_) return;
    record(EventKind::instrument, fault.at, fault.sentence, fault.fault, 0, out);
    const bool counting_broke = breaks_counting(fault.fault);
    if (pending_ && !pending_->committing && (counting_broke || fault.fault == Fault::overspeed))
        refuse_pending({fault.fault, fault.sentence, {}, {}}, fault.at, out);
    if (datum_ && counting_broke) datum_broken_ = true;
    if (datum_ && fault.fault == Fault::datum_lost)
        close_when_idle({false, fault.sentence, Fault::datum_lost}, fault.at, out);
}

void RunMachine::on(const Abort& abort, RunActions& out) {
    if (closed_) return;
    record(EventKind::aborted, abort.at, abort.reason, Fault::none, 0, out);
    close_when_idle({false, abort.reason, Fault::none}, abort.at, out);
}

void RunMachine::on(const Tick& tick, RunActions& out) {
    if (closed_) return;
    // Died between the last commit and the closing.
    if (!pending_ && armed_ && !next_step() && without_point() == 0 && !setup_.plan.points.empty())
        return close(true, "Every planned point is durable.", Fault::none, out);
    if (pending_ && !pending_->committing && tick.now > pending_->deadline + answer_grace)
        refuse_pending({Fault::not_still, "The capture gave no answer in time.", {}, {}}, tick.now,
                       out);
}

void RunMachine::close_when_idle(Close wanted, MonotonicTime at, RunActions& out) {
    if (pending_ && pending_->committing) { // a point on its way to the disk is not thrown away
        if (!wanted_close_) wanted_close_ = std::move(wanted);
        return;
    }
    if (pending_) {
        const auto fault = wanted.fault == Fault::none ? Fault::no_run_armed : wanted.fault;
        refuse_pending({fault, wanted.reason, {}, {}}, at, out);
    }
    close(wanted.complete, wanted.reason, wanted.fault, out);
}

void RunMachine::close(bool complete, std::string reason, Fault fault, RunActions& out) {
    if (closed_) return;
    if (!complete && !retaken_.empty() && plan_is_done()) { // what was measured before still stands
        complete = true;
        reason = "Every planned point is durable; not every retake was done: " + reason;
    }
    closed_ = true;
    complete_ = complete;
    wanted_close_.reset(); // of this end of the run: a retake may open it again
    first_request_after_resume_ = false;
    set_state(fault == Fault::none ? PortState::idle : PortState::error, out);
    out.push_back(Close{complete, std::move(reason), fault});
}

void RunMachine::refuse(std::uint16_t sequence,
                        TriggerOrigin origin,
                        const Error& error,
                        MonotonicTime at,
                        RunActions& out) {
    ++counters_.refused;
    Refuse refusal{sequence, error.fault, error.detail, origin};
    if (origin == TriggerOrigin::manual) { // what the CNC was told last stays what it is
        if (!closed_) record(EventKind::refused, at, describe(error), error.fault, sequence, out);
        out.push_back(std::move(refusal));
        return;
    }
    const bool repeated = last_refusal_ && last_refusal_->sequence == sequence &&
                          last_refusal_->fault == error.fault && last_refusal_->origin == origin;
    // After Close the file is shut, and a request repeated at 200 Hz must not fill it before.
    if (!repeated && !closed_)
        record(EventKind::refused, at, describe(error), error.fault, sequence, out);
    last_refusal_ = refusal;
    out.push_back(std::move(refusal));
}

void RunMachine::refuse(const TriggerEvent& event, const Error& error, RunActions& out) {
    refuse(event.sequence, event.origin, error, event.at, out);
}

void RunMachine::object(std::uint16_t sequence, const Error& error, RunActions& out) {
    out.push_back(Refuse{sequence, error.fault, error.detail, TriggerOrigin::manual});
}

void RunMachine::record(EventKind kind,
                        MonotonicTime at,
                        std::string text,
                        Fault fault,
                        std::uint16_t sequence,
                        RunActions& out) {
    out.push_back(RecordEvent{EventRecord{kind, at, 0, std::move(text), fault, sequence}});
}

void RunMachine::set_state(PortState state, RunActions& out) {
    if (std::exchange(state_, state) != state) out.push_back(SetState{state});
}

std::optional<int> RunMachine::next_step() const {
    for (std::size_t step = 0; step < done_.size(); ++step)
        if (!done_[step] && !skipped_[step]) return static_cast<int>(step);
    return std::nullopt;
}

RunView RunMachine::view() const {
    RunView view;
    view.state = state_;
    view.closed = closed_;
    view.complete = complete_;
    view.stopped = stopped_;
    view.last_durable = last_durable_;
    view.last_durable_step = last_durable_step_;
    view.last_skipped = last_was_skipped();
    view.without_point = without_point();
    if (const auto next = next_step()) view.next = planned_at(*next);
    view.retakes_asked = static_cast<int>(retaken_.size());
    for (std::size_t step = setup_.plan.points.size(); step < done_.size(); ++step)
        if (!done_[step] && !skipped_[step]) ++view.retakes_left;
    view.excluded = static_cast<int>(excluded_.size());
    view.done = count_of(done_);
    view.skipped = count_of(skipped_);
    view.total = static_cast<int>(done_.size());
    view.datum = datum_;
    view.datum_epoch = datum_epoch_;
    view.last_position = last_position_;
    view.last_deviation = last_deviation_;
    view.last_synchronisation = last_synchronisation_;
    view.counters = counters_;
    return view;
}

} // namespace axiscal
