// A circular test is ordered: what speaks against it, and what it begins with.
#include "acquisition/station/station.hpp"

#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/circular/armed_circles.hpp"
#include "acquisition/measurement/circular/circle_measurement.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/order_checks.hpp"

#include <utility>

namespace axiscal {

Result<void> Station::ready_for_circles() const {
    AXISCAL_CHECK(plays_no_tape());
    AXISCAL_CHECK(nothing_goes_on());
    AXISCAL_CHECK(disk_takes_records());
    if (!config_.circular || !roles_.ballbar)
        return refuse(Fault::bad_request, "pass",
                      "'circular' needs the tables [ballbar] and [circular] of the station file");
    return ballbar_speaks(); // at rest it may be out of its range
}

Result<void> Station::ballbar_speaks() const {
    const auto& reading = readings_.latest(*roles_.ballbar);
    if (!reading || scheduler_.now() - reading->at > bar_limit)
        return fail(Fault::link_timeout, "the ballbar (" + config_.ballbar->instrument +
                                             ") sends nothing; see 'axiscal devices'");
    return {};
}

Task<Result<std::string>> Station::arm_circular(ArmRequest request) {
    if (auto ready = ready_for_circles(); !ready) co_return tl::unexpected<Error>(ready.error());
    const Held arming{under_way_.arming};
    co_return co_await open_circular(std::move(request));
}

Task<Result<std::string>> Station::open_circular(ArmRequest request) {
    const OrderContext context = order_context();
    AXISCAL_CO_TRY(Admitted admitted, co_await admit(context, request));
    const RunHeaderParts parts = header_parts(TestKind::circular, {});
    AXISCAL_CO_TRY(ArmedCircles armed,
                   armed_circles(parts, request, readings_.bar_rate_hz(), admitted.eve));
    armed.checks = std::move(admitted.checks);
    AXISCAL_CO_TRY(const std::shared_ptr<CircleMeasurement> test,
                   co_await CircleMeasurement::open(context, std::move(armed)));
    begin(test, test->header().opened.utc_ns, request.by);
    if (auto kept = co_await journal_.flush(); !kept) co_return tl::unexpected<Error>(kept.error());
    co_return test->run().run_id;
}

std::optional<StreamView> Station::stream(std::size_t most) const {
    if (!last_run()) return std::nullopt;
    return last_run()->stream(most);
}

} // namespace axiscal
