#include "acquisition/measurement/circular/circle_measurement.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/arming.hpp"
#include "acquisition/measurement/circular/left_circles.hpp"
#include "acquisition/measurement/revisable.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/stream_record.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace axiscal {

Task<Result<std::shared_ptr<CircleMeasurement>>> CircleMeasurement::open(CncContext context,
                                                                         ArmedCircles armed) {
    std::string path = context.config.state_directory + "/runs/" + armed.header.run_id +
                       std::string{run_file_ending};
    RunAttachments attachments;
    attachments.eve_source = std::move(armed.eve_source);
    RunRecord header = armed.header;
    if (auto opened =
            co_await context.journal.open(path, std::move(header), std::move(attachments));
        !opened)
        co_return tl::unexpected<Error>(opened.error());
    auto test = std::make_shared<CircleMeasurement>(context, std::move(armed.header),
                                                    std::move(path), armed.setup);
    test->checks_ = std::move(armed.checks);
    context.journal.note(armed.setup, std::vector<StreamSetup>{test->stream_setup()});
    co_return test;
}

Task<Result<std::shared_ptr<CircleMeasurement>>> CircleMeasurement::reopen(CncContext context,
                                                                           std::string path,
                                                                           RunFileContents contents,
                                                                           CircleResume verdict) {
    if (auto reopened = co_await context.journal.reopen(path); !reopened)
        co_return tl::unexpected<Error>(reopened.error());
    std::string sentence = interruption_text(contents, verdict, context.scheduler.now());
    const auto setup = std::get<CircularSetup>(contents.attachments.setup);
    auto test = std::make_shared<CircleMeasurement>(context, std::move(contents.run),
                                                    std::move(path), setup);
    test->order_ = CircleOrder{setup.plan, verdict.before};
    if (!contents.blocks.empty())
        test->chunker_ =
            StreamChunker{contents.blocks.back(), last_sighting_of(contents).has_value()};
    test->interruption_.emplace();
    test->interruption_->before = verdict.before;
    test->interruption_->sentence = std::move(sentence);
    co_return test;
}

CircleMeasurement::CircleMeasurement(const CncContext& context,
                                     RunRecord header,
                                     std::string path,
                                     const CircularSetup& setup)
    : context_(context)
    , header_{std::move(header)}
    , setup_{setup}
    , bar_{*context.roles.ballbar}
    , order_{setup.plan} {
    run_.run_id = header_.run_id;
    run_.path = std::move(path);
    for (const int channel : context.roles.environment())
        environment_.push_back({channel, {}});
    if (context.roles.bar_temperature) environment_.push_back({*context.roles.bar_temperature, {}});
}

std::shared_ptr<CircleMeasurement> CircleMeasurement::held() {
    return std::static_pointer_cast<CircleMeasurement>(shared_from_this());
}

StreamSetup CircleMeasurement::stream_setup() const {
    const StationChannel& bar = context_.instruments.channels()[static_cast<std::size_t>(bar_)];
    StreamSetup stream;
    stream.channel = bar.id;
    stream.name = bar.shown;
    stream.unit = stored_unit_of(bar.kind);
    stream.nominal_rate_hz = setup_.capture.sample_rate_hz;
    return stream;
}

void CircleMeasurement::begin(const Orderer& by) {
    note_arming(context_, run_.run_id, by, checks_);
    context_.journal.note(std::move(checks_));
    record(EventKind::armed, "Armed for circles.");
    context_.cnc.publish_armed();
    context_.cnc.show(PortState::armed);
}

Task<Result<void>> CircleMeasurement::go_on() {
    resumed_ = true;
    const CirclesBefore before = interruption_->before;
    const std::string sentence = std::move(interruption_->sentence);
    interruption_.reset();
    if (before.whole) { // a CNC that stands at it may ask once more
        const auto last = static_cast<std::uint16_t>(before.last);
        AXISCAL_CO_TRY(last_receipt_, co_await context_.journal.receipt_for_circle(last));
    }
    record(EventKind::interrupted, sentence);
    if (before.last == 0) context_.cnc.publish_armed();
    context_.cnc.show(PortState::armed);
    context_.notices.note("Run " + run_.run_id + " goes on. " + sentence);
    co_return co_await context_.journal.flush();
}

