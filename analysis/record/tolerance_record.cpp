#include "analysis/record/tolerance_record.hpp"

#include <algorithm>

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
constexpr std::array<std::string_view, 8> of_circles{
    "G_ccw", "G_cw", "G_b", "F_max_ccw", "F_max_cw", "F_min_ccw", "F_min_cw", "D"};
constexpr std::array<std::string_view, 2> of_drift{"E_VE", "ETVE"};
constexpr std::array<std::string_view, 7> of_probing{"E_TD,X",  "E_TD,Y",  "E_TD,Z",  "E_TD,XY",
                                                     "E_TD,XZ", "E_TD,YZ", "E_TD,XYZ"};

} // namespace

std::span<const std::string_view> judged_parameters(TestKind kind) {
    switch (kind) {
    case TestKind::positioning: return of_positioning;
    case TestKind::circular: return of_circles;
    case TestKind::drift: return of_drift;
    case TestKind::probing: return of_probing;
    }
    return {};
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
