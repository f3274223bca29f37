// The part program of a rotary axis, carried out on paper: where the axis goes, where the table
// stands, and what the interferometer between them would see.
#include "acquisition/program/part_program.hpp"
#include "acquisition/program/table_halts.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace axiscal::rotary_program_test {
namespace {

RotarySetup table_of(double step_deg) {
    RotarySetup setup;
    setup.step_deg = step_deg;
    setup.arm = mm(32.61);
    setup.range_deg = 10;
    setup.turn_time = std::chrono::milliseconds{2500};
    return setup;
}

/// Eight targets over a turn, two approaches each way, datum at -2.
RunPlan plan_of_a_turn() {
    RunPlan plan;
    plan.axis_kind = AxisKind::rotary;
    plan.approaches = 2;
    plan.overrun = mm(1);
    plan.datum = mm(-2);
    for (const double target : {0.0, 46.3, 90.0, 132.9, 180.0, 224.4, 270.0, 318.8})
        plan.targets.push_back(mm(target));
    for (int j = 0; j < 2; ++j)
        for (const Direction direction : {Direction::positive, Direction::negative})
            for (int i = 0; i < 8; ++i)
                plan.points.push_back({static_cast<int>(plan.points.size()),
                                       direction == Direction::positive ? i : 7 - i, direction, j});
    return plan;
}

ProgramOrder order_of(double step_deg) {
    ProgramOrder order;
    order.plan = plan_of_a_turn();
    order.axis = "A";
    order.feed = mm_per_minute(360);
    order.dwell = std::chrono::seconds{4};
    order.shape = TriggerShape::single_register;
    order.rotary = table_of(step_deg);
    return order;
}

/// What the control does line by line, every wait answered.
struct Paper {
    double axis_deg = -2, before_deg = -2;
    int table = 0, table_at_approach = 0, requests = 0;
    double largest_rest_deg = 0, halted_s = 0;
};

/// One line; the axis moves at once, the table while the axis halts.
void carry_out(const std::string& line, double step_deg, const RunPlan& plan, Paper& paper) {
    const auto see = [&] {
        const double rest = paper.axis_deg - plan.datum.in(mm)-paper.table * step_deg;
        paper.largest_rest_deg = std::max(paper.largest_rest_deg, std::fabs(rest));
    };
    double value = 0;
    if (std::sscanf(line.c_str(), "G1 A%lf", &value) == 1) {
        paper.before_deg = paper.axis_deg;
        paper.axis_deg = value;
        paper.table_at_approach = paper.table;
        see();
    }
    if (std::sscanf(line.c_str(), "M68 E6 Q%lf", &value) == 1) {
        paper.table = static_cast<int>(value);
        see();
    }
    if (std::sscanf(line.c_str(), "M68 E0 Q%lf", &value) != 1 || value == 0) return;
    if (static_cast<int>(value) != paper.requests + 1) return; // asked again
    const PlannedPoint& point = plan.points[static_cast<std::size_t>(paper.requests++)];
    const double target = plan.targets[static_cast<std::size_t>(point.target_index)].in(mm);
    EXPECT_NEAR(paper.axis_deg, target, 5e-5) << "request " << value;
    EXPECT_NEAR(paper.axis_deg - paper.before_deg, static_cast<int>(point.direction), 1e-4)
        << "the approach of request " << value;
    EXPECT_EQ(paper.table, paper.table_at_approach) << "the table turned after the approach";
    EXPECT_EQ(paper.table, std::lround((target + 2) / step_deg)) << "request " << value;
}

TEST(RotaryProgram, KeepsTheInterferometerInItsRangeAndApproachesBehindAStandingTable) {
    for (const double step_deg : {1.0, 5.0, 0.5}) {
        const ProgramOrder order = order_of(step_deg);
        const auto text = write_linuxcnc(order);
        ASSERT_TRUE(text) << describe(text.error());
        Paper paper;
        std::istringstream lines{*text};
        bool again = false; // bodies of "not answered"
        for (std::string line; std::getline(lines, line);) {
            if (line.find(" if [#5399") != std::string::npos) again = true;
            if (!again) carry_out(line, step_deg, order.plan, paper);
            if (line.find(" endif") != std::string::npos) again = false;
        }
        EXPECT_EQ(paper.requests, 32);
        EXPECT_LE(paper.largest_rest_deg, 9.5 + 1e-9) << step_deg;
    }
}

TEST(RotaryProgram, HaltsForTheTableOrWaitsForAPerson) {
    ProgramOrder order = order_of(5);
    std::string text = *write_linuxcnc(order);
    EXPECT_NE(text.find("M68 E6 Q1\nG4 P2.500\n"), std::string::npos);
    EXPECT_EQ(text.find("M0\n"), std::string::npos);
    order.rotary->by_hand = true;
    text = *write_linuxcnc(order);
    EXPECT_NE(text.find("(MSG,axiscal: indexing table to position 1)\nM68 E6 Q1\nM0\n"),
              std::string::npos);
}

TEST(RotaryProgram, OfAPolygonTurnsNoTable) {
    ProgramOrder order = order_of(45);
    order.rotary->method = AngleMethod::polygon;
    const std::string text = *write_linuxcnc(order);
    EXPECT_EQ(text.find("M68 E6"), std::string::npos);
    EXPECT_NE(text.find("G1 A90.0000"), std::string::npos);
}

TEST(RotaryProgram, IsNotWrittenWhereNobodyKnowsWhereTheTableStands) {
    ProgramOrder order = order_of(5);
    order.retakes = true;
    EXPECT_FALSE(write_linuxcnc(order));
    order.retakes = false;
    order.shape = TriggerShape::dwell;
    EXPECT_FALSE(write_marlin(order));
}

TEST(TableHalts, AreNoneWhereTheTableStaysAndOneWhereItIsTurnedAtTheGoal) {
    EXPECT_TRUE(table_halts(table_of(5), 0, 0, 0, 2, 0).empty());
    const auto one = table_halts(table_of(5), 0, 0, 0, 4, 1);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].coordinate_deg, 4);
    EXPECT_EQ(one[0].position, 1);
}

