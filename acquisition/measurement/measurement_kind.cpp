#include "acquisition/measurement/measurement_kind.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

bool has_what_it_needs(TestKind kind, const OrderContext& context) {
    const auto is_set_up = kind_row(kind).is_set_up;
    return is_set_up != nullptr && is_set_up(context);
}

} // namespace

Task<Result<std::string>> open_ordered(OrderContext context, ArmRequest request) {
    const MeasurementKind& row = kind_row(request.kind);
    if (row.open == nullptr)
        co_return refuse(Fault::bad_request, "pass", "is of a test that is not armed");
    co_return co_await row.open(context, std::move(request));
}

TestKind kind_that_is_checked(const OrderContext& context, const ArmRequest& request) {
    if (has_what_it_needs(request.kind, context)) return request.kind;
    const auto first = std::ranges::find_if(
        all_test_kinds, [&](TestKind kind) { return has_what_it_needs(kind, context); });
    return first == all_test_kinds.end() ? TestKind::positioning : *first;
}

} // namespace axiscal
