#pragma once
// What the files of the styles share: the means, deviations and reversals of each target, and the
// words for what is missing. For analysis/positioning alone.

#include "analysis/positioning/styles.hpp"
#include "analysis/positioning/sums.hpp"

#include <initializer_list>

namespace axiscal {

inline constexpr const char* absent_single =
    "one approach per direction: no spread, hence no repeatability";
inline constexpr const char* absent_one_way = "no backward approaches: the test is unidirectional";

/// Means, s and B_i of each target, as ISO 230-2 has them (the cover factor plays no part).
inline std::vector<PositionRow> rows_of_run(const RunAt20C& run) {
    return evaluate_positioning(run).positions;
}

inline void
leave_out(StyleResult& result, std::initializer_list<const char*> keys, const char* reason) {
    for (const char* key : keys)
        result.not_evaluated[key] = reason;
}

/// target, mean_forward, mean_backward, mean, B, s_forward, s_backward: what there is of them.
inline NamedFigures common_figures(const PositionRow& row) {
    NamedFigures figures{{"target", row.target}, {"mean_forward", row.mean_forward}};
    const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value) figures.push_back({name, *value});
    };
    add("mean_backward", row.mean_backward);
    add("mean", row.mean);
    add("B", row.reversal);
    add("s_forward", row.s_forward);
    add("s_backward", row.s_backward);
    return figures;
}

} // namespace axiscal