// 95 % of 10 degrees hold one step of 5 or nine of 1.
TEST(TableHalts, GoInStridesOfWholeSteps) {
    const auto coarse = table_halts(table_of(5), 0, 0, 0, 21, 4);
    ASSERT_EQ(coarse.size(), 4U);
    EXPECT_EQ(coarse[0].coordinate_deg, 5);
    EXPECT_EQ(coarse[2].position, 3);
    EXPECT_EQ(coarse[3].coordinate_deg, 21);
    const auto fine = table_halts(table_of(1), 0, 0, 0, -21, -21);
    ASSERT_EQ(fine.size(), 3U);
    EXPECT_EQ(fine[0].coordinate_deg, -9);
    EXPECT_EQ(fine[1].position, -18);
    EXPECT_EQ(fine[2].coordinate_deg, -21);
}

/// rs274 is LinuxCNC's own interpreter; its fourth coordinate is A.
TEST(RotaryProgram, Rs274OfLinuxcncAcceptsItAndTurnsAAsPlanned) {
    if (std::system("command -v rs274 >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "rs274 (linuxcnc-uspace) is not installed";
    const testing::ScratchFolder scratch;
    const std::filesystem::path folder = scratch.path();
    const ProgramOrder order = order_of(5);
    std::ofstream{folder / "cycle.ngc"} << *write_linuxcnc(order);
    // rs274 maps its tool table at $HOME/.tool.mmap, and another one cuts that file short.
    ASSERT_EQ(std::system(("cd " + folder.string() +
                           " && HOME=. rs274 -g cycle.ngc >canon.txt 2>messages.txt")
                              .c_str()),
              0);
    std::ifstream file{folder / "canon.txt"};
    std::size_t next = 0;
    double a_deg = 0, halted_s = 0;
    for (std::string line; std::getline(file, line);) {
        double x = 0, y = 0, z = 0, a = 0, seconds = 0;
        const auto feed = line.find("STRAIGHT_FEED("), dwell = line.find("DWELL(");
        if (feed != std::string::npos &&
            std::sscanf(line.c_str() + feed, "STRAIGHT_FEED(%lf, %lf, %lf, %lf", &x, &y, &z, &a) ==
                4)
            a_deg = a, halted_s = 0;
        if (dwell != std::string::npos &&
            std::sscanf(line.c_str() + dwell, "DWELL(%lf", &seconds) == 1)
            halted_s += seconds;
        if (halted_s < 4 || next >= order.plan.points.size()) continue; // no point's dwell
        const PlannedPoint& point = order.plan.points[next++];
        halted_s = 0;
        EXPECT_NEAR(a_deg, order.plan.targets[static_cast<std::size_t>(point.target_index)].in(mm),
                    5e-5);
    }
    EXPECT_EQ(next, order.plan.points.size());
}

} // namespace
} // namespace axiscal::rotary_program_test