void CircleMeasurement::record(EventKind kind, std::string sentence, Fault fault) {
    const MonotonicTime now = context_.scheduler.now();
    context_.journal.note(EventRecord{kind, now, context_.scheduler.clock_tie().utc_ns,
                                      std::move(sentence), fault, 0});
}

void CircleMeasurement::on_sample(const Sample& sample) {
    if (!records()) return;
    if (sample.channel == bar_)
        take_bar(sample);
    else
        log_environment(sample);
}

void CircleMeasurement::take_bar(const Sample& sample) {
    if (const auto value = sample.value()) {
        view_.push(*value);
        if (watch_) watch_->see(*value);
    }
    if (auto chunk = chunker_.push(sample)) keep(*std::move(chunk));
}

void CircleMeasurement::log_environment(const Sample& sample) {
    const auto seen = std::ranges::find(environment_, sample.channel, &Logged::channel);
    if (seen == environment_.end() || !sample.value()) return;
    if (seen->at && sample.at - *seen->at < log_every) return;
    seen->at = sample.at;
    context_.journal.note(
        std::vector<EnvironmentReading>{{sample.channel, sample.at, *sample.value()}});
}

void CircleMeasurement::keep(StreamChunk chunk) {
    if (context_.journal.note(std::move(chunk))) return;
    if (dropped_++ > 0) return;
    const std::string message = "The disk does not keep up: readings of the ballbar are dropped.";
    context_.notices.note(message, {Fault::not_durable});
    record(EventKind::instrument, message, Fault::not_durable);
}

void CircleMeasurement::keep_rest() {
    if (auto rest = chunker_.finish()) keep(*std::move(rest));
}

void CircleMeasurement::judge_instruments() {
    if (!records() || !resumed_) return;
    std::string exchanged = exchanged_instrument(header_, serials_of_circles(context_));
    if (exchanged.empty()) return;
    resumed_ = false; // told once
    context_.notices.note(exchanged, {Fault::unknown_instrument});
    end(false, std::move(exchanged), Fault::unknown_instrument);
}

RunStatus CircleMeasurement::status() const {
    RunStatus status;
    status.run_id = run_.run_id;
    status.pass = name_of(TestKind::circular);
    status.file = run_.path;
    status.step = order_.begun();
    status.steps = order_.circles();
    status.done = order_.last_durable();
    status.certificate = run_.certificate;
    if (is_open()) status.circle = CircleView{order_.current(), status.step > 0};
    status.state = is_open() ? "armed" : run_.complete ? "complete" : "incomplete";
    if (const auto error = trouble()) {
        if (error->fault != Fault::none) status.last_fault = fault_name(error->fault);
        status.last_sentence = describe(*error);
    }
    return status;
}

std::optional<Error> CircleMeasurement::trouble() const {
    if (!is_open() && !run_.complete) return Error{run_.fault, run_.reason, {}, {}};
    if (run_.no_certificate) return run_.no_certificate;
    if (refusal_ && is_open()) return refusal_;
    if (dropped_ == 0) return std::nullopt;
    return Error{Fault::not_durable, std::to_string(dropped_) + " blocks were dropped", {}, {}};
}

Result<std::shared_ptr<Revisable>> CircleMeasurement::to_be_added_to() {
    return fail(Fault::no_run_armed, "the last run is a circular test: its circles are driven "
                                     "again");
}

void CircleMeasurement::put_on_status(StationStatus& shown) const {
    shown.run = status();
}

void CircleMeasurement::put_on_port(PortStatus& status) const {
    if (!is_open()) status.run_complete = run_.complete;
}

std::optional<StreamView> CircleMeasurement::stream(std::size_t most) const {
    const StationChannel& bar = context_.instruments.channels()[static_cast<std::size_t>(bar_)];
    StreamView stream;
    stream.run_id = run_.run_id;
    stream.channel = bar.instrument_name + "/" + bar.name;
    stream.recording = records();
    stream.rate_hz = context_.readings.bar_rate_hz();
    stream.samples = view_.samples();
    stream.samples_a_stretch = view_.samples_of_each(most);
    stream.gaps = chunker_.gaps();
    stream.missing = chunker_.missing();
    stream.stretches = view_.view(most);
    return stream;
}

} // namespace axiscal
