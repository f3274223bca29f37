#include "acquisition/program/part_program.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <utility>

namespace axiscal::part_program_test {
namespace {

/// A plan written down by hand, not by the planner: m targets, n approaches, both ways.
RunPlan
plan_of(std::vector<double> targets_mm, int approaches, CycleKind cycle = CycleKind::standard) {
    RunPlan plan;
    plan.cycle = cycle;
    plan.approaches = approaches;
    plan.seed = 42;
    plan.overrun = mm(2);
    plan.datum = mm(targets_mm.front() - 4);
    for (const double target : targets_mm)
        plan.targets.push_back(mm(target));
    const int m = static_cast<int>(targets_mm.size());
    int step = 0;
    const auto add = [&](int target, Direction side, int approach) {
        plan.points.push_back({step++, target, side, approach});
    };
    if (cycle == CycleKind::standard)
        for (int j = 0; j < approaches; ++j) {
            for (int i = 0; i < m; ++i)
                add(i, Direction::positive, j);
            for (int i = m; i-- > 0;)
                add(i, Direction::negative, j);
        }
    else
        for (int i = 0; i < m; ++i)
            for (const Direction side : {Direction::positive, Direction::negative})
                for (int j = 0; j < approaches; ++j)
                    add(i, side, j);
    return plan;
}

ProgramOrder order_of(RunPlan plan, TriggerShape shape) {
    ProgramOrder order;
    order.plan = std::move(plan);
    order.feed = mm_per_minute(3000);
    order.dwell = std::chrono::milliseconds{4000};
    order.shape = shape;
    order.least_halt = std::chrono::milliseconds{1500};
    return order;
}

/// The lines that a control executes when every wait is answered (`withheld` 0), or when the wait
/// of that ordinal, from 1, is not: the bodies of the other `if [#5399 EQ -1]` are skipped.
std::string executed(const std::string& program, int withheld = 0) {
    std::string lines, skipped_until;
    std::istringstream all{program};
    int waits = 0;
    for (std::string line; std::getline(all, line);) {
        const std::string label = line.substr(0, line.find(' '));
        if (!skipped_until.empty()) {
            if (line == skipped_until) skipped_until.clear();
            continue;
        }
        if (line.starts_with("M66")) ++waits;
        if (line.ends_with("if [#5399 EQ -1]") && waits != withheld)
            skipped_until = label + " endif";
        else
            lines += line + "\n";
    }
    return lines;
}

/// What a control would do: stops of the axis in mm, those with a dwell marked. Knows G-code, not
/// the writer.
struct Stop {
    double x_mm = 0;
    double dwell_s = 0;
};
std::vector<Stop> read_stops(const std::string& program, double dwell_unit_s) {
    std::vector<Stop> stops;
    std::istringstream lines{executed(program)};
    for (std::string line; std::getline(lines, line);) {
        double value = 0;
        if (std::sscanf(line.c_str(), "G1 X%lf", &value) == 1) stops.push_back({value, 0});
        if (std::sscanf(line.c_str(), "G4 P%lf", &value) == 1 && !stops.empty())
            stops.back().dwell_s += value * dwell_unit_s;
    }
    return stops;
}

/// Every planned point in order, each reached from its side by at least the overrun.
void expect_follows_plan(const std::vector<Stop>& stops, const RunPlan& plan) {
    std::size_t next = 0;
    for (std::size_t i = 1; i < stops.size() && next < plan.points.size(); ++i) {
        if (stops[i].dwell_s < 3) continue;
        const PlannedPoint& point = plan.points[next++];
        const double target_mm = plan.targets[static_cast<std::size_t>(point.target_index)].in(mm);
        EXPECT_NEAR(stops[i].x_mm, target_mm, 0.00005) << "step " << next;
        const double travel =
            (stops[i].x_mm - stops[i - 1].x_mm) * static_cast<double>(point.direction);
        EXPECT_GE(travel, plan.overrun.in(mm)-0.0001) << "step " << next;
    }
    EXPECT_EQ(next, plan.points.size());
}

TEST(PartProgram, MarlinVisitsEveryPointFromItsSide) {
    for (const CycleKind cycle : {CycleKind::standard, CycleKind::step}) {
        const RunPlan plan = plan_of({10.123, 60.5, 111.25, 160, 210.999}, 5, cycle);
        const auto text = write_marlin(order_of(plan, TriggerShape::dwell));
        ASSERT_TRUE(text) << describe(text.error());
        expect_follows_plan(read_stops(*text, 1e-3), plan);
    }
}

TEST(PartProgram, MarlinDwellsInMilliseconds) {
    const auto text =
        write_marlin(order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::dwell));
    ASSERT_TRUE(text);
    EXPECT_NE(text->find("G4 P4000\n"), std::string::npos);
}

TEST(PartProgram, WithoutAWireTheHeaderSaysToArmBefore) {
    for (auto* writer : {write_marlin, write_linuxcnc}) {
        auto order = order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::dwell);
        const std::string text = writer(order).value();
        EXPECT_NE(text.find("run 'axiscal arm' before it"), std::string::npos) << text;
        EXPECT_EQ(text.find("waits there"), std::string::npos) << text;
        order.retakes = true; // of a run that is armed
        EXPECT_EQ(writer(order).value().find("axiscal arm"), std::string::npos);
    }
    const auto waiting = write_linuxcnc(
        order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::single_register));
    EXPECT_NE(waiting.value().find("waits there: run 'axiscal arm' then"), std::string::npos);
}

