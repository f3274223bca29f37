#include "analysis/positioning/style_rows.hpp"

#include <array>
#include <cmath>
#include <numeric>

namespace axiscal {
namespace {

constexpr std::size_t approaches_of_the_style = 7;

/// Indices of the lowest, the middle and the highest target; m >= 3.
std::array<std::size_t, 3> three_places(const std::vector<double>& targets) {
    std::vector<std::size_t> order(targets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return targets[i]; });
    const double centre = (targets[order.front()] + targets[order.back()]) / 2;
    std::size_t middle = order[1];
    for (std::size_t k = 1; k + 1 < order.size(); ++k)
        if (std::fabs(targets[order[k]] - centre) < std::fabs(targets[middle] - centre))
            middle = order[k];
    return {order.front(), middle, order.back()};
}

double largest_half_range(const std::vector<std::vector<double>>& rows,
                          const std::array<std::size_t, 3>& places) {
    double largest = 0;
    for (const std::size_t place : places) {
        const auto [low, high] = std::ranges::minmax(rows[place]);
        largest = std::max(largest, (high - low) / 2);
    }
    return largest;
}

void add_repeatability(const RunAt20C& run,
                       const std::array<std::size_t, 3>& places,
                       StyleResult& result) {
    const double up = largest_half_range(run.forward(), places);
    if (run.backward().empty()) {
        result.parameters.push_back({"repeatability_forward", up});
        return;
    }
    const double down = largest_half_range(run.backward(), places);
    result.parameters.push_back({"repeatability", std::max(up, down)});
    result.parameters.push_back({"repeatability_forward", up});
    result.parameters.push_back({"repeatability_backward", down});
}

void add_lost_motion(const std::vector<PositionRow>& rows,
                     const std::array<std::size_t, 3>& places,
                     StyleResult& result) {
    double largest = 0;
    for (const std::size_t place : places)
        largest = std::max(largest, std::fabs(*rows[place].reversal));
    result.parameters.push_back({"lost_motion", largest});
}

} // namespace

StyleResult evaluate_jis_b_6330(const RunAt20C& run) {
    StyleResult result;
    const auto rows = rows_of_run(run);
    Span first_pass;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result.positions.push_back(common_figures(rows[i]));
        first_pass.include(run.forward()[i].front());
    }
    result.parameters.push_back({"positioning", first_pass.width()});
    const std::size_t n = run.forward().front().size();
    if (n < 2)
        leave_out(result, {"repeatability", "repeatability_forward", "repeatability_backward"},
                  absent_single);
    if (run.backward().empty())
        leave_out(result, {"repeatability", "repeatability_backward", "lost_motion"},
                  absent_one_way);
    if (rows.size() < 3) {
        leave_out(
            result,
            {"repeatability", "repeatability_forward", "repeatability_backward", "lost_motion"},
            "fewer than three targets: both ends and the middle are asked for");
        return result;
    }
    if (n < approaches_of_the_style)
        result.notes.push_back("n = " + std::to_string(n) +
                               " approaches where the style asks for 7");
    const auto places = three_places(run.targets());
    if (n >= 2) add_repeatability(run, places, result);
    if (!run.backward().empty()) add_lost_motion(rows, places, result);
    return result;
}

} // namespace axiscal
