#include "acquisition/measurement/order_checks.hpp"

#include "acquisition/measurement/measurement_kind.hpp"
#include "acquisition/measurement/preflight_facts.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/stored_drift.hpp"

#include <string>
#include <utility>

namespace axiscal {
namespace {

/// Nothing where the station file points to no drift test.
Task<Result<std::optional<FoundEve>>> eve_for(OrderContext context, TestKind kind) {
    WantedDrift wanted = kind_row(kind).wanted_drift(context);
    if (wanted.which.empty()) co_return std::optional<FoundEve>{};
    const AxisKind axis = wanted.of_bar ? AxisKind::linear : context.config.cycle.axis_kind;
    std::string runs_folder = context.config.state_directory + "/runs";
    AXISCAL_CO_TRY(FoundEve found, co_await find_eve(context.journal, std::move(runs_folder),
                                                     std::move(wanted), axis));
    co_return std::optional{std::move(found)};
}

Result<std::vector<PreflightRecord>> judge_order(const OrderContext& context,
                                                 const ArmRequest& request,
                                                 const std::optional<FoundEve>& eve) {
    PreflightFacts facts = preflight_facts(context, request);
    if (eve) {
        const MeasurementKind& kind = kind_row(kind_that_is_checked(context, request));
        AXISCAL_TRY(facts.eve, kind.eve_facts(context, request, *eve));
    }
    auto checks = judge_preflight(facts);
    AXISCAL_CHECK(override_checks(checks, request.overrides));
    return checks;
}

} // namespace

Task<Result<Admitted>> admit(OrderContext context, const ArmRequest& request) {
    Admitted admitted;
    AXISCAL_CO_TRY(admitted.eve, co_await eve_for(context, kind_that_is_checked(context, request)));
    AXISCAL_CO_TRY(admitted.checks, judge_order(context, request, admitted.eve));
    if (const std::string objections = open_objections(admitted.checks); !objections.empty())
        co_return refuse(Fault::refused, "preflight", objections);
    co_return admitted;
}

/// Where the drift test is missing its check fails, and no reason helps: arming finds no E_VE.
Task<Result<std::vector<PreflightRecord>>> preflight_of(OrderContext context, ArmRequest request) {
    const auto checked = check_options(request);
    if (!checked) co_return tl::unexpected<Error>(checked.error());
    const auto eve = co_await eve_for(context, kind_that_is_checked(context, request));
    if (eve) co_return judge_order(context, request, *eve);
    PreflightFacts facts = preflight_facts(context, request);
    facts.eve.emplace().why_not = eve.error().detail;
    auto checks = judge_preflight(facts);
    if (auto kept = override_checks(checks, request.overrides); !kept)
        co_return tl::unexpected<Error>(kept.error());
    co_return checks;
}

} // namespace axiscal
