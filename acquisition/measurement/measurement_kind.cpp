#include "acquisition/measurement/measurement_kind.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

bool has_what_it_needs(TestKind kind, const OrderContext& context) {
    const auto is_set_up = kind_row(kind).is_set_up;
    return is_set_up != nullptr && is_set_up(context);
}

const MeasurementKind& row_to_arm(const ArmRequest& request) {
    const MeasurementKind& asked = kind_row(request.kind);
    return asked.open != nullptr ? asked : kind_row(TestKind::positioning);
}

} // namespace

Result<void> check_options(const ArmRequest& request) {
    const auto taken = row_to_arm(request).options;
    for (const auto& [name, value] : request.options)
        if (std::ranges::find(taken, name) == taken.end())
            return refuse(Fault::bad_request, "options." + name,
                          "is no option of what is armed by pass '" + request.pass + "'");
    return {};
}

Task<Result<std::string>> open_ordered(OrderContext context, ArmRequest request) {
    const auto checked = check_options(request);
    if (!checked) co_return tl::unexpected<Error>(checked.error());
    const MeasurementKind& row = row_to_arm(request);
    co_return co_await row.open(context, std::move(request));
}

TestKind kind_that_is_checked(const OrderContext& context, const ArmRequest& request) {
    if (has_what_it_needs(request.kind, context)) return request.kind;
    const auto first = std::ranges::find_if(
        all_test_kinds, [&](TestKind kind) { return has_what_it_needs(kind, context); });
    return first == all_test_kinds.end() ? TestKind::positioning : *first;
}

} // namespace axiscal
