// The lock against falling asleep, with a program in the place of systemd-inhibit(1) that does what
// its manual says: starts the command while the lock is held, or complains and ends.
#include "acquisition/station/sleep_lock.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace axiscal::testing::sleep_lock_test {
namespace {

using namespace std::chrono_literals;

class SleepLockAgainst : public ::testing::Test {
protected:
    std::string program(const std::string& script) {
        const std::string path = scratch.file("inhibit");
        std::ofstream{path} << "#!/bin/sh\n" << script;
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path;
    }
    /// Notes its arguments, runs the command behind them and notes its end.
    std::string obliging() {
        return program("while [ \"${1#--}\" != \"$1\" ]; do echo \"$1\" >>" +
                       scratch.file("asked") + "; shift; done\n\"$@\"\necho released >>" +
                       scratch.file("asked") + "\n");
    }
    std::string asked() const {
        std::ifstream file{scratch.file("asked")};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    void run_until(const std::function<bool()>& holds) {
        const auto deadline = std::chrono::steady_clock::now() + 60s;
        while (!holds()) {
            ASSERT_LT(std::chrono::steady_clock::now(), deadline);
            loop.restart();
            loop.run_one_for(100ms);
        }
    }
    ScratchFolder scratch;
    boost::asio::io_context loop{1};
    AsioScheduler scheduler{loop};
};

TEST_F(SleepLockAgainst, AnObligingLogindIsHeldWhileItIsWantedAndNoLonger) {
    SleepLock lock{scheduler, obliging()};
    lock.want(true);
    lock.want(true);
    run_until([&] { return lock.held(); });
    EXPECT_NE(asked().find("--what=sleep:handle-lid-switch\n"), std::string::npos) << asked();
    EXPECT_NE(asked().find("--mode=block\n"), std::string::npos) << asked();
    EXPECT_EQ(asked().find("released"), std::string::npos);
    lock.want(false);
    run_until([&] { return !lock.held(); });
    EXPECT_NE(asked().find("released"), std::string::npos);
    EXPECT_EQ(lock.refusal(), "");
}

TEST_F(SleepLockAgainst, ALogindThatRefusesIsNamedWithItsWordsAndAskedAgainNextTime) {
    SleepLock lock{scheduler, program("echo 'Failed to inhibit: Access denied' >&2; exit 1\n")};
    lock.want(true);
    run_until([&] { return !lock.refusal().empty(); });
    EXPECT_TRUE(lock.refusal().ends_with("inhibit: Failed to inhibit: Access denied"))
        << lock.refusal();
    EXPECT_FALSE(lock.held());
    lock.want(false);
    obliging();
    lock.want(true);
    run_until([&] { return lock.held(); });
    EXPECT_EQ(lock.refusal(), "");
}

TEST_F(SleepLockAgainst, AComputerWithoutSystemdIsToldAtOnce) {
    SleepLock lock{scheduler, scratch.file("no such program")};
    lock.try_out();
    EXPECT_NE(lock.refusal().find("cannot start"), std::string::npos) << lock.refusal();
}

TEST_F(SleepLockAgainst, ATrialKnowsBeforehandAndKeepsNothing) {
    SleepLock lock{scheduler, obliging()};
    lock.try_out();
    run_until([&] { return asked().find("released") != std::string::npos; });
    EXPECT_EQ(lock.refusal(), "");
}

TEST_F(SleepLockAgainst, ALockThatIsTakenAwayIsARefusal) {
    SleepLock lock{scheduler, program("echo held\nexit 0\n")};
    lock.want(true);
    run_until([&] { return !lock.refusal().empty(); });
    EXPECT_TRUE(lock.refusal().ends_with("was ended")) << lock.refusal();
    EXPECT_FALSE(lock.held());
}

} // namespace
} // namespace axiscal::testing::sleep_lock_test
