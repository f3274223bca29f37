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

using JudgedParameters = std::span<const std::string_view>;

/// Of each kind, in the order of TestKind.
template <class... Setups>
constexpr std::array<JudgedParameters, 1 + sizeof...(Setups)>
judged_of_each(std::variant<std::monostate, Setups...>* /*types alone*/) {
    return {JudgedParameters{of_positioning}, JudgedParameters{Setups::judged}...};
}

} // namespace

std::span<const std::string_view> judged_parameters(TestKind kind) {
    constexpr auto each = judged_of_each(static_cast<TestSetup*>(nullptr));
    return each[static_cast<std::size_t>(kind)];
}

std::optional<ToleranceRecord> limits_of_kind(const ToleranceRecord& set, TestKind kind) {
    ToleranceRecord own = set;
    const auto known = judged_parameters(kind);
    std::erase_if(own.limits, [&](const ToleranceLimit& limit) {
        return std::ranges::find(known, limit.parameter) == known.end();
    });
    return own.limits.empty() ? std::nullopt : std::optional{std::move(own)};
}

} // namespace axiscal