TEST(PartProgram, MarlinRefusesToWaitOnInputs) {
    const auto text =
        write_marlin(order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::single_register));
    ASSERT_FALSE(text);
    EXPECT_NE(text.error().detail.find("dwell"), std::string::npos);
}

TEST(PartProgram, WaitsLongerThanTheStationOrIsRefused) {
    auto order = order_of(plan_of({10, 20}, 1), TriggerShape::single_register);
    order.capture_timeout = std::chrono::seconds{20};
    const auto refused = write_linuxcnc(order);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().detail.find("lengthen trigger.cnc_timeout"), std::string::npos);
    order.answer_limit = std::chrono::seconds{23};
    const auto written = write_linuxcnc(order);
    ASSERT_TRUE(written);
    EXPECT_NE(written->find("M66 P0 L3 Q23.0"), std::string::npos);
}

TEST(PartProgram, ADwellShorterThanTheHaltIsRefused) {
    for (auto* writer : {write_marlin, write_linuxcnc}) {
        ProgramOrder order = order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::dwell);
        order.dwell = std::chrono::milliseconds{1400};
        EXPECT_FALSE(writer(order));
    }
}

TEST(PartProgram, LinuxCncDwellsInSeconds) {
    const auto text =
        write_linuxcnc(order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::dwell));
    ASSERT_TRUE(text);
    EXPECT_NE(text->find("G4 P4.000\n"), std::string::npos);
}

TEST(PartProgram, LinuxCncVisitsEveryPointFromItsSideInEachShape) {
    for (const TriggerShape shape : {TriggerShape::sequence_block, TriggerShape::single_register,
                                     TriggerShape::coil_and_index, TriggerShape::dwell}) {
        const RunPlan plan = plan_of({10.123, 60.5, 111.25, 160, 210.999}, 5);
        const auto text = write_linuxcnc(order_of(plan, shape));
        ASSERT_TRUE(text);
        expect_follows_plan(read_stops(*text, 1.0), plan);
    }
}

TEST(PartProgram, SequencesCountFromOneAfterAZero) {
    const auto text = write_linuxcnc(
        order_of(plan_of({10, 60, 110, 160, 210}, 2), TriggerShape::single_register));
    ASSERT_TRUE(text);
    std::vector<int> written;
    std::istringstream lines{executed(*text)};
    for (std::string line; std::getline(lines, line);)
        if (int value = 0; std::sscanf(line.c_str(), "M68 E0 Q%d", &value) == 1)
            written.push_back(value);
    ASSERT_EQ(written.size(), 21U);
    for (int i = 0; i < 21; ++i)
        EXPECT_EQ(written[static_cast<std::size_t>(i)], i);
}

