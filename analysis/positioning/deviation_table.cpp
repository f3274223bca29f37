// Shape and content of a deviation table, checked once at the door.

#include "analysis/compensation/run_at_20C_maker.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

/// Far beyond any machine in any unit, far below where a square overflows.
constexpr double largest_magnitude = 1e12;

std::string indexed(const std::string& field, std::size_t index) {
    return field + "[" + std::to_string(index) + "]";
}

Result<void> check_number(double value, const std::string& field) {
    if (std::isnan(value)) return refuse(Fault::bad_case, field, "is not a number (NaN)");
    if (std::isinf(value)) return refuse(Fault::bad_case, field, "is infinite");
    if (std::fabs(value) > largest_magnitude)
        return refuse(Fault::bad_case, field, "is larger than 1e12, beyond any machine");
    return {};
}

Result<void> check_targets(const std::vector<double>& targets) {
    if (targets.empty())
        return refuse(Fault::bad_case, "targets", "is empty; at least one target is needed");
    for (std::size_t i = 0; i < targets.size(); ++i)
        if (auto good = check_number(targets[i], indexed("targets", i)); !good) return good;
    std::vector<std::size_t> order(targets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return targets[i]; });
    const auto twin = std::ranges::adjacent_find(
        order, [&](std::size_t a, std::size_t b) { return targets[a] == targets[b]; });
    if (twin == order.end()) return {};
    return refuse(Fault::bad_case, indexed("targets", *std::next(twin)),
                  "repeats " + indexed("targets", *twin) + "; each target stands once");
}

Result<void> check_row(const std::vector<double>& row, std::size_t n, const std::string& field) {
    if (row.size() != n)
        return refuse(Fault::bad_case, field,
                      "has " + std::to_string(row.size()) + " readings where forward[0] has " +
                          std::to_string(n));
    for (std::size_t j = 0; j < n; ++j)
        if (auto good = check_number(row[j], indexed(field, j)); !good) return good;
    return {};
}

Result<void> check_rows(const std::vector<std::vector<double>>& rows,
                        std::size_t m,
                        std::optional<std::size_t> n,
                        const std::string& field) {
    if (rows.size() != m)
        return refuse(Fault::bad_case, field,
                      "has " + std::to_string(rows.size()) + " rows for " + std::to_string(m) +
                          " targets");
    for (std::size_t i = 0; i < m; ++i)
        if (auto good = check_row(rows[i], n.value_or(rows[i].size()), indexed(field, i)); !good)
            return good;
    for (std::size_t i = 0; i < m; ++i)
        if (rows[i].empty())
            return refuse(Fault::bad_case, indexed(field, i),
                          "is empty; at least one reading is needed");
    return {};
}

} // namespace

Result<RunAt20C>
declare_at_20C(DeviationTable table, const std::string& reason, RowLengths readings) {
    if (reason.empty())
        return refuse(Fault::bad_case, "compensation", "says not why the data stand for 20 degC");
    if (auto good = check_targets(table.targets); !good) return tl::unexpected(good.error());
    const std::size_t m = table.targets.size();
    std::optional<std::size_t> n;
    if (readings == RowLengths::equal && !table.forward.empty()) n = table.forward.front().size();
    if (n == 0)
        return refuse(Fault::bad_case, "forward[0]", "is empty; at least one reading is needed");
    if (auto good = check_rows(table.forward, m, n, "forward"); !good)
        return tl::unexpected(good.error());
    if (!table.backward.empty())
        if (auto good = check_rows(table.backward, m, n, "backward"); !good)
            return tl::unexpected(good.error());
    return RunAt20CMaker::make(std::move(table), "already_at_20C: " + reason);
}

} // namespace axiscal
