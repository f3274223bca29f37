#include "analysis/geometry/diagonals.hpp"

#include "analysis/checked_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using Signs = std::array<int, 3>;

constexpr std::array<std::pair<std::size_t, std::size_t>, 3> planes{{{0, 1}, {0, 2}, {1, 2}}};

std::string plane_name(std::pair<std::size_t, std::size_t> plane) {
    constexpr std::string_view letters = "xyz";
    return {letters[plane.first], letters[plane.second]};
}

bool is_body(const Signs& signs) {
    return std::ranges::count(signs, 0) == 0;
}

Result<void> check_signs(const Signs& signs, const std::string& field) {
    if (std::ranges::any_of(signs, [](int sign) { return std::abs(sign) > 1; }))
        return refuse(Fault::bad_case, field, "must be three of -1, 0, 1");
    if (std::ranges::count(signs, 0) > 1)
        return refuse(Fault::bad_case, field, "must move two axes (face) or three (body)");
    return {};
}

Result<void> check_runs(const Box& box, const std::vector<DiagonalRun>& runs) {
    constexpr std::array<const char*, 3> sides{"box.x", "box.y", "box.z"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        AXISCAL_CHECK(check_positive(box[axis], sides[axis]));
    if (runs.empty()) return refuse(Fault::bad_case, "diagonals", "is empty");
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string field = element_of("diagonals", i) + ".signs";
        AXISCAL_CHECK(check_signs(runs[i].signs, field));
        for (std::size_t j = 0; j < i; ++j)
            if (same_diagonal_forward(runs[j].signs) == same_diagonal_forward(runs[i].signs))
                return refuse(Fault::bad_case, field,
                              "is the diagonal of diagonals[" + std::to_string(j) + "] again");
    }
    return {};
}

Result<void> check_targets(const std::vector<double>& targets, double length) {
    if (targets.size() < 2) return refuse(Fault::bad_case, "targets", "needs at least two targets");
    AXISCAL_CHECK(check_rising(targets, "targets"));
    const double slack = 0.01 * length;
    if (targets.front() >= -slack && targets.back() <= length + slack) return {};
    return refuse(Fault::bad_case, "targets",
                  "must lie on the diagonal, 0.." + std::to_string(length));
}

double mean_of(const PositionRow& row) {
    return row.mean.value_or(row.mean_forward);
}

/// Subtracts the mean at the start point from every reading.
void put_zero_at_start(DeviationTable& table, double start) {
    for (auto* rows : {&table.forward, &table.backward})
        for (auto& row : *rows)
            for (double& value : row)
                value -= start;
}

double least_squares_slope(const std::vector<PositionRow>& rows) {
    double target = 0, mean = 0, xx = 0, xy = 0;
    for (const PositionRow& row : rows)
        target += row.target, mean += mean_of(row);
    target /= static_cast<double>(rows.size());
    mean /= static_cast<double>(rows.size());
    for (const PositionRow& row : rows) {
        xx += (row.target - target) * (row.target - target);
        xy += (row.target - target) * (mean_of(row) - mean);
    }
    return xy / xx;
}

Result<DiagonalResult> evaluate_one(const Box& box, DiagonalRun run) {
    DiagonalResult out;
    out.signs = run.signs;
    out.length = diagonal_length(box, run.signs);
    const std::string reason = "a diagonal is taken as measured at 20 degC";
    AXISCAL_TRY(const RunAt20C as_given, declare_at_20C(run.table, reason));
    AXISCAL_CHECK(check_targets(run.table.targets, out.length));
    put_zero_at_start(run.table, mean_of(evaluate_positioning(as_given).positions.front()));
    AXISCAL_TRY(const RunAt20C zeroed, declare_at_20C(std::move(run.table), reason));
    out.positioning = evaluate_positioning(zeroed, "ISO 230-6:2002");
    const auto& rows = out.positioning.positions;
    out.slope_least_squares = least_squares_slope(rows);
    out.slope_end_points =
        (mean_of(rows.back()) - mean_of(rows.front())) / (rows.back().target - rows.front().target);
    out.length_error = out.slope_least_squares * out.length;
    return out;
}

void keep_larger(std::optional<double>& largest, const std::optional<double>& value) {
    if (value) largest = std::max(largest.value_or(*value), *value);
}

