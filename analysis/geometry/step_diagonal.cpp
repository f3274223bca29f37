#include "analysis/geometry/step_diagonal.hpp"

#include "analysis/checked_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

Result<void> check_box_and_order(const Box& box, const std::array<std::size_t, 3>& order) {
    constexpr std::array<const char*, 3> sides{"box.x", "box.y", "box.z"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        AXISCAL_CHECK(check_positive(box[axis], sides[axis]));
    auto sorted = order;
    std::ranges::sort(sorted);
    if (sorted != std::array<std::size_t, 3>{0, 1, 2})
        return refuse(Fault::bad_case, "order", "must name each of x, y, z once");
    return {};
}

Result<void> check_run(const std::vector<StepDiagonalRun>& runs, std::size_t i) {
    const std::string field = element_of("diagonals", i);
    const auto& run = runs[i];
    if (std::ranges::any_of(run.signs, [](int sign) { return std::abs(sign) != 1; }))
        return refuse(Fault::bad_case, field + ".signs", "must be three of -1, 1");
    for (std::size_t j = 0; j < i; ++j)
        if (same_diagonal_forward(runs[j].signs) == same_diagonal_forward(run.signs))
            return refuse(Fault::bad_case, field + ".signs",
                          "is the diagonal of " + element_of("diagonals", j) + " again");
    AXISCAL_CHECK(check_case_numbers(run.deviations, field + ".deviations"));
    if (run.deviations.empty() || run.deviations.size() % 3 != 0 ||
        run.deviations.size() != runs.front().deviations.size())
        return refuse(Fault::bad_case, field + ".deviations",
                      "must hold one reading after each of 3 n moves, as many as the others");
    return {};
}

/// Change of reading by the move of `axis` over segment `segment` (from its 0 end) of its side.
double change_over(const StepDiagonalRun& run,
                   const std::array<std::size_t, 3>& order,
                   std::size_t axis,
                   std::size_t segment) {
    const std::size_t steps = run.deviations.size() / 3;
    const std::size_t step = run.signs[axis] > 0 ? segment : steps - 1 - segment;
    const auto place = static_cast<std::size_t>(std::ranges::find(order, axis) - order.begin());
    const std::size_t move = 3 * step + place;
    return run.deviations[move] - (move == 0 ? 0 : run.deviations[move - 1]);
}

/// Sum over the diagonals of s_i s_j times the change of reading.
double signed_sum(const std::vector<StepDiagonalRun>& runs,
                  const std::array<double, 4>& changes,
                  std::size_t i,
                  std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
        sum += runs[k].signs[i] * runs[k].signs[j] * changes[k];
    return sum;
}

void add_segment(const Box& box,
                 const std::vector<StepDiagonalRun>& runs,
                 const std::array<double, 4>& changes,
                 std::size_t axis,
                 StepDiagonal& out) {
    const double length = diagonal_length(box, {1, 1, 1});
    for (std::size_t direction = 0; direction < 3; ++direction) {
        auto& curve = out.error[direction][axis];
        curve.push_back(curve.back() +
                        signed_sum(runs, changes, axis, direction) * length / (4 * box[direction]));
    }
    const double unexplained = signed_sum(runs, changes, (axis + 1) % 3, (axis + 2) % 3) / 4;
    out.closure[axis] = std::max(out.closure[axis], std::fabs(unexplained));
}

double opened(const Box& box, const StepDiagonal& out, std::size_t i, std::size_t j) {
    return -(out.error[j][i].back() / box[i] + out.error[i][j].back() / box[j]);
}

} // namespace

std::vector<std::string> step_diagonal_assumptions() {
    constexpr const char* alignment =
        "the beam lies along the diagonal: an angle between them enters every curve at first "
        "order and is not seen by the closure (Chapman 2003)";
    return {"estimation, not a calibration: it cannot stand for the 21 parameters", alignment,
            "the mirror is flat, square to the beam and does not tilt while it moves sideways",
            "no angular errors of the axes: levers differ between the diagonals",
            "no drift and no reversal between the moves; one direction of travel"};
}

Result<StepDiagonal> evaluate_step_diagonal(const Box& box,
                                            const std::array<std::size_t, 3>& order,
                                            const std::vector<StepDiagonalRun>& runs) {
    AXISCAL_CHECK(check_box_and_order(box, order));
    if (runs.size() != 4)
        return refuse(Fault::bad_case, "diagonals", "must be the four body diagonals");
    for (std::size_t i = 0; i < runs.size(); ++i)
        AXISCAL_CHECK(check_run(runs, i));
    StepDiagonal out;
    out.steps = runs.front().deviations.size() / 3;
    for (auto& of_direction : out.error)
        for (auto& curve : of_direction)
            curve.push_back(0);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t segment = 0; segment < out.steps; ++segment) {
            std::array<double, 4> changes{};
            for (std::size_t k = 0; k < 4; ++k)
                changes[k] = change_over(runs[k], order, axis, segment);
            add_segment(box, runs, changes, axis, out);
        }
    out.squareness_rad = {opened(box, out, 0, 1), opened(box, out, 0, 2), opened(box, out, 1, 2)};
    return out;
}

} // namespace axiscal
