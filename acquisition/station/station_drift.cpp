// A drift test is ordered: what speaks against it, and what it begins with.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/measurement/drift/drift_measurement.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"

#include <utility>

namespace axiscal {
/// The axis, unless the ballbar is asked for or is all that the station has.
bool Station::drift_is_of_bar(const DriftRequest& request) const {
    return request.of_bar.value_or(!roles_.laser && !reads_polygon());
}

Result<void> Station::ready_for_drift(bool of_bar) const {
    if (!of_bar && !roles_.laser && !reads_polygon())
        return refuse(Fault::bad_request, "of",
                      "is an axis, and this station has a ballbar alone: 'axiscal drift --of "
                      "ballbar'");
    if (!of_bar) return ready_to_measure();
    AXISCAL_CHECK(plays_no_tape());
    if (!roles_.ballbar)
        return refuse(Fault::bad_request, "of",
                      "is the ballbar, which needs the table [ballbar] of the station file");
    AXISCAL_CHECK(disk_takes_records());
    AXISCAL_CHECK(nothing_goes_on());
    AXISCAL_CHECK(ballbar_speaks());
    const auto& reading = readings_.latest(*roles_.ballbar);
    if (!reading || !reading->value())
        return fail(Fault::signal_error, "the ballbar (" + config_.ballbar->instrument +
                                             ") shows no good reading now; mount it so that it "
                                             "rests within its range");
    return {};
}

/// While the datum of the last run stands, the laser tells where the axis is.
Result<void> Station::rests_at(Length place) const {
    constexpr Length near = mm(1);
    if (!last_run()) return {};
    const std::optional<Length> seen = last_run()->place_now();
    if (!seen || abs(*seen - place) <= near) return {};
    const std::string there = plain_number(seen->in(mm), 1);
    return refuse(Fault::bad_request, "place_mm",
                  "is " + plain_number(place.in(mm), 3) + " mm, and by the datum of run " +
                      last_run()->run().run_id + " the axis stands at " + there +
                      " mm: drive it to the place, or say --at " + there);
}

Task<Result<std::string>> Station::drift(DriftRequest request) {
    const bool of_bar = drift_is_of_bar(request);
    if (auto ready = ready_for_drift(of_bar); !ready)
        co_return tl::unexpected<Error>(ready.error());
    const Held arming{under_way_.arming};
    co_return co_await open_drift(std::move(request), of_bar);
}

Result<RestingTest> Station::drift_of_axis(const DriftRequest& request) const {
    AXISCAL_TRY(RunPlan plan, plan_for(config_, {}));
    AXISCAL_TRY(const DriftSetup setup, drift_setup_of(config_, roles_, request, plan));
    AXISCAL_CHECK(rests_at(setup.place));
    return axis_at_rest(header_parts(TestKind::drift, std::move(plan)), request, setup);
}

Result<RestingTest> Station::drift_of_bar(const DriftRequest& request) const {
    return bar_at_rest(header_parts(TestKind::drift, {}), request, readings_.bar_rate_hz());
}

Task<Result<std::string>> Station::open_drift(DriftRequest request, bool of_bar) {
    AXISCAL_CO_TRY(RestingTest order, of_bar ? drift_of_bar(request) : drift_of_axis(request));
    if (!of_bar) order.alignment = beam_.for_run();
    const MeasurementContext context = measurement_context();
    AXISCAL_CO_TRY(const std::shared_ptr<DriftMeasurement> test,
                   co_await DriftMeasurement::open(context, std::move(order)));
    tests_.let_rest(test);
    test->begin(request.by);
    co_return test->run().run_id;
}

} // namespace axiscal
