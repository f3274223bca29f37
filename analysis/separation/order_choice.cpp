// Orders of a separation by AICc, over every combination for the three axes of a row.

#include "analysis/separation/design_row.hpp"
#include "analysis/separation/error_separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axiscal {
namespace {

struct Candidates {
    const SeparationCase& stated;
    const DesignRow& design;  ///< of the highest orders
    const Triangle& whole;    ///< with the free constant last
    double least_squares = 0; ///< a residual below this is rounding

    /// Columns of the stated orders within the highest design.
    [[nodiscard]] std::vector<std::size_t> columns(const PerAxis<std::size_t>& orders) const {
        const std::size_t constant = stated.constant == ConstantRule::paper ? 1 : 0;
        std::vector<std::size_t> chosen;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t k = 0; k < orders[axis] + constant; ++k)
                chosen.push_back(design.first_column(axis) + k);
        if (stated.constant == ConstantRule::free_row) chosen.push_back(design.curve_columns());
        return chosen;
    }

    [[nodiscard]] double criterion(const PerAxis<std::size_t>& orders) const {
        const auto chosen = columns(orders);
        const Triangle part = choose_columns(whole, chosen);
        const SingularValues parts = singular_values(part.upper);
        const auto rank = solve_minimum_norm(part).rank;
        // what the kept columns leave, element by element: a difference of sums of squares would
        // keep half the digits
        std::vector<double> unexplained = part.projected;
        for (std::size_t j = 0; j < rank; ++j) {
            const double share = dot(parts.left.column(j), part.projected);
            for (std::size_t i = 0; i < unexplained.size(); ++i)
                unexplained[i] -= share * parts.left(i, j);
        }
        const double left = std::max(part.remainder + dot(unexplained, unexplained), least_squares);
        const auto m = static_cast<double>(whole.rows), p = static_cast<double>(rank + 1);
        if (m - p - 1 <= 0) return std::numeric_limits<double>::max();
        return m * std::log(left / m) + 2 * p + 2 * p * (p + 1) / (m - p - 1);
    }
};

PerAxis<std::size_t> best_of(const Candidates& candidates, std::size_t highest) {
    std::vector<PerAxis<std::size_t>> all;
    for (std::size_t x = 0; x <= highest; ++x)
        for (std::size_t y = 0; y <= highest; ++y)
            for (std::size_t z = 0; z <= highest; ++z)
                if (x + y + z > 0) all.push_back({x, y, z});
    std::ranges::stable_sort(
        all, [](const auto& a, const auto& b) { return a[0] + a[1] + a[2] < b[0] + b[1] + b[2]; });
    PerAxis<std::size_t> best = all.front();
    double least = std::numeric_limits<double>::max();
    for (const auto& orders : all) {
        const double value = candidates.criterion(orders);
        // 1e-6 of the criterion is far below what would speak for another column
        if (value < least - 1e-6) {
            least = value;
            best = orders;
        }
    }
    return best;
}

} // namespace

Result<PerCurve<std::size_t>> choose_orders(const SeparationCase& stated, std::size_t highest) {
    if (highest < 1 || highest > highest_chosen_order)
        return refuse(Fault::bad_case, "max_order", "must be 1 to 6");
    SeparationCase full = stated;
    for (auto& row : full.model.orders)
        row.fill(highest);
    AXISCAL_CHECK(check_separation(full));
    PerCurve<std::size_t> orders{};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        DesignRow design{full.model, full.constant, direction};
        TriangleOfRows rows{design.curve_columns() + 1};
        double largest = std::numeric_limits<double>::min();
        for (std::size_t i = 0; i < full.points_mm.size(); ++i) {
            const double deviation = full.deviation_um[i][direction];
            rows.add(design.at(full.points_mm[i]), deviation);
            largest = std::max(largest, std::fabs(deviation));
        }
        const Triangle whole = rows.finish();
        const double rounding = 1e-13 * largest;
        const double least = static_cast<double>(whole.rows) * rounding * rounding;
        orders[direction] = best_of(
            {full, design, whole, std::max(least, std::numeric_limits<double>::min())}, highest);
    }
    return orders;
}

} // namespace axiscal
