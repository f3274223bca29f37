#include "acquisition/live/outbox_watch.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::outbox_watch_test {
namespace {

using testing::ScratchFolder;
using testing::write_bytes;

constexpr std::int64_t second_ns = 1'000'000'000;

struct Shelf {
    ScratchFolder scratch;
    PublishConfig config;
    std::int64_t now_ns = std::int64_t{::time(nullptr)} * second_ns; ///< the wall clock
    MonotonicTime mono = monotonic_from_ns(7'000 * second_ns);
    OutboxWatch watch;
    int changes = 0;
    explicit Shelf(int alarm_count = 10)
        : config{make_config(alarm_count)}
        , watch{scratch.path(), config} {
        std::filesystem::create_directory(scratch.file("outbox"));
    }
    static PublishConfig make_config(int alarm_count) {
        PublishConfig config;
        config.destination = "smb://fs1/quality";
        config.alarm_count = alarm_count;
        return config;
    }
    /// As finished so many seconds ago.
    void put(const std::string& run_id, std::int64_t age_s) {
        const auto folder = scratch.file("outbox/" + run_id);
        std::filesystem::create_directory(folder);
        const timespec then{static_cast<time_t>(now_ns / second_ns - age_s), 0};
        const timespec both[2] = {then, then};
        ASSERT_EQ(::utimensat(AT_FDCWD, folder.c_str(), both, 0), 0);
        stamp();
    }
    void take(const std::string& run_id) {
        std::filesystem::remove(scratch.file("outbox/" + run_id));
        stamp();
    }
    /// Two changes within a tick of the real clock bear one stamp; in this test seconds lie
    /// between.
    void stamp() {
        const timespec then{1'700'000'000 + ++changes, 0};
        const timespec both[2] = {then, then};
        ASSERT_EQ(::utimensat(AT_FDCWD, scratch.file("outbox").c_str(), both, 0), 0);
    }
    void say(const std::string& state, const std::string& reason) const {
        write_bytes(
            scratch.file("publisher.json"),
            R"({"format":"axiscal.publisher/1","destination":"smb://fs1/quality","state":")" +
                state + R"(","reason":")" + reason + R"(","since_utc":"2026-11-21T10:00:00Z"})");
    }
    [[nodiscard]] OutboxView look() { return watch.look({mono, now_ns, mono}); }
    /// Time goes by on both clocks.
    void pass(std::int64_t seconds) {
        now_ns += seconds * second_ns;
        mono += Duration{seconds * second_ns};
    }
    /// Somebody sets the wall clock.
    void step(std::int64_t seconds) { now_ns += seconds * second_ns; }
    void start_anew() { watch = OutboxWatch{scratch.path(), config}; }
};

TEST(OutboxWatch, CountsWhatWaitsAndHowLong) {
    Shelf shelf;
    EXPECT_EQ(shelf.look().waiting, 0);
    EXPECT_FALSE(shelf.look().oldest_s);
    shelf.pass(600);
    shelf.put("run-1", 40);
    shelf.put("run-2", 300);
    shelf.put(".run-3.staging", 400);
    EXPECT_EQ(shelf.look().waiting, 2);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 300);
    shelf.pass(10);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 310);
    shelf.take("run-2");
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 50);
}

TEST(OutboxWatch, GivesNoFalseAlarmWhenTheClockIsSetForward) {
    Shelf shelf;
    EXPECT_EQ(shelf.look().waiting, 0);
    shelf.pass(10);
    shelf.put("run-1", 5);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 5);
    shelf.step(365 * 86'400);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 5);
    EXPECT_EQ(shelf.look().alarm, "");
    shelf.pass(896); // limit: 15 min
    EXPECT_NE(shelf.look().alarm, "");
}

TEST(OutboxWatch, GivesADueAlarmWhenTheClockIsSetBack) {
    Shelf shelf;
    EXPECT_EQ(shelf.look().waiting, 0);
    shelf.put("run-1", 0);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 0);
    shelf.step(-365 * 86'400);
    shelf.pass(899);
    EXPECT_EQ(shelf.look().alarm, "");
    shelf.pass(2);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 901);
    EXPECT_NE(shelf.look().alarm, "");
}

