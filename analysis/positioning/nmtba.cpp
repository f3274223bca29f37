#include "analysis/positioning/style_rows.hpp"

#include <cmath>

namespace axiscal {
namespace {

/// Mean of all mean deviations of both directions (each target counts the same).
double offset_of(const std::vector<PositionRow>& rows) {
    std::vector<double> means;
    means.reserve(rows.size());
    for (const PositionRow& row : rows)
        means.push_back(row.mean ? *row.mean : row.mean_forward);
    return mean_of(means);
}

struct NmtbaSums {
    Span r_forward, r_backward, r_both, a_forward, a_backward, a_both;
};

void include_row(const PositionRow& row, double offset, NmtbaSums& sums) {
    const double up = 3 * *row.s_forward;
    sums.r_forward.include(up);
    sums.a_forward.include(std::fabs(row.mean_forward - offset) + up);
    if (!row.mean_backward) return;
    const double down = 3 * *row.s_backward;
    sums.r_backward.include(down);
    sums.a_backward.include(std::fabs(*row.mean_backward - offset) + down);
    const double half = std::max(up, down) + std::fabs(*row.reversal) / 2;
    sums.r_both.include(half);
    sums.a_both.include(std::fabs(*row.mean - offset) + half);
}

} // namespace

StyleResult evaluate_nmtba(const RunAt20C& run, bool with_offset) {
    StyleResult result;
    const auto rows = rows_of_run(run);
    for (const PositionRow& row : rows)
        result.positions.push_back(common_figures(row));
    const bool two_ways = !run.backward().empty();
    if (!two_ways)
        leave_out(result,
                  {"accuracy", "accuracy_backward", "repeatability", "repeatability_backward"},
                  absent_one_way);
    if (!rows.front().s_forward) {
        leave_out(result,
                  {"accuracy", "accuracy_forward", "accuracy_backward", "repeatability",
                   "repeatability_forward", "repeatability_backward"},
                  absent_single);
        return result;
    }
    NmtbaSums sums;
    const double offset = with_offset ? 0 : offset_of(rows);
    for (const PositionRow& row : rows)
        include_row(row, offset, sums);
    auto& out = result.parameters;
    if (two_ways) out.push_back({"accuracy", sums.a_both.high()});
    out.push_back({"accuracy_forward", sums.a_forward.high()});
    if (two_ways) out.push_back({"accuracy_backward", sums.a_backward.high()});
    if (two_ways) out.push_back({"repeatability", sums.r_both.high()});
    out.push_back({"repeatability_forward", sums.r_forward.high()});
    if (two_ways) out.push_back({"repeatability_backward", sums.r_backward.high()});
    return result;
}

} // namespace axiscal
