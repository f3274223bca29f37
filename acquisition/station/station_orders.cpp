// What people order. Each kind of test says itself what speaks against it, and how it is opened.
#include "acquisition/station/station.hpp"

#include "acquisition/measurement/drift/open_drift.hpp"
#include "acquisition/measurement/measurement_kind.hpp"
#include "acquisition/measurement/order_checks.hpp"

#include <utility>

namespace axiscal {

Task<Result<std::string>> Station::arm(ArmRequest request) {
    auto opened = co_await open_ordered(order_context(), std::move(request));
    if (opened) judged_checks_ = {};
    arming_refused_ = !opened && opened.error().field == "preflight";
    co_return opened;
}

Task<Result<std::string>> Station::drift(DriftRequest request) {
    return open_drift(order_context(), std::move(request));
}

/// What people are told of the checks stays in the list of what to do until a test is armed, or
/// they are judged anew.
Task<Result<std::vector<PreflightRecord>>> Station::preflight(ArmRequest request) {
    const bool refused = std::exchange(arming_refused_, false);
    auto checks = co_await preflight_of(order_context(), std::move(request));
    if (checks) judged_checks_ = {*checks, iso8601_utc(scheduler_.clock_tie().utc_ns), refused};
    co_return checks;
}

Result<void> Station::align(AlignmentOrder order) {
    return beam_.carry_out(order);
}

Result<void> Station::trigger() {
    if (!last_run()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    return last_run()->trigger();
}

Result<void> Station::type_reading(double seconds_of_arc) {
    if (!reads_polygon() || reads_faces())
        return fail(Fault::bad_request,
                    std::string{"this station reads its "} +
                        (reads_faces() ? "autocollimator" : "length") +
                        " by itself: 'axiscal trigger' captures the next point");
    if (!last_run()) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    return last_run()->type_reading(seconds_of_arc);
}

Task<Result<RunEnding>> Station::abort(std::string reason, Orderer by) {
    // The next one may take its place before this returns.
    const std::shared_ptr<Measurement> test = drift_open() ? tests_.resting() : last_run();
    if (!test) co_return fail(Fault::no_run_armed, "there is nothing to abort");
    co_return co_await test->abort(std::move(reason), std::move(by));
}

} // namespace axiscal
