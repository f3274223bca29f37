#include "analysis/positioning/style_rows.hpp"

#include <cmath>

namespace axiscal {
namespace {

struct VdiSums {
    Span means, reversals, scatters, band;
    std::vector<double> all_reversals, all_scatters;
};

NamedFigures evaluate_row(const PositionRow& row, VdiSums& sums) {
    auto figures = common_figures(row);
    const double reversal = std::fabs(*row.reversal);
    figures.push_back({"U", reversal});
    sums.means.include(*row.mean);
    sums.reversals.include(reversal);
    sums.all_reversals.push_back(reversal);
    if (!row.s_forward) return figures;
    const double s = (*row.s_forward + *row.s_backward) / 2;
    const double scatter = 6 * s, half = (reversal + scatter) / 2;
    figures.push_back({"s", s});
    figures.push_back({"Ps", scatter});
    sums.scatters.include(scatter);
    sums.all_scatters.push_back(scatter);
    sums.band.include(*row.mean - half, *row.mean + half);
    return figures;
}

} // namespace

StyleResult evaluate_vdi_3441(const RunAt20C& run) {
    StyleResult result;
    const auto rows = rows_of_run(run);
    if (run.backward().empty()) {
        for (const PositionRow& row : rows)
            result.positions.push_back(common_figures(row));
        leave_out(result, {"P", "Pa", "Ps_max", "Ps_mean", "U_max", "U_mean"}, absent_one_way);
        return result;
    }
    VdiSums sums;
    for (const PositionRow& row : rows)
        result.positions.push_back(evaluate_row(row, sums));
    if (sums.scatters.empty())
        leave_out(result, {"P", "Ps_max", "Ps_mean"}, absent_single);
    else
        result.parameters = {{"P", sums.band.width()}};
    result.parameters.push_back({"Pa", sums.means.width()});
    if (!sums.scatters.empty()) {
        result.parameters.push_back({"Ps_max", sums.scatters.high()});
        result.parameters.push_back({"Ps_mean", mean_of(sums.all_scatters)});
    }
    result.parameters.push_back({"U_max", sums.reversals.high()});
    result.parameters.push_back({"U_mean", mean_of(sums.all_reversals)});
    return result;
}

} // namespace axiscal