ProgramOrder order_with_prepare(TriggerShape shape) {
    ProgramOrder order = order_of(plan_of({10, 60, 110, 160, 210}, 1), shape);
    order.datum_by_cnc = true;
    return order;
}

TEST(PartProgram, RequestOneIsPrepareAtTheDatumAndThePointsCountFromTwo) {
    const auto text = write_linuxcnc(order_with_prepare(TriggerShape::sequence_block));
    ASSERT_TRUE(text) << describe(text.error());
    std::vector<std::pair<int, int>> asked; // sequence and command
    std::istringstream lines{executed(*text)};
    int command = 0, value = 0;
    for (std::string line; std::getline(lines, line);) {
        if (std::sscanf(line.c_str(), "M68 E7 Q%d", &value) == 1) command = value;
        if (std::sscanf(line.c_str(), "M68 E0 Q%d", &value) == 1 && value != 0)
            asked.emplace_back(value, command);
    }
    ASSERT_EQ(asked.size(), 11U);
    EXPECT_EQ(asked[0], (std::pair{1, 1}));
    for (int i = 1; i < 11; ++i)
        EXPECT_EQ(asked[static_cast<std::size_t>(i)], (std::pair{i + 1, 2}));
}

TEST(PartProgram, ThePrepareIsAskedForAtTheDatumOnceTheStationIsArmed) {
    // plan_of puts the datum 4 mm before the first target
    const auto text = write_linuxcnc(order_with_prepare(TriggerShape::sequence_block));
    ASSERT_TRUE(text);
    const std::string lines = executed(*text);
    const auto datum = lines.find("G1 X6.0000\n"), armed = lines.find("M66 P0 L3 Q600.0\n", datum),
               claim = lines.find("M68 E3 Q6.0000\n", armed),
               ask = lines.find("M68 E7 Q1\nG4 P4.000\nM68 E0 Q1\n", claim),
               answer = lines.find("M66 P0 L3 Q15.0\n", ask),
               way = lines.find("G1 X10.0000\n", answer);
    EXPECT_NE(way, std::string::npos) << lines;
}

TEST(PartProgram, APrepareThatIsWithheldIsAskedForOnceMore) {
    const auto text = write_linuxcnc(order_with_prepare(TriggerShape::sequence_block));
    ASSERT_TRUE(text);
    const std::string lines = executed(*text, 2); // wait 1 is for arming
    EXPECT_NE(lines.find("M68 E0 Q0\nG4 P4.000\nM68 E0 Q1\nG4 P0.050\nM66 P0 L3 Q15.0\n"),
              std::string::npos)
        << lines;
    EXPECT_EQ(lines.find("ABORT"), std::string::npos);
}

TEST(PartProgram, OnlyTheSequenceBlockCanSendPrepare) {
    for (const TriggerShape shape :
         {TriggerShape::single_register, TriggerShape::coil_and_index, TriggerShape::dwell})
        for (auto* writer : {write_marlin, write_linuxcnc}) {
            const auto text = writer(order_with_prepare(shape));
            ASSERT_FALSE(text);
            EXPECT_NE(text.error().detail.find("sequence-block"), std::string::npos);
        }
}

TEST(PartProgram, AWithheldAnswerBringsTheAxisBackFromItsSideAndAsksAgain) {
    // wait 1 is for arming, wait 7 for the sixth point: P5 from above, over-travel 2 mm
    const auto text = write_linuxcnc(
        order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::single_register));
    ASSERT_TRUE(text);
    const std::string lines = executed(*text, 7);
    EXPECT_NE(lines.find("M68 E0 Q6\nG4 P0.050\nM66 P0 L3 Q15.0\no"), std::string::npos);
    EXPECT_NE(lines.find("M68 E0 Q0\nG1 X212.0000\nG1 X210.0000\nG4 P4.000\nM68 E0 Q6\nG4 P0.050\n"
                         "M66 P0 L3 Q15.0\n"),
              std::string::npos);
    EXPECT_EQ(lines.find("ABORT"), std::string::npos);
}

