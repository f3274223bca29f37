#include "acquisition/measurement/circular/open_circles.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/circular/armed_circles.hpp"
#include "acquisition/measurement/circular/circle_measurement.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/order_checks.hpp"

#include <memory>
#include <utility>

namespace axiscal {
namespace {

/// At rest the ballbar may be out of its range.
Result<void> circles_are_ready(const OrderContext& context) {
    AXISCAL_CHECK(plays_no_tape(context.config));
    AXISCAL_CHECK(nothing_goes_on(context));
    AXISCAL_CHECK(disk_takes_records(context));
    if (!context.config.circular || !context.roles.ballbar)
        return refuse(Fault::bad_request, "pass",
                      "'circular' needs the tables [ballbar] and [circular] of the station file");
    return ballbar_speaks(context);
}

RunHeaderParts parts_of_circles(const OrderContext& context) {
    RunHeaderParts parts = header_parts(context, TestKind::circular, {});
    parts.further_channels.clear();
    for (const auto& channel : {context.roles.ballbar, context.roles.bar_temperature})
        if (channel) parts.further_channels.push_back(*channel);
    return parts;
}

Task<Result<std::string>> open_and_flush(OrderContext context, ArmRequest request) {
    AXISCAL_CO_TRY(Admitted admitted, co_await admit(context, request));
    const RunHeaderParts parts = parts_of_circles(context);
    AXISCAL_CO_TRY(ArmedCircles armed,
                   armed_circles(parts, request, context.readings.bar_rate_hz(), admitted.eve));
    armed.checks = std::move(admitted.checks);
    AXISCAL_CO_TRY(const std::shared_ptr<CircleMeasurement> test,
                   co_await CircleMeasurement::open(context, std::move(armed)));
    begin_before_cnc(context, test, test->header().opened.utc_ns, request.by);
    if (auto kept = co_await context.journal.flush(); !kept)
        co_return tl::unexpected<Error>(kept.error());
    co_return test->run().run_id;
}

} // namespace

Result<void> ballbar_speaks(const OrderContext& context) {
    const auto& reading = context.readings.latest(*context.roles.ballbar);
    if (!reading || context.scheduler.now() - reading->at > bar_limit)
        return fail(Fault::link_timeout, "the ballbar (" + context.config.ballbar->instrument +
                                             ") sends nothing; see 'axiscal devices'");
    return {};
}

Task<Result<std::string>> open_circles(OrderContext context, ArmRequest request) {
    if (auto ready = circles_are_ready(context); !ready)
        co_return tl::unexpected<Error>(ready.error());
    const Held arming{context.under_way.arming};
    co_return co_await open_and_flush(context, std::move(request));
}

} // namespace axiscal
