#include "acquisition/measurement/positioning/open_positioning.hpp"

#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/beam_watch.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/order_checks.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"

#include <memory>
#include <utility>

namespace axiscal {
namespace {

/// A laser or scale.
Result<void> reference_speaks(const OrderContext& context, MonotonicTime now) {
    const std::string word = reference_word(context.config);
    const auto reading = context.readings.reference().newest();
    if (!reading || now - reading->at > laser_limit)
        return fail(Fault::link_timeout, "the " + word + " (" +
                                             context.config.axis.laser.instrument +
                                             ") sends nothing; see 'axiscal devices'");
    if (!reading->value())
        return fail(Fault::beam_lost, "the " + word + " shows no good signal now");
    return {};
}

/// An alignment that is going on ends here: not before all else fits.
/// @param request  the caller keeps it
Task<Result<ArmedRun>> order_run(OrderContext context, const ArmRequest& request) {
    AXISCAL_CO_TRY(RunPlan plan, plan_for(context.config, request));
    AXISCAL_CO_TRY(Admitted admitted, co_await admit(context, request));
    const RunHeaderParts parts = header_parts(context, TestKind::positioning, std::move(plan));
    AXISCAL_CO_TRY(ArmedRun armed, armed_run(parts, request, admitted.eve));
    armed.header.standards = context.config.standards;
    armed.checks = std::move(admitted.checks);
    armed.attachments.alignment = context.beam.for_run();
    co_return armed;
}

} // namespace

Task<Result<std::string>> open_and_tie(OrderContext context, ArmRequest request, ArmedRun armed) {
    if (!request.datum_by_cnc) armed.orderer_has_gone = std::move(request.has_gone);
    AXISCAL_CO_TRY(const std::shared_ptr<PositioningMeasurement> test,
                   co_await PositioningMeasurement::open(context, std::move(armed)));
    begin_before_cnc(context, test, test->header().opened.utc_ns, request.by);
    if (request.datum_by_cnc) co_return test->run().run_id;
    if (auto tied = co_await test->await_datum(); !tied)
        co_return tl::unexpected<Error>(tied.error());
    co_return test->run().run_id;
}

Result<void> axis_is_ready(const OrderContext& context) {
    AXISCAL_CHECK(plays_no_tape(context.config));
    if (!measures_axis(context.config, context.roles))
        return refuse(Fault::bad_request, "pass",
                      "this station has a ballbar and no laser: 'axiscal arm --pass circular'");
    AXISCAL_CHECK(disk_takes_records(context));
    AXISCAL_CHECK(nothing_goes_on(context));
    const MonotonicTime now = context.scheduler.now();
    AXISCAL_CHECK(context.readings.environment_is_fresh(now));
    if (context.roles.autocollimator)
        return autocollimator_speaks(context.readings, context.roles, context.instruments, now);
    if (reads_polygon(context.config)) return {};
    return reference_speaks(context, now);
}

Task<Result<std::string>> open_positioning(OrderContext context, ArmRequest request) {
    if (auto ready = axis_is_ready(context); !ready) co_return tl::unexpected<Error>(ready.error());
    const Held arming{context.under_way.arming};
    AXISCAL_CO_TRY(ArmedRun armed, co_await order_run(context, request));
    co_return co_await open_and_tie(context, std::move(request), std::move(armed));
}

} // namespace axiscal
