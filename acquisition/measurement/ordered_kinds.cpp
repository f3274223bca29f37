#include "acquisition/measurement/ordered_kinds.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/circular/circle_facts.hpp"
#include "acquisition/measurement/circular/open_circles.hpp"
#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/open_positioning.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <utility>

namespace axiscal {
namespace {

bool is_measured_by_ballbar(TestKind kind) {
    switch (kind) {
    case TestKind::circular: return true;
    case TestKind::positioning:
    case TestKind::drift:
    case TestKind::probing: break;
    }
    return false;
}

} // namespace

Task<Result<std::string>> open_ordered(OrderContext context, ArmRequest request) {
    switch (request.kind) {
    case TestKind::positioning: co_return co_await open_positioning(context, std::move(request));
    case TestKind::circular: co_return co_await open_circles(context, std::move(request));
    case TestKind::drift:
    case TestKind::probing: break;
    }
    co_return refuse(Fault::bad_request, "pass", "is of a test that is not armed");
}

TestKind kind_that_is_checked(const OrderContext& context, const ArmRequest& request) {
    const bool asked =
        is_measured_by_ballbar(request.kind) || !measures_axis(context.config, context.roles);
    const bool takes_circles = asked && context.roles.ballbar && context.config.circular;
    return takes_circles ? TestKind::circular : TestKind::positioning;
}

std::vector<int>
add_facts_of_kind(TestKind kind, const OrderContext& context, PreflightFacts& facts) {
    switch (kind) {
    case TestKind::circular: return add_circle_facts(context, facts);
    case TestKind::positioning:
    case TestKind::drift:
    case TestKind::probing: break;
    }
    return add_axis_facts(context, facts);
}

WantedDrift drift_wanted_by(TestKind kind, const OrderContext& context) {
    switch (kind) {
    case TestKind::circular: return drift_for_circles(context);
    case TestKind::positioning:
    case TestKind::drift:
    case TestKind::probing: break;
    }
    return drift_for_axis(context.config);
}

Result<EveFacts> eve_facts_of_kind(TestKind kind,
                                   const OrderContext& context,
                                   const ArmRequest& request,
                                   const FoundEve& found) {
    switch (kind) {
    case TestKind::circular: return eve_facts_of_circles(context.config, found);
    case TestKind::positioning:
    case TestKind::drift:
    case TestKind::probing: break;
    }
    return eve_facts_of_axis(context.config, request, found);
}

} // namespace axiscal
