#include "acquisition/measurement/positioning/left_positioning.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "analysis/record/run_clock.hpp"
#include "drivers/instrument.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration answer_limit = std::chrono::seconds{5}; // for a station that was just started
constexpr Length any_wavelength = nm(632.991);             // whether the air is known, no more

std::uint64_t count_modulus_of_axis(const CncContext& context) {
    const auto id = static_cast<std::size_t>(*context.roles.laser);
    const int seat = context.instruments.channels()[id].instrument;
    return context.instruments.instrument(seat).count_modulus();
}

bool axis_is_back(const CncContext& context) {
    const auto reading = context.readings.reference().newest();
    return reading && reading->value() &&
           context.readings.scale_minus_1(context.scheduler.now(), any_wavelength);
}

/// For a run too young to tell. The first second may hold readings that waited in a buffer.
Task<double> laser_rate_hz(CncContext context, MonotonicTime limit) {
    constexpr Duration second = std::chrono::seconds{1};
    const SampleHistory& reference = context.readings.reference();
    while (context.scheduler.now() < limit) {
        const auto newest = reference.newest();
        if (newest && reference.reaches_back_to(newest->at - 2 * second - look_every)) {
            const auto latest = reference.between(newest->at - second - look_every, newest->at);
            if (const auto rate_hz = counting_rate_hz(latest)) co_return *rate_hz;
        }
        co_await context.scheduler.sleep_for(look_every);
    }
    co_return 0;
}

} // namespace

RunSetup run_setup_of(const CncContext& context,
                      const RunRecord& header,
                      std::shared_ptr<const ReadingRule> reading) {
    return {header.plan,
            std::move(reading),
            serial_of_axis(context.config, context.roles, context.instruments),
            context.config.capture.timeout,
            {}};
}

Task<StationNow> station_after_restart(CncContext context, const RunRecord& run) {
    const MonotonicTime limit = context.scheduler.now() + return_limit;
    while (!axis_is_back(context) && context.scheduler.now() < limit)
        co_await context.scheduler.sleep_for(look_every);
    StationNow now;
    now.config_hash = context.config_hash;
    now.boot_id = context.boot_id;
    now.laser_serial = serial_of_axis_for(run, context.config, context.roles, context.instruments);
    now.instruments = serials_of_run(context.roles, context.instruments);
    now.limits.fastest = context.config.capture.fastest;
    now.limits.count_modulus = count_modulus_of_axis(context);
    if (!run.datums.empty() && !counting_rate_hz(run))
        now.limits.rate_hz = co_await laser_rate_hz(context, limit);
    const auto newest = context.readings.reference().newest();
    if (newest && newest->value()) now.laser = newest;
    co_return now;
}

std::string
interruption_text(const CncContext& context, const RunRecord& run, const std::string& proof) {
    const std::string away =
        is_same_boot(run.boot_id, context.boot_id)
            ? "for " + in_seconds(context.scheduler.now() - last_sign_of_life(run))
            : "while " + restart_text(run.boot_id, context.boot_id);
    return "The station recorded nothing " + away + ". " + taken_up_text(run) + proof;
}

Task<ClosedBefore>
judge_closed_run(CncContext context, const SetUpWatch& set_up, const RunRecord& run) {
    const MonotonicTime limit = context.scheduler.now() + answer_limit;
    while (!set_up.settled() && set_up.lost().empty() && context.scheduler.now() < limit)
        co_await context.scheduler.sleep_for(look_every);
    StationNow now;
    now.config_hash = context.config_hash;
    now.boot_id = context.boot_id;
    now.laser_serial = serial_of_axis(context.config, context.roles, context.instruments);
    now.laser = set_up.settled();
    now.limits.fastest = context.config.capture.fastest;
    if (context.roles.laser) now.limits.count_modulus = count_modulus_of_axis(context);
    if (!counting_rate_hz(run)) now.limits.rate_hz = co_await laser_rate_hz(context, limit);
    const ResumeVerdict verdict = decide_resume(run, std::nullopt, now);
    const std::string restarted = "axiscald was restarted after the run had been closed";
    ClosedBefore before{set_up, restarted + ". " + verdict.sentence, {}, {}};
    if (verdict.decision == ResumeDecision::wait_for_request) co_return before;
    before.doubt = restarted + ", and nothing proves that its set-up stands. " + verdict.sentence;
    if (before.doubt.ends_with('.')) before.doubt.pop_back();
    co_return before;
}

} // namespace axiscal
