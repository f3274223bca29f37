#include "acquisition/measurement/positioning/take_over_positioning.hpp"

#include "acquisition/live/channel_facts.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/left_positioning.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/run/resume.hpp"

#include <utility>

namespace axiscal {
namespace {

std::string why_not_without_counter(const CncContext& context) {
    if (!reads_polygon(context.config)) return "The station file names no laser any more.";
    const bool reads_faces = context.roles.autocollimator.has_value();
    return std::string{"What was "} + (reads_faces ? "read" : "typed") +
           " before a restart is not gone on with: nobody knows whether autocollimator and polygon "
           "were touched meanwhile.";
}

/// Empty: nothing is, or the run was armed in spite of it.
std::string what_is_outside(const CncContext& context, const RunFileContents& contents) {
    if (waives_limits(contents.revisions.preflight)) return {};
    const ChannelFacts facts{context.config, context.roles, context.instruments, context.readings};
    const MonotonicTime now = context.scheduler.now();
    return outside_limits(context.config.environment, facts.environment(now), now);
}

} // namespace

Task<Result<TakenOver>> take_over_positioning(PositioningContext context, LeftRun left) {
    auto reading = positions_of(left.contents.run);
    return take_over_read_by(context, std::move(left), std::move(reading));
}

Task<Result<TakenOver>> take_over_read_by(PositioningContext context,
                                          LeftRun left,
                                          std::shared_ptr<const ReadingRule> reading) {
    TakenOver taken;
    if (!context.roles.laser) {
        taken.closing = left.closed_for(why_not_without_counter(context), Fault::bad_configuration);
        co_return taken;
    }
    StationNow now = co_await station_after_restart(context, left.contents.run);
    now.outside_limits = what_is_outside(context, left.contents);
    ResumeVerdict verdict = decide_resume(left.contents.run, std::nullopt, now);
    if (verdict.decision != ResumeDecision::wait_for_request) {
        taken.closing = left.closed_for(std::move(verdict.sentence), verdict.fault);
        co_return taken;
    }
    AXISCAL_CO_TRY(taken.test, co_await PositioningMeasurement::reopen(
                                   context, std::move(left.path), std::move(left.contents),
                                   std::move(reading), std::move(verdict.sentence)));
    co_return taken;
}

Task<std::shared_ptr<Measurement>>
take_over_closed_positioning(PositioningContext context,
                             std::string path,
                             RunFileContents contents,
                             const SetUpWatch& set_up,
                             const std::optional<JournalReceipt>& told) {
    auto reading = positions_of(contents.run);
    return take_over_closed_read_by(context, std::move(path), std::move(contents),
                                    std::move(reading), set_up, told);
}

Task<std::shared_ptr<Measurement>>
take_over_closed_read_by(PositioningContext context,
                         std::string path,
                         RunFileContents contents,
                         std::shared_ptr<const ReadingRule> reading,
                         const SetUpWatch& set_up,
                         const std::optional<JournalReceipt>& told) {
    ClosedBefore before = co_await judge_closed_run(context, set_up, contents.run);
    before.last_receipt = told;
    co_return PositioningMeasurement::of_closed(context, std::move(path), std::move(contents),
                                                std::move(reading), std::move(before));
}

} // namespace axiscal
