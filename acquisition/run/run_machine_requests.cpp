// The third of RunMachine that deals with numbers: which request is new, repeated, out of order,
// and what it asks for.
#include "acquisition/run/resume.hpp"
#include "acquisition/run/run_machine.hpp"
#include "acquisition/run/sequence.hpp"

#include <string>
#include <utility>

namespace axiscal {
namespace {

Error not_armed() {
    return {Fault::no_run_armed, {}, {}, {}};
}

std::string number(std::uint16_t sequence) {
    return std::to_string(sequence);
}

} // namespace

void RunMachine::on(const TriggerEvent& event, RunActions& out) {
    auto request = event;
    if (event.origin == TriggerOrigin::cnc) {
        if (answered_by_order(event, out)) return;
    } else {
        request.sequence = next_sequence(last_durable_);
        if (pending_ && event.origin == TriggerOrigin::dwell) {
            ++counters_.doubled;
            return;
        }
        if (const auto objection = objection_now()) {
            if (event.origin == TriggerOrigin::dwell) return refuse(request, *objection, out);
            return object(request.sequence, *objection, out);
        }
    }
    start_command(request, out);
}

/// To a request without a number, whatever it asks for.
std::optional<Error> RunMachine::objection_now() const {
    if (!closed_ && !armed_ && pending_)
        return Error{Fault::busy, "The reading is being tied to the datum just now.", {}, {}};
    if (closed_ || !armed_) return not_armed();
    if (stopped_) return Error{Fault::not_durable, {}, {}, {}};
    if (pending_) return Error{Fault::busy, "A capture is under way.", {}, {}};
    return std::nullopt;
}

/// Everything that the number alone decides. True: nothing more is to be done.
bool RunMachine::answered_by_order(const TriggerEvent& event, RunActions& out) {
    const auto sequence = event.sequence;
    const bool finished_before = sequence != 0 && sequence == last_durable_;
    if (closed_ || !armed_) {
        if (closed_ && complete_ && finished_before)
            out.push_back(RepublishDone{sequence, last_durable_step_, last_was_skipped()});
        else if (sequence != 0)
            refuse(event, not_armed(), out);
        return true;
    }
    if (first_request_after_resume_ && answered_after_resume(event, out)) return true;
    if (sequence == 0) return true;
    // What stands there when a run is armed belongs to another run: the baseline.
    if (event.standing && !any_accepted_) return true;
    if (finished_before) {
        ++counters_.republished;
        out.push_back(RepublishDone{sequence, last_durable_step_, last_was_skipped()});
        return true;
    }
    if (pending_ && pending_->sequence == sequence && event.command != TriggerCommand::abort) {
        ++counters_.doubled;
        return true;
    }
    if (event.command == TriggerCommand::abort &&
        (pending_ || stopped_ || sequence != next_sequence(last_durable_))) {
        on(Abort{"The CNC aborted the run with request " + number(sequence) + ".", event.at}, out);
        return true;
    }
    if (stopped_) {
        refuse(event,
               {Fault::not_durable,
                "The disk takes no records; once it does the run goes on by itself.",
                {},
                {}},
               out);
        return true;
    }
    if (sequence == next_sequence(last_durable_)) return false;
    ++counters_.out_of_order;
    refuse(event, {Fault::out_of_order, describe_disorder(sequence, last_durable_), {}, {}}, out);
    return true;
}

bool RunMachine::answered_after_resume(const TriggerEvent& event, RunActions& out) {
    const auto verdict = judge_first_request(last_durable_, event.sequence);
    if (verdict.decision == ResumeDecision::wait_for_request) return true;
    first_request_after_resume_ = false;
    if (verdict.decision == ResumeDecision::close_sequence_lost) {
        refuse(event, {Fault::sequence_lost, verdict.sentence, {}, {}}, out);
        close(false, verdict.sentence, Fault::sequence_lost, out);
        return true;
    }
    record(EventKind::resumed, event.at, verdict.sentence, Fault::none, event.sequence, out);
    return false;
}

void RunMachine::start_command(const TriggerEvent& event, RunActions& out) {
    any_accepted_ = true;
    switch (event.command) {
    case TriggerCommand::prepare: return start_datum(event, out);
    case TriggerCommand::capture: return start_point(event, out);
    case TriggerCommand::skip: return commit_event(event, Purpose::skip, out);
    case TriggerCommand::abort:
    case TriggerCommand::end: return commit_event(event, Purpose::end, out);
    }
}

void RunMachine::commit_event(const TriggerEvent& event, Purpose purpose, RunActions& out) {
    if (purpose == Purpose::skip)
        if (const auto objection = objection_to_skip(event)) return refuse(event, *objection, out);
    Pending pending;
    pending.purpose = purpose;
    pending.origin = event.origin;
    pending.sequence = event.sequence;
    pending.committing = true;
    EventRecord note;
    note.at = event.at;
    note.sequence = event.sequence;
    if (purpose == Purpose::skip) {
        pending.step = *next_step();
        note.kind = EventKind::skipped;
        note.text = skip_text(pending.step);
    } else {
        note.kind = EventKind::aborted;
        note.text = event.command == TriggerCommand::end
                        ? ended_by_cnc
                        : "The CNC aborted the run.";
    }
    pending.event = note;
    set_state(PortState::settling, out);
    out.push_back(CommitEvent{note, pending.step});
    pending_ = std::move(pending);
}

/// It names its point as a capture does: another one must not be lost by it.
std::optional<Error> RunMachine::objection_to_skip(const TriggerEvent& event) const {
    const auto next = next_step();
    if (!next) return Error{Fault::bad_command, "Nothing is left to skip.", {}, {}};
    if (!datum_) return no_datum_yet();
    return objection_to_claim(event, *next);
}

} // namespace axiscal
