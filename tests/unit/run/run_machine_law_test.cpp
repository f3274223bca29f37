// Thousands of random orders of events; what must hold whatever happens is checked by a book kept
// apart from the machine.
#include "bench.hpp"

#include "acquisition/run/resume.hpp"
#include "acquisition/run/sequence.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace axiscal::run_machine_law_test {
namespace {

using testing::at_s;
using testing::Bench;
using testing::small_setup;

/// The disk and the CNC's view of `done`, kept apart from the machine.
struct Book {
    std::vector<std::uint16_t> committed, acknowledged; ///< sequences, in order
    std::map<int, int> points;                          ///< commits of each step
    std::uint16_t durable = 0, done = 0;
    bool closed = false, complete = false;
};

/// A machine under random fire.
class Chaos {
public:
    explicit Chaos(std::uint64_t seed)
        : random{seed} {}

    void check(const RunActions& actions, bool answering_commit) {
        for (const auto& action : actions) {
            EXPECT_FALSE(book.closed && changes_the_run(action)) << "after Close";
            if (const auto* done = std::get_if<Acknowledge>(&action)) {
                EXPECT_TRUE(answering_commit);
                EXPECT_EQ(done->sequence, book.durable);
                EXPECT_NE(done->sequence, book.done) << "acknowledged twice";
                book.acknowledged.push_back(book.done = done->sequence);
            }
            if (const auto* again = std::get_if<RepublishDone>(&action)) {
                EXPECT_EQ(again->sequence, book.durable);
                book.done = again->sequence;
            }
            if (const auto* close = std::get_if<Close>(&action))
                book.closed = true, book.complete = close->complete;
        }
    }
    static bool changes_the_run(const RunAction& action) {
        return std::holds_alternative<Acknowledge>(action) ||
               std::holds_alternative<CommitPoint>(action) ||
               std::holds_alternative<CommitDatum>(action) ||
               std::holds_alternative<CommitEvent>(action) ||
               std::holds_alternative<OpenWindow>(action) || std::holds_alternative<Close>(action);
    }

    void give(const RunInput& input) { check(bench.give(input).last, false); }

    /// The disk answers the outstanding commit, if there is one.
    void disk_answers() {
        if (!outstanding()) return;
        const auto sequence = bench.commit_sequence;
        const int step = bench.commit_step;
        commit_seen = commits_asked;
        if (sequence != 0) {
            book.durable = sequence;
            book.committed.push_back(sequence);
            if (step >= 0) ++book.points[step];
        }
        check(bench.give(Committed{sequence, step, bench.tick()}).last, true);
        count_commits();
    }
    [[nodiscard]] bool outstanding() const { return commits_asked > commit_seen; }
    void count_commits() {
        for (const auto& action : bench.last)
            if (std::holds_alternative<CommitPoint>(action) ||
                std::holds_alternative<CommitDatum>(action) ||
                std::holds_alternative<CommitEvent>(action))
                ++commits_asked;
    }
    void apply(const RunInput& input) {
        give(input);
        count_commits();
    }

    [[nodiscard]] std::uint64_t roll(std::uint64_t sides) { return random() % sides; }

