// A run of an earlier daemon: left open it goes on, closed it can be added to.
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {

Task<Result<std::shared_ptr<PositioningMeasurement>>>
PositioningMeasurement::reopen(PositioningContext context,
                               std::string path,
                               RunFileContents contents,
                               std::shared_ptr<const ReadingRule> reading,
                               std::string proof) {
    if (auto reopened = co_await context.journal.reopen(path); !reopened)
        co_return tl::unexpected<Error>(reopened.error());
    const auto newest = context.readings.reference().newest();
    const std::uint32_t epoch = newest ? newest->epoch : 0;
    RunRecord header = contents.run;
    header.points.clear();
    const bool waived = waives_limits(contents.revisions.preflight);
    const std::size_t answers = contents.revisions.answers.size();
    RunSetup setup = run_setup_of(context, contents.run, std::move(reading));
    setup.revisions = std::move(contents.revisions);
    RunMachine machine{std::move(setup), contents.run, epoch, context.scheduler.now()};
    auto test = std::make_shared<PositioningMeasurement>(context, std::move(header),
                                                         std::move(path), std::move(machine));
    test->limits_waived_ = waived;
    test->answers_ = answers;
    test->resumed_ = true;
    test->interruption_.emplace();
    test->interruption_->sentence = interruption_text(context, contents.run, proof);
    test->interruption_->run = std::move(contents.run);
    co_return test;
}

Task<Result<void>> PositioningMeasurement::go_on() {
    Interruption before = *std::move(interruption_);
    interruption_.reset();
    context_.port.start_with(PortState::armed);
    log_environment_anew();
    record(EventKind::interrupted, std::move(before.sentence));
    feed(EnvironmentNow{within_limits(scale_now())});
    note("Run " + run_.run_id + " goes on after " + std::to_string(before.run.points.size()) +
         " durable points.");
    co_return co_await publish_last_done(std::move(before.run));
}

Task<Result<void>> PositioningMeasurement::publish_last_done(RunRecord run) {
    const DurableRequest last = last_durable_request(run);
    if (last.sequence == 0) { // tied by a person, or not yet tied
        context_.port.publish_armed();
        co_return Result<void>{};
    }
    const bool is_point =
        std::ranges::find(run.points, last.step, &PointRecord::step) != run.points.end();
    auto receipt = last.step < 0 || is_point
                       ? co_await context_.journal.receipt_for(last.step)
                       : co_await context_.journal.receipt_for_skip(last.sequence, last.step);
    if (!receipt) co_return tl::unexpected<Error>(receipt.error());
    last_receipt_ = *receipt;
    publish_done(receipt->sequence(), last.step >= 0 && !is_point);
    co_return Result<void>{};
}

std::shared_ptr<PositioningMeasurement>
PositioningMeasurement::of_closed(const PositioningContext& context,
                                  std::string path,
                                  RunFileContents contents,
                                  std::shared_ptr<const ReadingRule> reading,
                                  ClosedBefore before) {
    RunSetup setup = run_setup_of(context, contents.run, std::move(reading));
    const std::size_t answers = contents.revisions.answers.size();
    const bool waived = waives_limits(contents.revisions.preflight);
    setup.revisions = std::move(contents.revisions);
    const std::uint32_t epoch = before.set_up.first_epoch();
    RunMachine machine =
        RunMachine::of_closed(std::move(setup), contents.run, epoch, context.scheduler.now());
    const std::string reason = contents.run.closing_reason;
    contents.run.points.clear();
    auto test = std::make_shared<PositioningMeasurement>(context, std::move(contents.run),
                                                         std::move(path), std::move(machine));
    test->answers_ = answers;
    test->limits_waived_ = waived;
    test->be_closed(reason, epoch, std::move(before));
    return test;
}

/// By an earlier daemon, as complete.
void PositioningMeasurement::be_closed(std::string reason,
                                       std::uint32_t epoch,
                                       ClosedBefore before) {
    run_.stage = RunState::Stage::closed;
    run_.complete = written_ = taken_over_ = true;
    run_.reason = std::move(reason);
    datum_ = machine_.view().datum;
    datum_epoch_ = epoch;
    last_receipt_ = before.last_receipt;
    restart_ = std::move(before.interruption);
    set_up_ = std::move(before.set_up);
    set_up_.lose(std::move(before.doubt));
}

} // namespace axiscal
