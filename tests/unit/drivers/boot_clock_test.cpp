// The station's clock where CLOCK_BOOTTIME and CLOCK_MONOTONIC differ, as after a suspend:
// time_namespaces(7) moves the first by an hour for a child of this test.
#include "drivers/loop/asio_scheduler.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <fstream>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::boot_clock_test {
namespace {

constexpr int cannot_move = 77;

double ahead_of_monotonic_s(MonotonicTime at) {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return seconds_of(at.time_since_epoch()) - static_cast<double>(now.tv_sec) -
           1e-9 * static_cast<double>(now.tv_nsec);
}

/// In a child of the process that moved the clock: only its children live in the namespace.
int judge() {
    boost::asio::io_context loop{1};
    const AsioScheduler scheduler{loop};
    const auto is_an_hour = [](double seconds) { return seconds > 3590 && seconds < 3610; };
    if (!is_an_hour(ahead_of_monotonic_s(scheduler.now()))) return 1;
    if (!is_an_hour(ahead_of_monotonic_s(scheduler.clock_tie().before))) return 2;
    return is_an_hour(seconds_of(scheduler.asleep())) ? 0 : 3;
}

int outcome_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int judge_after_an_hour_of_sleep() {
    if (::unshare(CLONE_NEWTIME) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWTIME) != 0)
        return cannot_move;
    std::ofstream offsets{"/proc/self/timens_offsets"};
    offsets << "boottime 3600 0\n" << std::flush;
    if (!offsets) return cannot_move;
    const pid_t child = ::fork();
    if (child == 0) ::_exit(judge());
    return outcome_of(child);
}

TEST(StationClockOfTheKernel, GoesOnWhileTheComputerIsSuspended) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) ::_exit(judge_after_an_hour_of_sleep());
    EXPECT_EQ(outcome_of(child), 0) << "77: the kernel gives no time namespace";
}

} // namespace
} // namespace axiscal::boot_clock_test
