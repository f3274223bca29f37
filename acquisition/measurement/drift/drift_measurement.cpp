#include "acquisition/measurement/drift/drift_measurement.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "drivers/loop/spawn.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration hear_every = std::chrono::milliseconds{50}; // an abort is heard within it
constexpr const char* lost_zero = "The counter lost its zero: the readings cannot be "
                                  "compared any more.";

/// Of the counter of what is watched.
std::uint32_t epoch_now(const LiveReadings& readings, const RestingTest& test) {
    const auto newest =
        test.setup.of_bar ? readings.latest(test.watched) : readings.reference().newest();
    return newest ? newest->epoch : 0;
}

} // namespace

Task<Result<std::shared_ptr<DriftMeasurement>>> DriftMeasurement::open(MeasurementContext context,
                                                                       RestingTest test) {
    std::string path = context.config.state_directory + "/runs/" + test.header.run_id +
                       std::string{run_file_ending};
    RunAttachments attachments;
    attachments.alignment = test.alignment;
    attachments.setup = test.setup;
    RunRecord header = test.header;
    if (auto opened =
            co_await context.journal.open(path, std::move(header), std::move(attachments));
        !opened)
        co_return tl::unexpected<Error>(opened.error());
    co_return std::make_shared<DriftMeasurement>(context, test, std::move(path));
}

DriftMeasurement::DriftMeasurement(const MeasurementContext& context,
                                   const RestingTest& test,
                                   std::string path)
    : context_(context)
    , watched_{test.watched}
    , recorder_{test.setup, test.watched, epoch_now(context.readings, test),
                context.scheduler.now()} {
    run_.run_id = test.header.run_id;
    run_.path = std::move(path);
    if (test.setup.of_bar) bar_.emplace(SampleHistory::Limits{2 * context.config.capture.window});
}

std::shared_ptr<DriftMeasurement> DriftMeasurement::held() {
    return std::static_pointer_cast<DriftMeasurement>(shared_from_this());
}

void DriftMeasurement::begin(const Orderer& by) {
    context_.journal.note(order_now(context_.scheduler, "drift", by));
    context_.notices.note("Drift test " + run_.run_id + " has begun, ordered by " + name_of(by) +
                          ": leave " + (bar_ ? "machine and ballbar" : "the axis") + " alone.");
    spawn(context_.scheduler, record(held()));
}

void DriftMeasurement::on_sample(const Sample& sample) {
    if (bar_ && sample.channel == watched_ && is_open()) bar_->push(sample);
}

bool DriftMeasurement::goes_on() const {
    return !context_.stopping && run_.stage == RunState::Stage::open;
}

Task<void> DriftMeasurement::record(std::shared_ptr<DriftMeasurement> test) {
    Scheduler& scheduler = test->context_.scheduler;
    while (test->goes_on() && !test->recorder_.is_over()) {
        const MonotonicTime now = scheduler.now(), due = test->recorder_.next_due();
        if (now >= due)
            test->take_readings();
        else
            co_await scheduler.sleep_for(std::min(due - now, hear_every));
        if (auto why = test->hindrance(); why && test->goes_on())
            co_await test->close(false, *std::move(why));
    }
    if (test->goes_on()) co_await test->close(true, "");
}

void DriftMeasurement::take_readings() {
    const StationConfig& config = context_.config;
    const DriftLimits limits{config.capture.window, config.axis.air.oldest,
                             bar_ ? fewest_of_bar : config.capture.minimum_samples};
    const SampleHistory& watched = bar_ ? *bar_ : context_.readings.reference();
    auto readings =
        recorder_.take(context_.scheduler.now(), watched, context_.readings.latest(), limits);
    if (!readings.empty()) context_.journal.note(std::move(readings));
}

std::optional<std::string> DriftMeasurement::hindrance() const {
    if (recorder_.zero_is_lost()) return lost_zero;
    if (const auto why = context_.journal.failure())
        return disk_text(*why, context_.config.state_directory);
    return std::nullopt;
}

Task<void> DriftMeasurement::close(bool complete, std::string reason) {
    if (run_.stage != RunState::Stage::open) co_return;
    run_.stage = RunState::Stage::closing;
    const Result<void> closed = co_await context_.files.close(complete, reason);
    if (!closed) {
        reason = "The run file could not be closed: " +
                 disk_text(closed.error(), context_.config.state_directory);
        run_.closing_error = closed.error();
        co_await context_.journal.let_go(); // the next test or run has a file of its own
    }
    run_.complete = complete && closed;
    context_.notices.note(
        "Drift test " + run_.run_id +
            (run_.complete ? " is complete." : " is closed as incomplete: " + reason),
        {closed ? Fault::none : closed.error().fault});
    run_.reason = std::move(reason);
    run_.stage = RunState::Stage::closed;
    if (run_.complete) co_await certify();
}

Task<void> DriftMeasurement::certify() {
    const auto entry = co_await context_.certificates.make(run_.run_id, run_.path);
    if (entry)
        run_.certificate = *entry;
    else
        run_.no_certificate = entry.error();
}

Task<void> DriftMeasurement::break_off(std::shared_ptr<DriftMeasurement> test, std::string reason) {
    co_await test->close(false, std::move(reason)); // await_closing() tells what became of it
}

Task<Result<RunEnding>> DriftMeasurement::abort(std::string reason, Orderer by) {
    if (run_.stage != RunState::Stage::open)
        co_return fail(Fault::busy, "the drift test is being closed");
    context_.journal.note(order_now(context_.scheduler, "abort", by));
    context_.notices.note("The drift test was aborted by " + name_of(by) + ".");
    spawn(context_.scheduler, break_off(held(), std::move(reason)));
    co_return co_await await_closing();
}

Task<Result<RunEnding>> DriftMeasurement::await_closing() {
    const MonotonicTime limit = context_.scheduler.now() + closing_limit;
    while (is_open() && context_.scheduler.now() < limit && !context_.stopping)
        co_await context_.scheduler.sleep_for(look_every);
    if (is_open()) co_return context_.files.not_closed_yet();
    if (run_.closing_error)
        co_return fail(Fault::not_durable, run_.reason, run_.closing_error->cause);
    co_return RunEnding{run_.complete, run_.reason};
}

void DriftMeasurement::put_on_status(StationStatus& shown) const {
    shown.drift = view();
}

DriftView DriftMeasurement::view() const {
    DriftView view;
    view.run_id = run_.run_id;
    view.state = is_open() ? "recording" : run_.complete ? "complete" : "incomplete";
    view.file = run_.path;
    view.certificate = run_.certificate;
    view.of_bar = bar_.has_value();
    if (!view.of_bar) view.place_mm = recorder_.setup().place.in(mm);
    view.taken = recorder_.taken();
    view.missing = recorder_.missing();
    view.planned = recorder_.planned();
    if (const auto range = recorder_.range()) view.range_um = range->in(um);
    if (is_open())
        view.seconds_left = std::max(0.0, seconds_of(recorder_.end() - context_.scheduler.now()));
    view.sentence = run_.no_certificate ? describe(*run_.no_certificate) : run_.reason;
    return view;
}

} // namespace axiscal
