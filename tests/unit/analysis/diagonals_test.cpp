#include "analysis/geometry/diagonals.hpp"

#include "analysis/geometry/step_diagonal.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::diagonals_test {
namespace {

using Signs = std::array<int, 3>;
using Vector = std::array<double, 3>;

const std::vector<Signs> body{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
const std::vector<Signs> faces{{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};

/// A rigid machine: scale of each axis and the directions of its axes from three angles.
struct Machine {
    Vector scale{};                ///< relative
    double xy = 0, xz = 0, yz = 0; ///< opening of each pair, rad
    /// Where the tool stands for commanded x, y, z: X along x, Y in the xy plane.
    [[nodiscard]] Vector at(const Vector& p) const {
        const double x = p[0] * (1 + scale[0]), y = p[1] * (1 + scale[1]),
                     z = p[2] * (1 + scale[2]);
        const Vector Y{-std::sin(xy), std::cos(xy), 0};
        const double zx = -std::sin(xz);
        const double zy = (-std::sin(yz) - zx * Y[0]) / Y[1];
        const double zz = std::sqrt(1 - zx * zx - zy * zy);
        return {x + y * Y[0] + z * zx, y * Y[1] + z * zy, z * zz};
    }
};

double distance(const Vector& a, const Vector& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

DiagonalRun measured(const Machine& machine, const Box& box, const Signs& signs, int m = 6) {
    DiagonalRun run;
    run.signs = signs;
    const auto place = [&](double share) {
        Vector p{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = signs[axis] == 0  ? 0
                      : signs[axis] > 0 ? share * box[axis]
                                        : (1 - share) * box[axis];
        return machine.at(p);
    };
    for (int i = 0; i < m; ++i) {
        const double share = static_cast<double>(i) / (m - 1);
        run.table.targets.push_back(share * diagonal_length(box, signs));
        const double deviation = distance(place(0), place(share)) - run.table.targets.back();
        run.table.forward.push_back({deviation + 0.001, deviation + 0.003});
        run.table.backward.push_back({deviation - 0.002, deviation});
    }
    return run;
}

std::vector<DiagonalRun>
all_measured(const Machine& machine, const Box& box, const std::vector<Signs>& set) {
    std::vector<DiagonalRun> runs;
    for (const Signs& signs : set)
        runs.push_back(measured(machine, box, signs));
    return runs;
}

TEST(Diagonals, FindTheSquarenessOfASkewMachine) {
    const Machine machine{{2e-6, 2e-6, 2e-6}, 40e-6, -25e-6, 10e-6};
    const Box box{800, 500, 300};
    for (const auto& set : {body, faces}) {
        const auto found = evaluate_diagonals(box, all_measured(machine, box, set));
        ASSERT_TRUE(found.has_value()) << found.error().field << found.error().detail;
        const auto value = [&](const std::string& plane) {
            return found->from_body ? found->from_body->squareness_rad.at(plane)
                                    : found->from_faces.at(plane).squareness_rad.at(plane);
        };
        // second order: some (40e-6)^2
        EXPECT_NEAR(value("xy"), 40e-6, 1e-8);
        EXPECT_NEAR(value("xz"), -25e-6, 1e-8);
        EXPECT_NEAR(value("yz"), 10e-6, 1e-8);
        const double scale = found->from_body ? found->from_body->common_scale
                                              : found->from_faces.at("xy").common_scale;
        EXPECT_NEAR(scale, 2e-6, 1e-8);
    }
}

TEST(DiagonalLaws, FindEveryMachineToSecondOrder) {
    std::mt19937_64 random{1};
    std::uniform_real_distribution<double> error{-1e-4, 1e-4}, side{100, 3000};
    for (int trial = 0; trial < 200; ++trial) {
        const Machine machine{{error(random), error(random), error(random)},
                              error(random),
                              error(random),
                              error(random)};
        const Box box{side(random), side(random), side(random)};
        const auto found = evaluate_diagonals(box, all_measured(machine, box, body));
        const auto& squareness = found->from_body->squareness_rad;
        // second order of the length, 1e-8 L_d^2, over the product of the two shortest sides
        const double length = diagonal_length(box, {1, 1, 1});
        const auto bound = [&](std::size_t i, std::size_t j) {
            return 6e-8 * length * length / (box[i] * box[j]);
        };
        EXPECT_NEAR(squareness.at("xy"), machine.xy, bound(0, 1));
        EXPECT_NEAR(squareness.at("xz"), machine.xz, bound(0, 2));
        EXPECT_NEAR(squareness.at("yz"), machine.yz, bound(1, 2));
        const double common =
            (machine.scale[0] * box[0] * box[0] + machine.scale[1] * box[1] * box[1] +
             machine.scale[2] * box[2] * box[2]) /
            (length * length);
        EXPECT_NEAR(found->from_body->common_scale, common, 6e-8);
    }
}

TEST(DiagonalLaws, TheOtherEndOfADiagonalTellsTheSame) {
    const Machine machine{{1e-6, -2e-6, 5e-6}, 40e-6, -25e-6, 10e-6};
    const Box box{800, 500, 300};
    const auto there = evaluate_diagonals(box, all_measured(machine, box, body));
    const auto back = evaluate_diagonals(
        box, all_measured(machine, box, {{-1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}}));
    for (const char* plane : {"xy", "xz", "yz"})
        EXPECT_NEAR(there->from_body->squareness_rad.at(plane),
                    back->from_body->squareness_rad.at(plane), 1e-12);
    EXPECT_NEAR(there->from_body->common_scale, back->from_body->common_scale, 1e-12);
}

TEST(Diagonals, MachineFiguresAreTheWorstOfTheDiagonalsAndZeroIsAtTheStart) {
    const Machine machine{{0, 0, 0}, 100e-6, 0, 0};
    const Box box{1000, 1000, 1000};
    const auto found = evaluate_diagonals(box, all_measured(machine, box, body));
    double worst = 0;
    for (const DiagonalResult& one_of_four : found->diagonals) {
        worst = std::max(worst, *one_of_four.positioning.parameters.E);
        EXPECT_NEAR(*one_of_four.positioning.positions.front().mean, 0, 1e-15);
        // two approaches 0.002 apart: s = sqrt(2) 0.001; forward lies 0.003 above backward
        EXPECT_NEAR(*one_of_four.positioning.parameters.R, 0.003 + 4 * std::sqrt(2) * 0.001, 1e-9);
    }
    EXPECT_EQ(found->body->E_d, worst);
    // dL = 100e-6 * 1e6 / 1732, and the reversal
    EXPECT_NEAR(found->body->E_d, 100 / std::sqrt(3.0) * 1e-3 + 0.003, 1e-5);
    EXPECT_NEAR(*found->body->B_d, 0.003, 1e-12);
    EXPECT_NEAR(*found->body->R_d, 0.003 + 4 * std::sqrt(2) * 0.001, 1e-9);
    // slopes of -+ beta L_x L_y / L_d^2
    EXPECT_NEAR(found->body->slope_spread, 2 * 100e-6 / 3, 1e-8);
    EXPECT_FALSE(found->faces.has_value());
}

TEST(Diagonals, SayWhatTheyCannotSolve) {
    const Box box{800, 500, 300};
    auto found = evaluate_diagonals(box, all_measured({}, box, {{1, 1, 1}, {1, -1, 1}, {1, 1, 0}}));
    EXPECT_FALSE(found->from_body.has_value());
    EXPECT_TRUE(found->from_faces.empty());
    EXPECT_TRUE(found->not_evaluated.contains("from_body_diagonals"));
    EXPECT_TRUE(found->not_evaluated.contains("from_face_diagonals.xy"));
    EXPECT_TRUE(found->not_evaluated.contains("axis_scales"));
}

TEST(DiagonalsRefuse, WhatIsNoDiagonal) {
    const Box box{800, 500, 300};
    const auto field = [](const auto& result) { return result.error().field; };
    auto runs = all_measured({}, box, body);
    EXPECT_EQ(field(evaluate_diagonals({0, 500, 300}, runs)), "box.x");
    EXPECT_EQ(field(evaluate_diagonals(box, {})), "diagonals");
    runs[1].signs = {-1, -1, -1};
    EXPECT_EQ(field(evaluate_diagonals(box, runs)), "diagonals[1].signs");
    runs[1].signs = {1, 0, 0};
    EXPECT_EQ(field(evaluate_diagonals(box, runs)), "diagonals[1].signs");
    runs = all_measured({}, box, body);
    runs[2].table.targets.back() *= 2;
    EXPECT_EQ(field(evaluate_diagonals(box, runs)), "diagonals[2].targets");
    runs = all_measured({}, box, body);
    runs[3].table.forward.pop_back();
    EXPECT_EQ(field(evaluate_diagonals(box, runs)), "diagonals[3].forward");
}

// ---- step diagonal ----------------------------------------------------------------------------

struct StepMachine {
    std::size_t steps = 4;
    /// error[direction][axis][segment]
    std::array<std::array<std::vector<double>, 3>, 3> error;
};

StepMachine random_step_machine(std::mt19937_64& random) {
    std::normal_distribution<double> noise{0, 1};
    StepMachine machine;
    machine.steps = std::uniform_int_distribution<std::size_t>{1, 8}(random);
    for (auto& direction : machine.error)
        for (auto& axis : direction)
            for (std::size_t i = 0; i < machine.steps; ++i)
                axis.push_back(noise(random));
    return machine;
}

StepDiagonalRun walked(const StepMachine& machine,
                       const Box& box,
                       const Signs& signs,
                       const std::array<std::size_t, 3>& order) {
    StepDiagonalRun run{signs, {}};
    const double length = diagonal_length(box, signs);
    double reading = 0;
    for (std::size_t step = 0; step < machine.steps; ++step)
        for (const std::size_t axis : order) {
            const std::size_t segment = signs[axis] > 0 ? step : machine.steps - 1 - step;
            for (std::size_t d = 0; d < 3; ++d) // dot product with the diagonal's direction
                reading +=
                    signs[axis] * machine.error[d][axis][segment] * signs[d] * box[d] / length;
            run.deviations.push_back(reading);
        }
    return run;
}

TEST(StepDiagonalLaws, FindsEveryCurveOfAMachineThatFulfilsItsAssumptions) {
    std::mt19937_64 random{2};
    const Box box{800, 500, 300};
    const std::array<std::size_t, 3> order{2, 0, 1};
    for (int trial = 0; trial < 100; ++trial) {
        const StepMachine machine = random_step_machine(random);
        std::vector<StepDiagonalRun> runs;
        for (const Signs& signs :
             {Signs{1, 1, 1}, Signs{-1, -1, 1}, Signs{1, -1, 1}, Signs{1, -1, -1}})
            runs.push_back(walked(machine, box, signs, order));
        const auto found = evaluate_step_diagonal(box, order, runs);
        ASSERT_TRUE(found.has_value());
        for (std::size_t direction = 0; direction < 3; ++direction)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                double sum = 0;
                for (std::size_t i = 0; i < machine.steps; ++i)
                    EXPECT_NEAR(found->error[direction][axis][i + 1],
                                sum += machine.error[direction][axis][i], 1e-11);
            }
        for (const double closure : found->closure)
            EXPECT_NEAR(closure, 0, 1e-12);
        const double xy = -(found->error[1][0].back() / 800 + found->error[0][1].back() / 500);
        EXPECT_EQ(found->squareness_rad[0], xy);
    }
}

/// What the published criticism says: a beam that is not along the diagonal biases the curves, and
/// the closure does not see it where the error is the same way round in all four.
TEST(StepDiagonal, BeamAngleBiasesTheCurvesAtFirstOrderUnseenByTheClosure) {
    const Box box{1000, 1000, 1000};
    StepMachine still; // no errors at all
    for (auto& direction : still.error)
        for (auto& axis : direction)
            axis.assign(still.steps, 0);
    std::vector<StepDiagonalRun> runs;
    const double angle = 1e-4, step = 250;
    for (const Signs& signs : body) {
        StepDiagonalRun run = walked(still, box, signs, {0, 1, 2});
        double reading = 0; // the beam leans towards x and away from y
        for (std::size_t i = 0; i < run.deviations.size(); ++i) {
            if (i % 3 == 0) reading += signs[0] * step * angle;
            if (i % 3 == 1) reading -= signs[1] * step * angle;
            run.deviations[i] = reading;
        }
        runs.push_back(run);
    }
    const auto found = evaluate_step_diagonal(box, {0, 1, 2}, runs);
    EXPECT_GT(std::fabs(found->error[0][0].back()), 0.1); // 0.17 mm that is not there
    EXPECT_NEAR(found->closure[0], 0, 1e-15);
    EXPECT_EQ(step_diagonal_assumptions().size(), 5u);
}

TEST(StepDiagonalRefuses, WhatItCannotSeparate) {
    const Box box{800, 500, 300};
    std::vector<StepDiagonalRun> runs;
    for (const Signs& signs : body)
        runs.push_back({signs, {0, 0, 0}});
    const auto field = [&](const Box& sides, std::array<std::size_t, 3> order, const auto& set) {
        return evaluate_step_diagonal(sides, order, set).error().field;
    };
    EXPECT_EQ(field({1, -1, 1}, {0, 1, 2}, runs), "box.y");
    EXPECT_EQ(field(box, {0, 1, 1}, runs), "order");
    auto few = runs;
    few.pop_back();
    EXPECT_EQ(field(box, {0, 1, 2}, few), "diagonals");
    auto twice = runs;
    twice[3].signs = {-1, -1, 1};
    EXPECT_EQ(field(box, {0, 1, 2}, twice), "diagonals[3].signs");
    auto odd = runs;
    odd[2].deviations = {0, 0};
    EXPECT_EQ(field(box, {0, 1, 2}, odd), "diagonals[2].deviations");
}

} // namespace
} // namespace axiscal::diagonals_test
