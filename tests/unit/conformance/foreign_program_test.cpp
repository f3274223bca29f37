#include "tools/axiscal/conformance/foreign_program.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>

namespace axiscal::foreign_program_test {
namespace {

using namespace std::chrono_literals;

/// Far more than a shell needs on a busy computer.
constexpr auto patient = 60s;

std::string refusal(const std::string& command, std::chrono::milliseconds limit = patient) {
    const auto answer = ask_program(command, "{}", limit);
    return answer ? "answered: " + *answer : answer.error().detail;
}

TEST(ForeignProgram, ReadsTheCaseAndIsHeard) {
    EXPECT_EQ(ask_program("cat", "{\"a\":1}\n", patient).value(), "{\"a\":1}\n");
}

TEST(ForeignProgram, ACaseOfManyMegabytesBlocksNobody) {
    const std::string large(5'000'000, 'x');
    EXPECT_EQ(ask_program("cat", large, patient).value().size(), large.size());
    EXPECT_EQ(ask_program("echo unread", large, patient).value(), "unread\n");
}

TEST(ForeignProgram, ManyWordsOnStandardErrorBlockNobody) {
    EXPECT_EQ(ask_program("head -c 3000000 /dev/zero >&2; echo done", "", patient).value(),
              "done\n");
}

TEST(ForeignProgram, ACrashIsToldWithItsLastWord) {
    EXPECT_EQ(refusal("echo first >&2; echo 'KeyError: E' >&2; exit 3"),
              "ended with 3: KeyError: E");
    EXPECT_NE(refusal("kill -SEGV $$").find("was ended by"), std::string::npos);
    EXPECT_NE(refusal("no-such-program-at-all").find("ended with 127"), std::string::npos);
}

// Where the child that holds the pipe lives on, this waits for it, and ctest ends it.
TEST(ForeignProgram, AHangingOneEndsWithAllItsChildren) {
    EXPECT_NE(refusal("sleep 1000 & sleep 1000", 300ms).find("300 ms"), std::string::npos);
}

TEST(ForeignProgram, WhatItLeavesBehindIsEnded) {
    const auto answer = ask_program("sleep 1000 >/dev/null 2>&1 & echo $!", "", patient);
    ASSERT_TRUE(answer);
    const pid_t left = std::stoi(*answer);
    // it has no parent any more: init reaps it soon after the kill, or it stays a zombie
    for (int i = 0; i < 1000 && ::kill(left, 0) == 0; ++i) {
        const auto state = ask_program("cut -d' ' -f3 /proc/" + *answer, "", patient);
        if (state && *state == "Z\n") return;
        std::this_thread::sleep_for(10ms);
    }
    EXPECT_EQ(::kill(left, 0), -1);
}

TEST(ForeignProgram, OneThatNeverStopsTalkingIsCut) {
    EXPECT_NE(refusal("cat /dev/zero").find("64 MiB"), std::string::npos);
}

} // namespace
} // namespace axiscal::foreign_program_test
