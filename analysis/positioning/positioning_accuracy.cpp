// ISO 230-2, evaluation of a linear or rotary axis. With x_ij the deviation of approach j at target
// i, up and down the two directions of approach, k the cover factor of the edition:
//
//   xm_i up   = sum_j x_ij / n                 s_i up = sqrt(sum_j (x_ij - xm_i)^2 / (n - 1))
//   xm_i      = (xm_i up + xm_i down) / 2      B_i    = xm_i up - xm_i down   (signed)
//   R_i up    = 2 k s_i up                     R_i    = max(k s_i up + k s_i down + |B_i|,
//                                                           R_i up, R_i down)
//   E         = largest - smallest xm over both directions      M = largest - smallest xm_i
//   A         = largest (xm + k s) - smallest (xm - k s) over both directions
//   B = max |B_i|,  B_mean = sum B_i / m,  R = max R_i
//
// Only + - * / and sqrt in a fixed order: equal input gives equal bits on every compiler.

#include "analysis/positioning/positioning_accuracy.hpp"

#include "analysis/positioning/sums.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

/// Two passes; n >= 2.
double standard_deviation_of(const std::vector<double>& values, double mean) {
    double sum = 0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

void add_spread(PositionRow& row,
                const std::vector<double>& forward,
                const std::vector<double>* backward,
                double k) {
    row.s_forward = standard_deviation_of(forward, row.mean_forward);
    row.repeatability_forward = 2 * k * *row.s_forward;
    if (!backward) return;
    row.s_backward = standard_deviation_of(*backward, *row.mean_backward);
    row.repeatability_backward = 2 * k * *row.s_backward;
    const double both = k * *row.s_forward + k * *row.s_backward + std::fabs(*row.reversal);
    row.repeatability = std::max({both, *row.repeatability_forward, *row.repeatability_backward});
}

PositionRow make_row(double target,
                     const std::vector<double>& forward,
                     const std::vector<double>* backward,
                     double k) {
    PositionRow row;
    row.target = target;
    row.mean_forward = mean_of(forward);
    if (backward) {
        row.mean_backward = mean_of(*backward);
        row.mean = (row.mean_forward + *row.mean_backward) / 2;
        row.reversal = row.mean_forward - *row.mean_backward;
    }
    const bool repeated = forward.size() >= 2 && (backward == nullptr || backward->size() >= 2);
    if (repeated) add_spread(row, forward, backward, k);
    return row;
}

/// Figures of the mean values: need neither repetition nor, for E_forward, a second direction.
void evaluate_means(const std::vector<PositionRow>& rows, PositioningParameters& out) {
    const bool bidirectional = rows.front().mean_backward.has_value();
    Span forward, backward, both, means, reversals;
    std::vector<double> signed_reversals;
    for (const PositionRow& row : rows) {
        forward.include(row.mean_forward);
        both.include(row.mean_forward);
        if (!bidirectional) continue;
        backward.include(*row.mean_backward);
        both.include(*row.mean_backward);
        means.include(*row.mean);
        reversals.include(std::fabs(*row.reversal));
        signed_reversals.push_back(*row.reversal);
    }
    out.E_forward = forward.width();
    if (!bidirectional) return;
    out.E_backward = backward.width();
    out.E = both.width();
    out.M = means.width();
    out.B = reversals.high();
    out.B_mean = mean_of(signed_reversals);
}

/// Figures that need the spread of n >= 2 approaches.
void evaluate_spread(const std::vector<PositionRow>& rows, double k, PositioningParameters& out) {
    const bool bidirectional = rows.front().mean_backward.has_value();
    Span a_forward, a_backward, a_both, r_forward, r_backward, r_both;
    for (const PositionRow& row : rows) {
        const double up = k * *row.s_forward;
        a_forward.include(row.mean_forward - up, row.mean_forward + up);
        a_both.include(row.mean_forward - up, row.mean_forward + up);
        r_forward.include(*row.repeatability_forward);
        if (!bidirectional) continue;
        const double down = k * *row.s_backward;
        a_backward.include(*row.mean_backward - down, *row.mean_backward + down);
        a_both.include(*row.mean_backward - down, *row.mean_backward + down);
        r_backward.include(*row.repeatability_backward);
        r_both.include(*row.repeatability);
    }
    out.A_forward = a_forward.width();
    out.R_forward = r_forward.high();
    if (!bidirectional) return;
    out.A_backward = a_backward.width();
    out.A = a_both.width();
    out.R_backward = r_backward.high();
    out.R = r_both.high();
}

std::map<std::string, std::string> reasons_of_absence(bool bidirectional, int approaches) {
    const std::string single =
        "one approach per direction: no standard deviation, hence no R and no A";
    const std::string one_way = "no backward approaches: the test is unidirectional";
    std::map<std::string, std::string> reasons;
    if (approaches < 2)
        for (const char* key : {"A", "A_forward", "A_backward", "R", "R_forward", "R_backward"})
            reasons[key] = single;
    if (!bidirectional)
        for (const char* key :
             {"A", "A_backward", "E", "E_backward", "M", "R", "R_backward", "B", "B_mean"})
            reasons[key] = one_way;
    return reasons;
}

/// Fewest and most readings of a target and direction: they differ where some were excluded. Each
/// mean and each s is then of the n_ij readings that remain.
std::pair<std::size_t, std::size_t> numbers_of_readings(const RunAt20C& run) {
    std::size_t fewest = run.forward().front().size(), most = fewest;
    for (const auto* side : {&run.forward(), &run.backward()})
        for (const auto& row : *side) {
            fewest = std::min(fewest, row.size());
            most = std::max(most, row.size());
        }
    return {fewest, most};
}

} // namespace

int fewest_readings(const RunAt20C& run) {
    return run.forward().empty() ? 0 : static_cast<int>(numbers_of_readings(run).first);
}

PositioningResult
evaluate_positioning(const RunAt20C& run, std::string standard, double cover_factor) {
    const bool bidirectional = !run.backward().empty();
    PositioningResult result;
    result.standard = std::move(standard);
    result.unit = run.unit();
    result.provenance = run.provenance();
    result.cover_factor = cover_factor;
    const auto [fewest, most] = numbers_of_readings(run);
    result.approaches = static_cast<int>(most);
    for (std::size_t i = 0; i < run.targets().size(); ++i)
        result.positions.push_back(make_row(run.targets()[i], run.forward()[i],
                                            bidirectional ? &run.backward()[i] : nullptr,
                                            cover_factor));
    evaluate_means(result.positions, result.parameters);
    if (fewest >= 2) evaluate_spread(result.positions, cover_factor, result.parameters);
    result.not_evaluated = reasons_of_absence(bidirectional, static_cast<int>(fewest));
    return result;
}

} // namespace axiscal
