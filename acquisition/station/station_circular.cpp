// A circular test: the ballbar is recorded at its full rate from arming to the last request; each
// request of the CNC becomes durable before it is answered.
#include "acquisition/station/station.hpp"

#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/runfile/certificate_numbers.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/station/held.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr Duration bar_limit = std::chrono::seconds{2}; ///< an older reading is no reading

} // namespace

Result<void> Station::ready_for_circles() const {
    AXISCAL_CHECK(plays_no_tape());
    AXISCAL_CHECK(nothing_goes_on());
    if (!config_.circular || !roles_.ballbar)
        return refuse(Fault::bad_request, "pass",
                      "'circular' needs the tables [ballbar] and [circular] of the station file");
    return ballbar_speaks(); // at rest it may be out of its range
}

Result<void> Station::ballbar_speaks() const {
    const auto& reading = readings_.latest(*roles_.ballbar);
    if (!reading || scheduler_.now() - reading->at > bar_limit)
        return fail(Fault::link_timeout, "the ballbar (" + config_.ballbar->instrument +
                                             ") sends nothing; see 'axiscal devices'");
    return {};
}

CircularSetup Station::circular_setup() const {
    CircularSetup setup = config_.circular->setup;
    setup.bar_temperature_channel = roles_.bar_temperature;
    setup.capture.sample_rate_hz = readings_.bar_rate_hz();
    return setup;
}

Result<RunRecord> Station::circular_header(const ArmRequest& request) const {
    const std::string plane{name_of(config_.circular->setup.plan.plane)};
    AXISCAL_TRY(RunRecord header, make_header_without_axis(header_parts(TestKind::circular, {}),
                                                           plane + "-circle", request));
    AXISCAL_CHECK(
        check_number_is_free(config_.state_directory, header.statements.certificate_number));
    header.plan.remark = "circular test; the table circular holds its plan";
    header.statements.axis = plane;
    return header;
}

Task<Result<std::string>> Station::arm_circular(ArmRequest request) {
    if (auto ready = ready_for_circles(); !ready) co_return tl::unexpected<Error>(ready.error());
    const Held arming{arming_};
    co_return co_await open_circular(std::move(request));
}

Task<Result<std::string>> Station::open_circular(ArmRequest request) {
    AXISCAL_CO_TRY(std::optional<FoundEve> eve, co_await eve_for(takes_circles(request)));
    AXISCAL_CO_TRY(std::vector<PreflightRecord> checks, judge(request, eve));
    if (const std::string objections = open_objections(checks); !objections.empty())
        co_return refuse(Fault::refused, "preflight", objections);
    AXISCAL_CO_TRY(RunRecord header, circular_header(request));
    CircularSetup setup = circular_setup();
    RunAttachments attachments;
    if (eve) {
        setup.uncertainty.eve_um = eve->eve.in(um);
        attachments.eve_source = std::move(eve->run_id);
    }
    std::string path =
        config_.state_directory + "/runs/" + header.run_id + std::string{run_file_ending};
    RunRecord copy = header;
    if (auto opened = co_await journal_.open(path, std::move(copy), std::move(attachments));
        !opened)
        co_return tl::unexpected<Error>(opened.error());
    const StationChannel& bar = channel_of(*roles_.ballbar);
    StreamSetup stream;
    stream.channel = bar.id;
    stream.name = bar.shown;
    stream.unit = stored_unit_of(bar.kind);
    stream.nominal_rate_hz = setup.capture.sample_rate_hz;
    journal_.note(setup, std::vector<StreamSetup>{stream});
    begin_circular(std::move(header), std::move(path), setup);
    note_orders_of_arming(request.by, checks);
    journal_.note(std::move(checks));
    record(EventKind::armed, "Armed for circles.");
    port_->publish_armed();
    perform(SetState{PortState::armed});
    if (auto kept = co_await journal_.flush(); !kept) co_return tl::unexpected<Error>(kept.error());
    co_return run_->header.run_id;
}

void Station::begin_circular(RunRecord header, std::string path, const CircularSetup& setup) {
    newest_run_ = header.run_id;
    newest_run_utc_ns_ = header.opened.utc_ns;
    CurrentRun fresh;
    fresh.header = std::move(header);
    fresh.path = std::move(path);
    run_ = std::move(fresh);
    machine_.reset();
    circular_.emplace(setup);
    last_receipt_.reset();
    left_over_fault_.reset();
    notices_.nothing_refused();
    datum_.reset();
    for (auto& logged : logged_)
        logged.reset();
}

/// A reading of the bar, whatever is going on.
void Station::take_bar(const Sample& sample) {
    readings_.take_bar(sample);
    readings_.log(sample);
    if (!circular_ || !recording()) return;
    if (const auto value = sample.value()) {
        circular_->view.push(*value);
        if (circular_->watch) circular_->watch->see(*value);
    }
    if (auto chunk = circular_->chunker.push(sample)) keep_chunk(*std::move(chunk));
}

void Station::keep_chunk(StreamChunk chunk) {
    if (journal_.note(std::move(chunk))) return;
    if (circular_->dropped++ > 0) return;
    const std::string message = "The disk does not keep up: readings of the ballbar are dropped.";
    note(message);
    record(EventKind::instrument, message, Fault::not_durable);
}

