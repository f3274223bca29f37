#include "acquisition/measurement/drift/open_drift.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/beam_watch.hpp"
#include "acquisition/measurement/circular/open_circles.hpp"
#include "acquisition/measurement/drift/drift_measurement.hpp"
#include "acquisition/measurement/drift/resting_test.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/open_positioning.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

Result<void> bar_is_ready(const OrderContext& context) {
    AXISCAL_CHECK(plays_no_tape(context.config));
    if (!context.roles.ballbar)
        return refuse(Fault::bad_request, "of",
                      "is the ballbar, which needs the table [ballbar] of the station file");
    AXISCAL_CHECK(disk_takes_records(context));
    AXISCAL_CHECK(nothing_goes_on(context));
    AXISCAL_CHECK(ballbar_speaks(context));
    const auto& reading = context.readings.latest(*context.roles.ballbar);
    if (!reading || !reading->value())
        return fail(Fault::signal_error, "the ballbar (" + context.config.ballbar->instrument +
                                             ") shows no good reading now; mount it so that it "
                                             "rests within its range");
    return {};
}

Result<void> rest_is_ready(const OrderContext& context, bool of_bar) {
    if (of_bar) return bar_is_ready(context);
    if (!measures_axis(context.config, context.roles))
        return refuse(Fault::bad_request, "of",
                      "is an axis, and this station has a ballbar alone: 'axiscal drift --of "
                      "ballbar'");
    return axis_is_ready(context);
}

/// While the datum of the last run stands, the laser tells where the axis is.
Result<void> rests_at(const OrderContext& context, Length place) {
    constexpr Length near = mm(1);
    const std::shared_ptr<Measurement>& last = context.tests.run();
    if (!last) return {};
    const std::optional<Length> seen = last->place_now();
    if (!seen || abs(*seen - place) <= near) return {};
    const std::string there = plain_number(seen->in(mm), 1);
    return refuse(Fault::bad_request, "place_mm",
                  "is " + plain_number(place.in(mm), 3) + " mm, and by the datum of run " +
                      last->run().run_id + " the axis stands at " + there +
                      " mm: drive it to the place, or say --at " + there);
}

/// An alignment that is going on ends here.
Result<RestingTest> rest_of_axis(const OrderContext& context, const DriftRequest& request) {
    AXISCAL_TRY(RunPlan plan, plan_for(context.config, {}));
    AXISCAL_TRY(const DriftSetup setup,
                drift_setup_of(context.config, context.roles, request, plan));
    AXISCAL_CHECK(rests_at(context, setup.place));
    AXISCAL_TRY(
        RestingTest rest,
        axis_at_rest(header_parts(context, TestKind::drift, std::move(plan)), request, setup));
    rest.alignment = context.beam.for_run();
    return rest;
}

Result<RestingTest> rest_of_bar(const OrderContext& context, const DriftRequest& request) {
    return bar_at_rest(header_parts(context, TestKind::drift, {}), request,
                       context.readings.bar_rate_hz());
}

Task<Result<std::string>> open_rest(OrderContext context, DriftRequest request, bool of_bar) {
    AXISCAL_CO_TRY(RestingTest rest,
                   of_bar ? rest_of_bar(context, request) : rest_of_axis(context, request));
    AXISCAL_CO_TRY(const std::shared_ptr<DriftMeasurement> test,
                   co_await DriftMeasurement::open(context, std::move(rest)));
    context.tests.let_rest(test);
    test->begin(request.by);
    co_return test->run().run_id;
}

} // namespace

/// Of the axis, unless the ballbar is asked for or is all that the station has.
Task<Result<std::string>> open_drift(OrderContext context, DriftRequest request) {
    const bool of_bar = request.of_bar.value_or(!measures_axis(context.config, context.roles));
    if (auto ready = rest_is_ready(context, of_bar); !ready)
        co_return tl::unexpected<Error>(ready.error());
    const Held arming{context.under_way.arming};
    co_return co_await open_rest(context, std::move(request), of_bar);
}

} // namespace axiscal
