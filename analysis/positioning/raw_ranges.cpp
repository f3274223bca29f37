#include "analysis/positioning/style_rows.hpp"

#include <cmath>

namespace axiscal {
namespace {

Span span_of(const std::vector<double>& readings) {
    Span span;
    for (const double reading : readings)
        span.include(reading);
    return span;
}

struct RawSums {
    Span r_forward, r_backward, r_both, a_forward, a_backward, a_both;
};

/// Of target i; `repeated` when n >= 2.
NamedFigures evaluate_row(
    const RunAt20C& run, std::size_t i, bool repeated, NamedFigures figures, RawSums& sums) {
    const Span up = span_of(run.forward()[i]);
    sums.a_forward.include(up.low(), up.high());
    sums.a_both.include(up.low(), up.high());
    sums.r_forward.include(up.width());
    if (repeated) figures.push_back({"R_raw_forward", up.width()});
    if (run.backward().empty()) return figures;
    const Span down = span_of(run.backward()[i]);
    Span both = up;
    both.include(down.low(), down.high());
    sums.a_backward.include(down.low(), down.high());
    sums.a_both.include(down.low(), down.high());
    sums.r_backward.include(down.width());
    sums.r_both.include(both.width());
    if (!repeated) return figures;
    figures.push_back({"R_raw_backward", down.width()});
    figures.push_back({"R_raw", both.width()});
    return figures;
}

void write_parameters(const RawSums& sums, bool repeated, bool two_ways, StyleResult& result) {
    auto& out = result.parameters;
    if (two_ways) out.push_back({"A_raw", sums.a_both.width()});
    out.push_back({"A_raw_forward", sums.a_forward.width()});
    if (two_ways) out.push_back({"A_raw_backward", sums.a_backward.width()});
    if (repeated && two_ways) out.push_back({"R_raw", sums.r_both.high()});
    if (repeated) out.push_back({"R_raw_forward", sums.r_forward.high()});
    if (repeated && two_ways) out.push_back({"R_raw_backward", sums.r_backward.high()});
    if (!repeated) leave_out(result, {"R_raw", "R_raw_forward", "R_raw_backward"}, absent_single);
    if (!two_ways)
        leave_out(result, {"A_raw", "A_raw_backward", "R_raw", "R_raw_backward"}, absent_one_way);
}

} // namespace

StyleResult evaluate_raw_ranges(const RunAt20C& run) {
    StyleResult result;
    const auto rows = rows_of_run(run);
    const bool repeated = run.forward().front().size() >= 2;
    RawSums sums;
    for (std::size_t i = 0; i < rows.size(); ++i)
        result.positions.push_back(evaluate_row(run, i, repeated, common_figures(rows[i]), sums));
    write_parameters(sums, repeated, !run.backward().empty(), result);
    return result;
}

StyleResult evaluate_asme_b554_1992(const RunAt20C& run) {
    StyleResult result = evaluate_raw_ranges(run);
    if (run.backward().empty()) {
        leave_out(result, {"B", "B_mean"}, absent_one_way);
        return result;
    }
    Span reversals;
    std::vector<double> all;
    for (const PositionRow& row : rows_of_run(run)) {
        reversals.include(std::fabs(*row.reversal));
        all.push_back(*row.reversal);
    }
    result.parameters.push_back({"B", reversals.high()});
    result.parameters.push_back({"B_mean", mean_of(all)});
    return result;
}

} // namespace axiscal