std::optional<Error> Station::take_circular(const TriggerEvent& event) {
    if (circular_->watch && circular_->watch->whole()) circular_->order.circle_seen();
    const CircleVerdict verdict = circular_->order.judge(event);
    const auto refused = [&](Fault fault) {
        if (event.origin != TriggerOrigin::manual)
            perform(Refuse{verdict.sequence, fault, verdict.sentence, event.origin});
        return Error{fault, verdict.sentence, {}, {}};
    };
    switch (verdict.answer) {
    case CircleAnswer::ignore: break;
    case CircleAnswer::again: publish_done(verdict.sequence, false); break;
    case CircleAnswer::abort: end_circular({false, verdict.sentence, Fault::none}); break;
    case CircleAnswer::broken: {
        Error error = refused(Fault::incomplete_run);
        end_circular({false, verdict.sentence, Fault::incomplete_run});
        return error;
    }
    case CircleAnswer::refuse: return refused(verdict.fault);
    case CircleAnswer::begin:
    case CircleAnswer::end:
        circular_->watch.reset();
        if (verdict.once_more) circular_->watch.emplace(circular_->setup);
        spawn(scheduler_, commit_circle(event, verdict.sequence, verdict.sentence,
                                        verdict.answer == CircleAnswer::end));
    }
    return std::nullopt;
}

/// A busy computer may read the CNC before the bar, whose last feed-out then still waits in a
/// buffer.
Task<void> Station::bar_is_read_until(MonotonicTime at) {
    const MonotonicTime limit = scheduler_.now() + bar_limit;
    const auto is_behind = [this, at] {
        const auto& reading = readings_.latest(*roles_.ballbar);
        return !reading || reading->at < at;
    };
    while (circular_ && recording() && is_behind() && scheduler_.now() < limit)
        co_await scheduler_.sleep_for(look_every);
}

/// The stretch up to here goes into the same commit. The event's time is that of the request: what
/// was sampled before belongs to what came before.
Task<void> Station::commit_circle(TriggerEvent event,
                                  std::uint16_t sequence,
                                  std::string sentence,
                                  bool last) {
    if (last) co_await bar_is_read_until(event.at);
    if (!circular_ || !recording()) co_return;
    if (auto rest = circular_->chunker.finish()) keep_chunk(*std::move(rest));
    EventRecord mark{EventKind::note,     event.at,    scheduler_.clock_tie().utc_ns,
                     std::move(sentence), Fault::none, sequence};
    const auto receipt = co_await journal_.commit(std::move(mark), static_cast<int>(sequence) - 1);
    if (!circular_ || !recording()) co_return;
    if (!receipt) {
        circular_->order.failed();
        note("Not durable: " + describe(receipt.error()));
        perform(Refuse{sequence, Fault::not_durable, describe(receipt.error()), event.origin});
        co_return;
    }
    circular_->order.durable();
    last_receipt_ = *receipt;
    run_->refusal.reset();
    notices_.nothing_refused();
    port_->acknowledge(*receipt);
    if (last) end_circular({true, "Every circle was driven.", Fault::none});
}

void Station::end_circular(Close close) {
    if (auto rest = circular_->chunker.finish()) keep_chunk(*std::move(rest));
    record(close.complete ? EventKind::closed : EventKind::aborted, close.reason, close.fault);
    perform(SetState{PortState::idle});
    perform(std::move(close));
}

bool Station::repeats_last_of_circles(const TriggerEvent& event) const {
    return circular_ && run_ && run_->outcome && run_->outcome->complete && last_receipt_ &&
           event.command == TriggerCommand::capture && last_receipt_->sequence() == event.sequence;
}

std::optional<StreamView> Station::stream(std::size_t most) const {
    if (!circular_ || !run_ || !roles_.ballbar) return std::nullopt;
    const StationChannel& bar = channel_of(*roles_.ballbar);
    StreamView view;
    view.run_id = run_->header.run_id;
    view.channel = bar.instrument_name + "/" + bar.name;
    view.recording = recording();
    view.rate_hz = readings_.bar_rate_hz();
    view.samples = circular_->view.samples();
    view.samples_a_stretch = circular_->view.samples_of_each(most);
    view.gaps = circular_->chunker.gaps();
    view.missing = circular_->chunker.missing();
    view.stretches = circular_->view.view(most);
    return view;
}

RunStatus Station::circular_status() const {
    RunStatus run;
    run.run_id = run_->header.run_id;
    run.pass = circular_pass;
    run.file = run_->path;
    run.step = circular_->order.begun();
    run.steps = circular_->order.circles();
    run.done = circular_->order.last_durable();
    run.certificate = run_->certificate;
    if (!run_->closed) run.circle = CircleView{circular_->order.current(), run.step > 0};
    run.state = !run_->closed ? "armed" : run_->outcome->complete ? "complete" : "incomplete";
    const auto tell = [&run](const Error& error) {
        if (error.fault != Fault::none) run.last_fault = fault_name(error.fault);
        run.last_sentence = describe(error);
    };
    if (run_->outcome && !run_->outcome->complete)
        tell({run_->outcome->fault, run_->outcome->reason, {}, {}});
    else if (run_->no_certificate)
        tell(*run_->no_certificate);
    else if (run_->refusal && !run_->closed)
        tell(*run_->refusal);
    else if (circular_->dropped > 0)
        tell({Fault::not_durable,
              std::to_string(circular_->dropped) + " blocks were dropped",
              {},
              {}});
    return run;
}

} // namespace axiscal
