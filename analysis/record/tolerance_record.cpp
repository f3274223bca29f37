#include "analysis/record/tolerance_record.hpp"

#include "analysis/record/run_attachments.hpp"

#include <algorithm>
#include <variant>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 32> of_positioning{"A",
                                                          "A_forward",
                                                          "A_backward",
                                                          "E",
                                                          "E_forward",
                                                          "E_backward",
                                                          "M",
                                                          "R",
                                                          "R_forward",
                                                          "R_backward",
                                                          "B",
                                                          "B_mean",
                                                          "P",
                                                          "Pa",
                                                          "Ps_max",
                                                          "Ps_mean",
                                                          "U_max",
                                                          "U_mean",
                                                          "A_raw",
                                                          "A_raw_forward",
                                                          "A_raw_backward",
                                                          "R_raw",
                                                          "R_raw_forward",
                                                          "R_raw_backward",
                                                          "accuracy",
                                                          "accuracy_forward",
                                                          "accuracy_backward",
                                                          "repeatability",
                                                          "repeatability_forward",
                                                          "repeatability_backward",
                                                          "positioning",
                                                          "lost_motion"};

/// In the order of TestKind.
template <class... Setups>
constexpr std::array<JudgedFigures, 1 + sizeof...(Setups)>
judged_of_each(std::variant<std::monostate, Setups...>* /*types alone*/) {
    return {JudgedFigures{of_positioning, LimitQuantity::of_axis, true},
            JudgedFigures{Setups::judged, Setups::judged_in, false}...};
}

constexpr auto judged_of_kinds = judged_of_each(static_cast<TestSetup*>(nullptr));

bool knows(const JudgedFigures& figures, std::string_view parameter) {
    return std::ranges::find(figures.names, parameter) != figures.names.end();
}

} // namespace

const JudgedFigures& judged_figures(TestKind kind) {
    return judged_of_kinds[static_cast<std::size_t>(kind)];
}

const JudgedFigures* judged_with(std::string_view parameter) {
    const auto* const found = std::ranges::find_if(
        judged_of_kinds, [&](const JudgedFigures& figures) { return knows(figures, parameter); });
    return found == judged_of_kinds.end() ? nullptr : found;
}

std::optional<ToleranceRecord>
limits_of_kind(const ToleranceRecord& set, TestKind kind, bool rotary) {
    ToleranceRecord own = set;
    const JudgedFigures& figures = judged_figures(kind);
    own.unit = unit_of_limits(figures.limit, rotary);
    std::erase_if(own.limits,
                  [&](const ToleranceLimit& limit) { return !knows(figures, limit.parameter); });
    return own.limits.empty() ? std::nullopt : std::optional{std::move(own)};
}

} // namespace axiscal
