// The program that axiscal writes is the program that the simulated CNC runs. The writer is asked
// through its door only; the plan is written down by hand.
#include "acquisition/program/part_program.hpp"
#include "cnc/linuxcnc_program.hpp"
#include "cnc/marlin_program.hpp"
#include "recording_machine.hpp"
#include "truth.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::generated_program_test {
namespace {

const std::vector<double> targets_mm{12.3456, 110.5, 207.1, 313.0};

ProgramOrder order_of(TriggerShape shape, CycleKind cycle) {
    ProgramOrder order;
    RunPlan& plan = order.plan;
    plan.cycle = cycle;
    plan.approaches = 3;
    plan.overrun = mm(2);
    plan.datum = mm(8);
    for (const double target : targets_mm)
        plan.targets.push_back(mm(target));
    int step = 0;
    const auto add = [&](int target, Direction side, int approach) {
        plan.points.push_back({step++, target, side, approach});
    };
    for (int j = 0; j < 3 && cycle == CycleKind::standard; ++j) {
        for (int i = 0; i < 4; ++i)
            add(i, Direction::positive, j);
        for (int i = 4; i-- > 0;)
            add(i, Direction::negative, j);
    }
    for (int i = 0; i < 4 && cycle == CycleKind::step; ++i)
        for (const Direction side : {Direction::positive, Direction::negative})
            for (int j = 0; j < 3; ++j)
                add(i, side, j);
    order.feed = mm_per_minute(3000);
    order.dwell = std::chrono::seconds{2};
    order.shape = shape;
    order.least_halt = std::chrono::seconds{1};
    return order;
}

TEST(GeneratedProgram, EveryShapeAndCycleShowsTheSamePoints) {
    for (const TriggerShape shape : {TriggerShape::sequence_block, TriggerShape::single_register,
                                     TriggerShape::coil_and_index, TriggerShape::dwell})
        for (const CycleKind cycle : {CycleKind::standard, CycleKind::step}) {
            const auto text = write_linuxcnc(order_of(shape, cycle));
            ASSERT_TRUE(text);
            const auto plan = plan_of_program(*text, false, Scenario{});
            ASSERT_TRUE(plan) << plan.error().detail;
            EXPECT_EQ(plan->targets_mm, targets_mm);
            EXPECT_EQ(plan->approaches, 3);
            EXPECT_TRUE(plan->bidirectional);
        }
}

TEST(GeneratedProgram, ThePrepareIsNoPoint) {
    ProgramOrder order = order_of(TriggerShape::sequence_block, CycleKind::standard);
    order.datum_by_cnc = true;
    const auto text = write_linuxcnc(order);
    ASSERT_TRUE(text);
    const auto plan = plan_of_program(*text, false, Scenario{});
    ASSERT_TRUE(plan) << plan.error().detail;
    EXPECT_EQ(plan->targets_mm, targets_mm);
    EXPECT_EQ(plan->approaches, 3);
}

TEST(GeneratedProgram, MarlinShowsTheSamePoints) {
    const auto text = write_marlin(order_of(TriggerShape::dwell, CycleKind::standard));
    ASSERT_TRUE(text);
    const auto plan = plan_of_program(*text, true, Scenario{});
    ASSERT_TRUE(plan) << plan.error().detail;
    EXPECT_EQ(plan->targets_mm, targets_mm);
    EXPECT_EQ(plan->approaches, 3);
}

TEST(GeneratedProgram, StopsWhereNobodyAnswers) {
    const auto text = write_linuxcnc(order_of(TriggerShape::single_register, CycleKind::standard));
    ASSERT_TRUE(text);
    const auto program = LinuxcncProgram::parse(*text, 'X');
    ASSERT_TRUE(program);
    RecordingMachine machine;
    machine.answers = false;
    const auto ran = program->run(machine);
    ASSERT_FALSE(ran);
    EXPECT_NE(ran.error().detail.find("the program aborts: axiscal:"), std::string::npos);
}

} // namespace
} // namespace axiscal::simulate::generated_program_test