TEST(OutboxWatch, BelievesOfAResultSeenFirstNoMoreThanTheTimeSinceItWasNotThere) {
    Shelf shelf;
    EXPECT_EQ(shelf.look().waiting, 0);
    shelf.pass(10);
    shelf.put("run-1", 4'000); // written before the clock was set forward
    shelf.put("run-2", -4'000);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 10);
    shelf.take("run-1");
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 0);
}

TEST(OutboxWatch, GoesByTheFoldersTimeAfterARestartWhereItIsPlausible) {
    Shelf shelf;
    shelf.put("run-1", 3 * 86'400);
    EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 3 * 86'400);
    EXPECT_NE(shelf.look().alarm.find("since 3 d"), std::string::npos) << shelf.look().alarm;
    for (const std::int64_t age_s : {std::int64_t{-4'000}, std::int64_t{20} * 365 * 86'400}) {
        shelf.put("run-1", age_s);
        shelf.start_anew();
        EXPECT_DOUBLE_EQ(shelf.look().oldest_s.value(), 0) << age_s;
        EXPECT_EQ(shelf.look().alarm, "");
        shelf.pass(901);
        EXPECT_NE(shelf.look().alarm, "") << "its waiting begins with the daemon";
    }
}

TEST(OutboxWatch, AlarmsWhenTheOldestIsOlderThanTheLimit) {
    Shelf shelf;
    shelf.put("run-1", 899); // found at the start
    shelf.say("waiting", "the share is full");
    EXPECT_EQ(shelf.look().alarm, "");
    shelf.pass(100); // limit: 15 min
    EXPECT_NE(shelf.look().alarm.find("1 result waits for the share since 16 min"),
              std::string::npos)
        << shelf.look().alarm;
}

TEST(OutboxWatch, AlarmsWhenTooManyWaitAndSaysWhetherAnybodyIsAtWork) {
    Shelf shelf{3};
    for (const char* run : {"run-1", "run-2", "run-3"}) {
        EXPECT_EQ(shelf.look().alarm, "");
        shelf.put(run, 0);
    }
    shelf.say("waiting", "the share is full");
    EXPECT_NE(shelf.look().alarm.find("axiscal-publish does not run"), std::string::npos);
    EXPECT_FALSE(shelf.look().publisher_runs);

    const int lock = ::open(shelf.scratch.file("publisher.lock").c_str(), O_RDWR | O_CREAT, 0640);
    struct flock whole {};
    whole.l_type = F_WRLCK;
    ASSERT_EQ(::fcntl(lock, F_OFD_SETLK, &whole), 0);
    EXPECT_TRUE(shelf.look().publisher_runs);
    EXPECT_NE(shelf.look().alarm.find("3 results wait"), std::string::npos);
    EXPECT_NE(shelf.look().alarm.find("the share is full"), std::string::npos);
    ::close(lock);
    EXPECT_FALSE(shelf.look().publisher_runs);
}

TEST(OutboxWatch, TakesNoReportOnTrust) {
    Shelf shelf;
    for (const char* text : {"", "{", "[]", "null", R"({"format":"other","reason":"x"})",
                             R"({"format":"axiscal.publisher/1","reason":7})"}) {
        write_bytes(shelf.scratch.file("publisher.json"), text);
        EXPECT_EQ(shelf.look().reason, "") << text;
    }
    write_bytes(shelf.scratch.file("publisher.json"), std::string(100'000, ' '));
    EXPECT_EQ(shelf.look().state, "");
    shelf.say("idle", "");
    EXPECT_EQ(shelf.look().state, "idle");
    EXPECT_EQ(shelf.look().destination, "smb://fs1/quality");
}

TEST(OutboxWatch, IsSilentWhereNoShareIsWanted) {
    ScratchFolder scratch;
    std::filesystem::create_directories(scratch.file("outbox/run-1"));
    OutboxWatch watch{scratch.path(), PublishConfig{}};
    const auto view = watch.look({{}, (std::int64_t{::time(nullptr)} + 1'000'000) * second_ns, {}});
    EXPECT_EQ(view.waiting, 1);
    EXPECT_EQ(view.alarm, "");
}

TEST(OutboxWatch, SaysOnceThatItsAlarmBeginsAndOnceThatItIsOver) {
    Shelf shelf{2};
    const auto judge = [&shelf] {
        return shelf.watch.judge({shelf.mono, shelf.now_ns, shelf.mono});
    };
    shelf.watch.begin_judging(shelf.mono);
    shelf.put("a", 0);
    shelf.put("b", 0);
    EXPECT_FALSE(judge()) << "looked at every ten seconds only";
    shelf.pass(10);
    const auto began = judge();
    ASSERT_TRUE(began);
    EXPECT_EQ(began->find("Alarm: 2 results wait for the share since"), 0U) << *began;
    shelf.put("c", 0);
    shelf.pass(10);
    EXPECT_FALSE(judge()) << "another count is no news";
    for (const char* entry : {"a", "b", "c"})
        shelf.take(entry);
    shelf.pass(10);
    EXPECT_EQ(judge(), std::optional<std::string>{"The share takes results again."});
}

TEST(OutboxWatch, IsDueInTenSecondsWhileSomethingWaitsElseInAMinute) {
    Shelf shelf;
    const auto judge = [&shelf] {
        return shelf.watch.judge({shelf.mono, shelf.now_ns, shelf.mono});
    };
    shelf.pass(10);
    EXPECT_FALSE(judge());
    EXPECT_EQ(shelf.watch.due(), shelf.mono + std::chrono::minutes{1});
    shelf.put("a", 0);
    shelf.pass(10);
    EXPECT_FALSE(judge()) << "one result is no alarm";
    EXPECT_EQ(shelf.watch.due(), shelf.mono + std::chrono::seconds{10});
    const ScratchFolder nowhere;
    EXPECT_FALSE(OutboxWatch(nowhere.path(), {}).due()) << "without a destination nothing is due";
}

} // namespace
} // namespace axiscal::outbox_watch_test