std::optional<DiagonalMachine> worst_of(const std::vector<DiagonalResult>& all, bool body) {
    std::optional<DiagonalMachine> machine;
    double low = 0, high = 0;
    for (const DiagonalResult& single : all) {
        if (is_body(single.signs) != body) continue;
        const auto& p = single.positioning.parameters;
        const double slope = single.slope_least_squares;
        low = machine ? std::min(low, slope) : slope;
        high = machine ? std::max(high, slope) : slope;
        if (!machine) machine.emplace();
        machine->E_d = std::max(machine->E_d, p.E ? *p.E : p.E_forward.value_or(0));
        keep_larger(machine->B_d, p.B);
        keep_larger(machine->R_d, p.R ? p.R : p.R_forward);
        machine->slope_spread = high - low;
    }
    return machine;
}

/// The columns of the linear model are orthogonal over a complete set of diagonals: each unknown
/// is a signed mean of L_d dL.
DiagonalSquareness solve(const Box& box,
                         const std::vector<const DiagonalResult*>& set,
                         const std::vector<std::pair<std::size_t, std::size_t>>& unknown) {
    const auto count = static_cast<double>(set.size());
    DiagonalSquareness out;
    double sum = 0;
    for (const DiagonalResult* single : set)
        sum += single->length * single->length_error;
    out.common_scale = sum / count / (set.front()->length * set.front()->length);
    for (const auto& plane : unknown) {
        double signed_sum = 0;
        for (const DiagonalResult* single : set)
            signed_sum += single->signs[plane.first] * single->signs[plane.second] *
                          single->length * single->length_error;
        out.squareness_rad[plane_name(plane)] =
            -signed_sum / count / (box[plane.first] * box[plane.second]);
    }
    return out;
}

void solve_body(const Box& box, Diagonals& out) {
    std::vector<const DiagonalResult*> set;
    for (const DiagonalResult& single : out.diagonals)
        if (is_body(single.signs)) set.push_back(&single);
    if (set.empty()) return;
    out.not_evaluated["axis_scales"] =
        "the four body diagonals share one scale term; the scales of the single axes need "
        "positioning tests along them";
    if (set.size() == 4)
        out.from_body = solve(box, set, {planes.begin(), planes.end()});
    else
        out.not_evaluated["from_body_diagonals"] =
            "squareness needs all four body diagonals; " + std::to_string(set.size()) +
            " of them leave only combinations of squareness and scale";
}

void solve_faces(const Box& box, Diagonals& out) {
    for (const auto& plane : planes) {
        std::vector<const DiagonalResult*> set;
        for (const DiagonalResult& single : out.diagonals)
            if (!is_body(single.signs) && single.signs[plane.first] != 0 &&
                single.signs[plane.second] != 0)
                set.push_back(&single);
        if (set.size() == 2) out.from_faces[plane_name(plane)] = solve(box, set, {plane});
        if (set.size() == 1)
            out.not_evaluated["from_face_diagonals." + plane_name(plane)] =
                "one face diagonal cannot tell squareness from scale; both are needed";
    }
}

} // namespace

double diagonal_length(const Box& box, const Signs& signs) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (signs[axis] != 0) sum += box[axis] * box[axis];
    return std::sqrt(sum);
}

Signs same_diagonal_forward(const Signs& signs) {
    const auto first = std::ranges::find_if(signs, [](int sign) { return sign != 0; });
    if (first == signs.end() || *first > 0) return signs;
    return {-signs[0], -signs[1], -signs[2]};
}

Result<Diagonals> evaluate_diagonals(const Box& box, std::vector<DiagonalRun> runs) {
    AXISCAL_CHECK(check_runs(box, runs));
    Diagonals out;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto single = evaluate_one(box, std::move(runs[i]));
        if (!single)
            return refuse(Fault::bad_case, element_of("diagonals", i) + "." + single.error().field,
                          single.error().detail);
        out.diagonals.push_back(*std::move(single));
    }
    out.body = worst_of(out.diagonals, true);
    out.faces = worst_of(out.diagonals, false);
    solve_body(box, out);
    solve_faces(box, out);
    return out;
}

} // namespace axiscal
