#include "acquisition/measurement/squareness/open_squareness.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/beam_watch.hpp"
#include "acquisition/measurement/held.hpp"
#include "acquisition/measurement/order_checks.hpp"
#include "acquisition/measurement/positioning/open_positioning.hpp"
#include "acquisition/measurement/squareness/armed_squareness.hpp"
#include "acquisition/measurement/squareness/earlier_lines.hpp"
#include "acquisition/measurement/straightness/armed_straightness.hpp"

#include <optional>
#include <utility>

namespace axiscal {
namespace {

Result<void> squareness_is_ready(const OrderContext& context) {
    AXISCAL_CHECK(plays_no_tape(context.config));
    if (!square_tables_of(context.config) || !context.roles.laser)
        return refuse(Fault::bad_request, "pass",
                      "'squareness' needs the tables [straightness] and [squareness] of the "
                      "station file, and a laser");
    return axis_is_ready(context);
}

/// Reads beside the loop. @param request  the caller keeps it
Task<Result<SquarenessSetup>>
with_earlier_lines(OrderContext context, SquarenessSetup setup, const ArmRequest& request) {
    const SquareTables tables = *square_tables_of(context.config);
    const std::string runs_folder = context.config.state_directory + "/runs";
    WantedRun wanted = wanted_first_line(tables, request);
    AXISCAL_CO_TRY(const RunFileContents first,
                   co_await context.journal.find_complete_run(runs_folder, std::move(wanted)));
    AXISCAL_CO_TRY(setup.first, first_line_of(first, setup, context.config.axis.program_axis));
    std::optional<WantedRun> other = wanted_other_square(context.config, tables, request);
    if (!other) co_return setup;
    AXISCAL_CO_TRY(const RunFileContents of_other,
                   co_await context.journal.find_complete_run(runs_folder, *std::move(other)));
    AXISCAL_CO_TRY(setup.other, other_square_of(of_other, setup));
    co_return setup;
}

/// @param request  the caller keeps it
Task<Result<ArmedRun>> order_squareness(OrderContext context, const ArmRequest& request) {
    const SquareTables tables = *square_tables_of(context.config);
    AXISCAL_CO_TRY(SquarenessSetup begun, squareness_before_lines(tables, request));
    AXISCAL_CO_TRY(SquarenessSetup setup,
                   co_await with_earlier_lines(context, std::move(begun), request));
    AXISCAL_CO_TRY(Admitted admitted, co_await admit(context, request));
    const RunHeaderParts parts = header_parts(
        context, TestKind::squareness, plan_of_order(tables.across, TestKind::squareness, request));
    AXISCAL_CO_TRY(ArmedRun armed,
                   armed_squareness(parts, tables, request, admitted.eve, std::move(setup)));
    armed.checks = std::move(admitted.checks);
    (void)context.beam.for_run();
    co_return armed;
}

} // namespace

Task<Result<std::string>> open_squareness(OrderContext context, ArmRequest request) {
    if (auto ready = squareness_is_ready(context); !ready)
        co_return tl::unexpected<Error>(ready.error());
    const Held arming{context.under_way.arming};
    AXISCAL_CO_TRY(ArmedRun armed, co_await order_squareness(context, request));
    co_return co_await open_and_tie(context, std::move(request), std::move(armed));
}

} // namespace axiscal