TEST(PartProgram, AWithheldCoilIsDroppedAndRaisedAgain) {
    // two waits a point: the third is that of the second point's acknowledge
    const auto text =
        write_linuxcnc(order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::coil_and_index));
    ASSERT_TRUE(text);
    const std::string lines = executed(*text, 4);
    EXPECT_NE(lines.find("M65 P0\nG1 X58.0000\nG1 X60.0000\nG4 P4.000\nM64 P0\nM66 P0 L3 Q15.0\n"),
              std::string::npos);
}

TEST(PartProgram, TheIndexIsWrittenBeforeTheMoveAndTheCoilAfterTheDwell) {
    const auto text =
        write_linuxcnc(order_of(plan_of({10, 60, 110, 160, 210}, 1), TriggerShape::coil_and_index));
    ASSERT_TRUE(text);
    const auto index = text->find("M68 E0 Q1\n"), move = text->find("G1 X10.0000\n", index),
               dwell = text->find("G4 P4.000\n", move), coil = text->find("M64 P0\n", dwell);
    EXPECT_LT(index, move);
    EXPECT_LT(move, dwell);
    EXPECT_LT(dwell, coil);
    EXPECT_NE(coil, std::string::npos);
}

TEST(PartProgram, OtherTargetsGiveAnotherCheck) {
    const RunPlan plan = plan_of({10, 60, 110, 160, 210}, 1),
                  other = plan_of({10, 60, 110.0001, 160, 210}, 1);
    EXPECT_NE(program_id(plan), program_id(other));
}

TEST(PartProgram, CoordinatesAlwaysHaveADecimalPoint) {
    EXPECT_EQ(coordinate_word("X", 100), "X100.0000");
    EXPECT_EQ(coordinate_word("A", -0.0), "A0.0000");
    EXPECT_EQ(coordinate_word("Y", -0.12345), "Y-0.1235");
}

TEST(PartProgram, AnUnknownDialectIsRefusedWithTheList) {
    const auto found = find_dialect("fanuk");
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().detail.find("linuxcnc, marlin"), std::string::npos);
}

/// rs274 is LinuxCNC's own interpreter: its canonical moves and dwells must equal the plan.
TEST(PartProgram, Rs274OfLinuxcncAcceptsItAndMovesAsPlanned) {
    if (std::system("command -v rs274 >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "rs274 (linuxcnc-uspace) is not installed";
    const testing::ScratchFolder scratch;
    const std::filesystem::path folder = scratch.path();
    for (const TriggerShape shape : {TriggerShape::sequence_block, TriggerShape::single_register,
                                     TriggerShape::coil_and_index, TriggerShape::dwell}) {
        const RunPlan plan = plan_of({10.123, 60.5, 111.25, 160, 210.999}, 5);
        std::ofstream{folder / "cycle.ngc"} << *write_linuxcnc(order_of(plan, shape));
        const std::string canon = folder / "canon.txt";
        // rs274 maps its tool table at $HOME/.tool.mmap, and another one cuts that file short.
        ASSERT_EQ(std::system(("cd " + folder.string() +
                               " && HOME=. rs274 -g cycle.ngc >canon.txt 2>messages.txt")
                                  .c_str()),
                  0);
        std::ifstream file{canon};
        std::vector<Stop> stops;
        for (std::string line; std::getline(file, line);) {
            double value = 0;
            if (const auto at = line.find("STRAIGHT_FEED(");
                at != std::string::npos &&
                std::sscanf(line.c_str() + at, "STRAIGHT_FEED(%lf", &value) == 1)
                stops.push_back({value, 0});
            if (const auto at = line.find("DWELL(");
                at != std::string::npos &&
                std::sscanf(line.c_str() + at, "DWELL(%lf", &value) == 1 && !stops.empty())
                stops.back().dwell_s += value;
        }
        expect_follows_plan(stops, plan);
    }
}

} // namespace
} // namespace axiscal::part_program_test
