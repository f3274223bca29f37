#include "acquisition/measurement/positioning/positioning_measurement.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/arming.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {

Task<Result<std::shared_ptr<PositioningMeasurement>>>
PositioningMeasurement::open(PositioningContext context, ArmedRun armed) {
    std::string path = context.config.state_directory + "/runs/" + armed.header.run_id +
                       std::string{run_file_ending};
    RunRecord header = armed.header;
    if (auto opened =
            co_await context.journal.open(path, std::move(header), std::move(armed.attachments));
        !opened) {
        Error why = opened.error();
        why.detail += " " + way_out(why.cause, context.config.state_directory);
        co_return tl::unexpected<Error>(std::move(why));
    }
    RunMachine machine{run_setup_of(context, armed.header, std::move(armed.reading))};
    auto test = std::make_shared<PositioningMeasurement>(context, std::move(armed.header),
                                                         std::move(path), std::move(machine));
    test->limits_waived_ = waives_limits(armed.checks);
    test->checks_ = std::move(armed.checks);
    test->datum_by_cnc_ = armed.datum_by_cnc;
    test->orderer_has_gone_ = std::move(armed.orderer_has_gone);
    co_return test;
}

PositioningMeasurement::PositioningMeasurement(const PositioningContext& context,
                                               RunRecord header,
                                               std::string path,
                                               RunMachine machine)
    : context_(context)
    , header_{std::move(header)}
    , machine_{std::move(machine)}
    , set_up_{reference_word(context.config)} {
    run_.run_id = header_.run_id;
    run_.path = std::move(path);
    for (const int channel : context.roles.environment())
        environment_.push_back({channel, {}});
}

PositioningMeasurement::Self PositioningMeasurement::held() {
    return std::static_pointer_cast<PositioningMeasurement>(shared_from_this());
}

std::string PositioningMeasurement::runs_folder() const {
    return context_.config.state_directory + "/runs";
}

void PositioningMeasurement::note(const std::string& sentence) const {
    context_.notices.note(sentence, {Fault::none, run_.run_id});
}

void PositioningMeasurement::record(EventKind kind, std::string sentence, Fault fault) {
    perform(RecordEvent{{kind, context_.scheduler.now(), 0, std::move(sentence), fault, 0}});
}

void PositioningMeasurement::begin(const Orderer& by) {
    log_environment_anew();
    note_arming(context_, run_.run_id, by, checks_);
    context_.journal.note(std::move(checks_));
    feed_with_air(Arm{context_.scheduler.now(), !datum_by_cnc_});
}

Task<Result<void>> PositioningMeasurement::await_datum() {
    const MonotonicTime deadline =
        context_.scheduler.now() + context_.config.capture.timeout + laser_limit;
    while (!datum_ && records() && !not_tied_ && context_.scheduler.now() < deadline)
        co_await context_.scheduler.sleep_for(look_every);
    if (datum_ && records()) {
        orderer_has_gone_ = nullptr; // the connection that it asks about ends with the answer
        co_return Result<void>{};
    }
    const Error why =
        not_tied_.value_or(Error{Fault::not_still, "no datum was tied in time", {}, {}});
    feed(Abort{"The datum could not be tied: " + describe(why), context_.scheduler.now()});
    (void)co_await await_closing(); // a reader of the file must not hold up the answer
    orderer_has_gone_ = nullptr;
    co_return tl::unexpected<Error>(why);
}

void PositioningMeasurement::on_sample(const Sample& sample) {
    if (sample.channel == context_.roles.laser)
        take_reading(sample);
    else
        log_environment(sample);
}

void PositioningMeasurement::take_reading(const Sample& sample) {
    watch_set_up(sample);
    if (!datum_ || !records()) return;
    if (sample.epoch != datum_epoch_) {
        if (!std::exchange(datum_lost_told_, true))
            feed(LaserFault{Fault::datum_lost,
                            "The " + reference_word(context_.config) + "'s counter lost its zero.",
                            sample.at});
        return;
    }
    const auto value = sample.value();
    if (!value) return;
    if (const auto place = place_of(metre(*value))) // else no port judges its halts
        context_.port.publish_position(sample.at, place->in(mm));
}

/// While no run is open nobody captures; the counter's zero is watched by its readings: since the
/// run was closed, or, of a run that an earlier daemon closed, since the start.
void PositioningMeasurement::watch_set_up(const Sample& sample) {
    if (is_open() || !datum_) return;
    set_up_.take(sample, {true, datum_epoch_, restart_.empty(), context_.config.capture.fastest});
}

void PositioningMeasurement::log_environment(const Sample& sample) {
    const auto seen = std::ranges::find(environment_, sample.channel, &Logged::channel);
    if (seen == environment_.end() || !records() || !sample.value()) return;
    if (seen->at && sample.at - *seen->at < log_every) return;
    seen->at = sample.at;
    context_.journal.note(
        std::vector<EnvironmentReading>{{sample.channel, sample.at, *sample.value()}});
}

void PositioningMeasurement::log_environment_anew() {
    for (Logged& logged : environment_) {
        logged.at.reset();
        if (const auto& sample = context_.readings.latest(logged.channel)) log_environment(*sample);
    }
}

/// It answers each of them; of a closed one the repeat of its last request.
bool PositioningMeasurement::on_trigger(const TriggerEvent& event) {
    feed_with_air(event);
    return true;
}

void PositioningMeasurement::on_time(MonotonicTime now) {
    feed_with_air(Tick{now});
}

Result<void> PositioningMeasurement::trigger() {
    if (!records()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    TriggerEvent event;
    event.at = context_.scheduler.now();
    event.origin = TriggerOrigin::manual;
    if (auto refusal = ask(event).refusal) return tl::unexpected<Error>(*std::move(refusal));
    return {};
}

Task<Result<RunEnding>> PositioningMeasurement::abort(std::string reason, Orderer by) {
    if (!records()) co_return fail(Fault::no_run_armed, "there is nothing to abort");
    context_.journal.note(order_now(context_.scheduler, "abort", by));
    note("Run " + run_.run_id + " was aborted by " + name_of(by) + ".");
    feed(Abort{std::move(reason), context_.scheduler.now()});
    co_return co_await await_closing();
}

/// What did not close is told to the one who asked: 200 would be a lie. So would "aborted" of a run
/// whose last point was on its way.
Task<Result<RunEnding>> PositioningMeasurement::await_closing() {
    const MonotonicTime limit = context_.scheduler.now() + closing_limit;
    while (is_open() && context_.scheduler.now() < limit && !context_.stopping)
        co_await context_.scheduler.sleep_for(look_every);
    if (is_open()) co_return context_.files.not_closed_yet();
    if (run_.closing_error)
        co_return file_not_closed(*run_.closing_error, context_.config.state_directory);
    co_return RunEnding{run_.complete, run_.reason};
}

/// Until it answers, an instrument keeps points from being taken, and no more than that.
void PositioningMeasurement::judge_instruments() {
    if (!records() || !resumed_) return;
    std::string exchanged =
        exchanged_instrument(header_, serials_of_run(context_.roles, context_.instruments));
    if (exchanged.empty()) return;
    resumed_ = false; // told once
    note(exchanged);
    feed(Abort{std::move(exchanged), context_.scheduler.now()});
}

} // namespace axiscal
