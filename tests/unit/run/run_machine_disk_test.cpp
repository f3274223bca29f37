#include "bench.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <utility>

namespace axiscal::run_machine_disk_test {
namespace {

using testing::Bench;
using testing::expect_refused;

TEST(Disk, AFailedCommitIsFinal) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    bench.give(CommitFailed{"No space left.", bench.tick()});
    expect_refused(bench, Fault::not_durable, "No space left");
    EXPECT_EQ(bench.machine.view().state, PortState::error);
    EXPECT_FALSE(bench.saw<Close>()) << "the run stays open for the next start";
    expect_refused(bench.trigger(2), Fault::not_durable);
    expect_refused(bench.trigger(3), Fault::not_durable);
    EXPECT_TRUE(bench.trigger(1).saw<RepublishDone>()) << "what is durable stays so";
    EXPECT_TRUE(bench.commit().last.empty()) << "a late success is not believed";
    EXPECT_EQ(bench.machine.view().last_durable, 1);
}

std::shared_ptr<const RunRecord> disk_with_points(int count) {
    RunRecord run;
    for (int step = 0; step < count; ++step)
        run.points.emplace_back().step = step;
    return std::make_shared<const RunRecord>(std::move(run));
}

TEST(Disk, ARecordThatItRefusedIsWrittenWhenItIsBack) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    bench.give(CommitFailed{"No space left.", bench.tick()});
    bench.give(DiskBack{disk_with_points(1), bench.tick()});
    ASSERT_TRUE(bench.saw<CommitPoint>());
    EXPECT_EQ(bench.the<CommitPoint>().point.sequence, 2);
    EXPECT_FALSE(bench.saw<Acknowledge>());
    EXPECT_TRUE(bench.commit().saw<Acknowledge>());
    EXPECT_EQ(bench.machine.view().last_durable, 2);
    EXPECT_TRUE(bench.point(3).saw<Acknowledge>());
}

TEST(Disk, WhatIsKnownOfTheTimeOfACaptureGoesWithItAlsoTheSecondTime) {
    constexpr Synchronisation known{std::chrono::microseconds{48}, 12e-6};
    Bench bench;
    bench.arm().point(1).trigger(2);
    EXPECT_FALSE(bench.machine.view().last_synchronisation) << "of point 1: not stated";
    auto capture = bench.capture_at(bench.open_window.expected);
    capture.synchronisation = known;
    bench.window(std::move(capture));
    ASSERT_TRUE(bench.the<CommitPoint>().synchronisation);
    EXPECT_EQ(bench.the<CommitPoint>().synchronisation->error_um, known.error_um);
    EXPECT_EQ(bench.machine.view().last_synchronisation->error_um, known.error_um);
    bench.give(CommitFailed{"No space left.", bench.tick()});
    bench.give(DiskBack{disk_with_points(1), bench.tick()});
    ASSERT_TRUE(bench.the<CommitPoint>().synchronisation);
    EXPECT_EQ(bench.the<CommitPoint>().synchronisation->error_um, known.error_um);
}

TEST(Disk, ARecordThatIsThereAfterAllIsAcknowledgedAndNotWrittenTwice) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    bench.give(DiskBack{disk_with_points(2), bench.tick()});
    EXPECT_FALSE(bench.saw<CommitPoint>());
    EXPECT_TRUE(bench.saw<Acknowledge>());
    EXPECT_EQ(bench.machine.view().last_durable, 2);
}

TEST(Disk, ThatIsBackUncalledForChangesNothing) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    EXPECT_TRUE(bench.give(DiskBack{disk_with_points(2), bench.tick()}).last.empty());
    EXPECT_EQ(bench.machine.view().last_durable, 1);
}

TEST(Disk, ACommitThatNobodyAskedForIsNeverAcknowledged) {
    Bench bench;
    bench.arm();
    EXPECT_TRUE(bench.give(Committed{1, 0, bench.tick()}).last.empty());
    bench.trigger(1);
    EXPECT_TRUE(bench.give(Committed{1, 0, bench.tick()}).last.empty());
    bench.window_here();
    EXPECT_TRUE(bench.give(Committed{1, 1, bench.tick()}).last.empty());
    EXPECT_TRUE(bench.give(Committed{2, 0, bench.tick()}).last.empty());
    EXPECT_TRUE(bench.commit().saw<Acknowledge>());
    EXPECT_TRUE(bench.commit().last.empty()) << "once";
}

} // namespace
} // namespace axiscal::run_machine_disk_test