    std::mt19937_64 random;
    Bench bench;
    Book book;
    int commits_asked = 0, commit_seen = 0;
};

TriggerEvent any_request(Chaos& chaos) {
    auto event = Bench::request(0);
    event.at = chaos.bench.tick();
    const auto durable = chaos.book.durable;
    switch (chaos.roll(8)) {
    case 0: event.sequence = durable; break;
    case 1: event.sequence = static_cast<std::uint16_t>(chaos.roll(65536)); break;
    case 2: event.sequence = next_sequence(next_sequence(durable)); break;
    case 3: event.sequence = static_cast<std::uint16_t>(chaos.roll(4)); break;
    default: event.sequence = next_sequence(durable); break;
    }
    event.standing = chaos.roll(6) == 0;
    if (chaos.roll(12) == 0) event.origin = TriggerOrigin::manual;
    if (chaos.roll(25) == 0) event.command = TriggerCommand::skip;
    if (chaos.roll(300) == 0) event.command = TriggerCommand::end;
    if (chaos.roll(300) == 0) event.command = TriggerCommand::abort;
    return event;
}

void random_step(Chaos& chaos) {
    auto& bench = chaos.bench;
    const auto window = bench.open_window.window;
    switch (chaos.roll(14)) {
    case 0:
    case 1:
    case 2:
    case 3: return chaos.apply(any_request(chaos));
    case 4:
    case 5:
    case 6:
        return chaos.apply(
            WindowResult{window, bench.capture_at(bench.open_window.expected), bench.tick()});
    case 7:
        return chaos.apply(WindowResult{window, fail(Fault::not_still, "Chaos."), bench.tick()});
    case 8:
        return chaos.apply(WindowResult{window - std::min<std::uint64_t>(window, 1),
                                        bench.capture_at(20.0_mm), bench.tick()});
    case 9:
    case 10:
    case 11: return chaos.disk_answers();
    case 12: return chaos.apply(Tick{bench.tick()});
    default: break;
    }
    switch (chaos.roll(60)) {
    case 0: return chaos.apply(LaserFault{Fault::datum_lost, "Chaos.", bench.tick()});
    case 1: return chaos.apply(Abort{"Chaos.", bench.tick()});
    case 2:
        chaos.commit_seen = chaos.commits_asked; // the disk answers each commit once
        return chaos.apply(CommitFailed{"Chaos.", bench.tick()});
    default: // a receipt that answers nothing
        if (!chaos.outstanding())
            return chaos.give(Committed{next_sequence(chaos.book.durable), 0, bench.tick()});
    }
}

TEST(RunMachineLaw, WhateverComesDoneNeverExceedsTheDiskAndNoPointIsDoubled) {
    int completed = 0, points = 0;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        Chaos chaos{seed};
        chaos.apply(Arm{chaos.bench.tick(), chaos.roll(4) != 0});
        for (int i = 0; i < 400 && !chaos.book.closed; ++i)
            random_step(chaos);
        for (int i = 0; i < 10; ++i)
            random_step(chaos); // and a little after the end
        EXPECT_EQ(chaos.book.acknowledged, chaos.book.committed) << "seed " << seed;
        for (const auto& [step, commits] : chaos.book.points)
            EXPECT_EQ(commits, 1) << "seed " << seed << " step " << step;
        if (chaos.book.complete) {
            EXPECT_EQ(chaos.book.points.size(), chaos.bench.setup.plan.points.size());
            ++completed;
        }
        points += static_cast<int>(chaos.book.points.size());
        if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(completed, 50) << "the fire must leave some runs alive";
    EXPECT_GT(points, 5000);
}

/// A run file on paper, as the disk holds it after each commit.
RunRecord new_record(const RunSetup& setup) {
    RunRecord record;
    record.plan = setup.plan;
    record.laser = testing::small_laser();
    return record;
}

void keep(RunRecord& record, const RunActions& asked) {
    for (const auto& action : asked) {
        if (const auto* datum = std::get_if<CommitDatum>(&action))
            record.datums.push_back(datum->datum);
        if (const auto* point = std::get_if<CommitPoint>(&action))
            record.points.push_back(point->point);
        if (const auto* event = std::get_if<CommitEvent>(&action))
            record.events.push_back(event->event);
    }
}

TEST(RunMachineLaw, AnHonestCncGetsEveryPointOnceThroughAnyNumberOfRestarts) {
    int restarts = 0;
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        std::mt19937_64 random{seed};
        const auto rolls = [&](unsigned sides) { return random() % sides == 0; };
        Bench bench;
        auto disk = new_record(bench.setup);
        bench.give(Arm{bench.tick(), true}).window_here();
        keep(disk, bench.last);
        bench.commit();
        std::uint16_t request = 1, done = 0;
        bool closed = false;
        for (int turn = 0; turn < 2000 && !closed; ++turn) {
            const auto die = [&] { // everything in memory is gone, the CNC's request still stands
                bench.machine = RunMachine{bench.setup, disk, bench.epoch, bench.tick()};
                bench.give(EnvironmentNow{testing::air_index_minus_1});
                ++restarts;
            };
            const auto look = [&] {
                if (bench.saw<Acknowledge>()) done = bench.the<Acknowledge>().sequence;
                if (bench.saw<RepublishDone>()) done = bench.the<RepublishDone>().sequence;
                if (bench.saw<Close>()) closed = true;
            };
            bench.trigger(request);
            look();
            if (bench.saw<OpenWindow>()) {
                if (rolls(9))
                    die();
                else if (rolls(5))
                    bench.window(fail(Fault::not_still, "Chaos."));
                else {
                    bench.window_here();
                    if (rolls(9))
                        die(); // before the commit
                    else {
                        keep(disk, bench.last);
                        if (rolls(9))
                            die(); // after the commit, before its acknowledge
                        else
                            bench.commit();
                    }
                }
                look();
            }
            bench.give(Tick{bench.tick()});
            look();
            if (done == request) request = next_sequence(request);
        }
        ASSERT_TRUE(closed) << "seed " << seed;
        EXPECT_TRUE(check_complete(disk)) << "seed " << seed;
        EXPECT_EQ(disk.points.size(), 10u);
    }
    EXPECT_GT(restarts, 500);
}

TEST(RunMachineLaw, TheCounterWrapsInTheMiddleOfARun) {
    Bench bench;
    RunRecord disk = new_record(bench.setup);
    bench.give(Arm{bench.tick(), true}).window_here();
    keep(disk, bench.last);
    bench.commit().trigger(1).window_here();
    auto point = bench.the<CommitPoint>().point;
    point.sequence = 65533; // as if 65532 requests had come before
    disk.points.push_back(point);
    bench.machine = RunMachine{bench.setup, disk, bench.epoch, bench.tick()};
    bench.give(EnvironmentNow{testing::air_index_minus_1});
    bench.acknowledged.clear();
    bench.point(65534).trigger(65535);
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::out_of_order) << "no number of a request";
    bench.point(1).point(2);
    EXPECT_EQ(bench.acknowledged, (std::vector<std::uint16_t>{65534, 1, 2}));
}

} // namespace
} // namespace axiscal::run_machine_law_test
