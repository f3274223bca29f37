#include "acquisition/measurement/straightness/open_straightness.hpp"

#include "acquisition/measurement/beam_watch.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/order_checks.hpp"
#include "acquisition/measurement/positioning/open_positioning.hpp"
#include "acquisition/measurement/straightness/armed_straightness.hpp"
#include "acquisition/measurement/straightness/mirror_run.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"

#include <optional>
#include <utility>

namespace axiscal {
namespace {

Result<void> straightness_is_ready(const OrderContext& context) {
    AXISCAL_CHECK(plays_no_tape(context.config));
    if (straightness_config_of(context.config) == nullptr || !context.roles.laser)
        return refuse(Fault::bad_request, "pass",
                      "'straightness' needs the table [straightness] of the station file, and a "
                      "laser");
    return axis_is_ready(context);
}

/// @param request  the caller keeps it
Task<Result<ArmedRun>> order_straightness(OrderContext context, const ArmRequest& request) {
    const StraightnessConfig& config = *straightness_config_of(context.config);
    StraightnessSetup stands = config.setup;
    AXISCAL_CO_TRY(stands.mirror, mirror_of(config, request));
    AXISCAL_CO_TRY(std::optional<RecordedLine> other,
                   co_await find_other_mirror(context, stands, request));
    AXISCAL_CO_TRY(Admitted admitted, co_await admit(context, request));
    const RunHeaderParts parts = header_parts(
        context, TestKind::straightness, plan_of_order(config, TestKind::straightness, request));
    AXISCAL_CO_TRY(ArmedRun armed,
                   armed_straightness(parts, config, request, admitted.eve, std::move(other)));
    armed.checks = std::move(admitted.checks);
    (void)context.beam.for_run();
    co_return armed;
}

} // namespace

Task<Result<std::string>> open_straightness(OrderContext context, ArmRequest request) {
    if (auto ready = straightness_is_ready(context); !ready)
        co_return tl::unexpected<Error>(ready.error());
    const Held arming{context.under_way.arming};
    AXISCAL_CO_TRY(ArmedRun armed, co_await order_straightness(context, request));
    co_return co_await open_and_tie(context, std::move(request), std::move(armed));
}

} // namespace axiscal
