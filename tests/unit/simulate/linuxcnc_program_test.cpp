#include "cnc/linuxcnc_program.hpp"

#include "recording_machine.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::linuxcnc_program_test {
namespace {

using Log = std::vector<std::string>;

Log log_of(const std::string& text, bool answers = true) {
    RecordingMachine machine;
    machine.answers = answers;
    const auto program = LinuxcncProgram::parse(text, 'X');
    if (!program) return {program.error().detail};
    const auto ran = program->run(machine);
    if (!ran) machine.log.push_back(ran.error().detail);
    return machine.log;
}

std::string refusal(const std::string& text) {
    const auto program = LinuxcncProgram::parse(text, 'X');
    return program ? "" : program.error().detail;
}

const std::string head = "(a comment) G21 G90 G94 G17 G61 ; and another\n";

TEST(LinuxcncProgram, RunsOnePointOfTheHandshake) {
    const auto log =
        log_of(head + "F6000\nM68 E1 Q3\nM68 E0 Q17\nG1 X12.5\nG4 P0.5\nM66 P0 L3 Q10\n"
                      "o1 if [#5399 EQ -1]\n(ABORT,no answer)\no1 endif\nM2\nG1 X99\n");
    EXPECT_EQ(log,
              (Log{"analog 1 3", "analog 0 17", "move 12.5 6000", "dwell 0.5", "wait high 0 10"}));
}

TEST(LinuxcncProgram, AbortsWithItsTextWhenNobodyAnswers) {
    const auto log =
        log_of("M66 P0 L3 Q10\no1 if [#5399 EQ -1]\n(ABORT,no answer)\no1 endif\nM2\n", false);
    ASSERT_EQ(log.size(), 2U);
    EXPECT_EQ(log[1], "line 3: the program aborts: no answer");
}

TEST(LinuxcncProgram, LoopsOverNamedParameters) {
    const auto log =
        log_of("#<i> = 1\no100 while [#<i> LE 3]\nG0 X[#<i> * 10 + 0.5]\n#<i> = [#<i> + 1]\n"
               "o100 endwhile\n");
    EXPECT_EQ(log, (Log{"move 10.5 0", "move 20.5 0", "move 30.5 0"}));
}

TEST(LinuxcncProgram, TakesExactlyOneArm) {
    const std::string text =
        "o1 if [#1 EQ 1]\nG0 X1\no1 elseif [#1 EQ 2]\nG0 X2\no1 elseif [#1 EQ 3]\n"
        "G0 X3\no1 else\nG0 X4\no1 endif\nG0 X5\n";
    for (int arm = 1; arm <= 4; ++arm) {
        const auto log = log_of("#1=" + std::to_string(arm) + "\n" + text);
        EXPECT_EQ(log, (Log{"move " + std::to_string(arm) + " 0", "move 5 0"}));
    }
}

TEST(LinuxcncProgram, ArmsNest) {
    const auto log = log_of("o1 if [1]\no2 if [0]\nG0 X1\no2 else\nG0 X2\no2 endif\no1 else\n"
                            "o3 while [1]\nG0 X3\no3 endwhile\no1 endif\nG0 X4\n");
    EXPECT_EQ(log, (Log{"move 2 0", "move 4 0"}));
}

TEST(LinuxcncProgram, ExpressionsBindAsInTheManual) {
    EXPECT_EQ(log_of("G0 X[2 + 3 * 2 ** 2]\n"), (Log{"move 14 0"}));
    EXPECT_EQ(log_of("G0 X[[2 + 3] * 2]\n"), (Log{"move 10 0"}));
    EXPECT_EQ(log_of("G0 X[7 MOD 4 - 1]\n"), (Log{"move 2 0"}));
    EXPECT_EQ(log_of("G0 X[1 LT 2 AND 3 GE 3]\n"), (Log{"move 1 0"}));
    EXPECT_EQ(log_of("G0 X-[ABS[-4]]\n"), (Log{"move -4 0"}));
}

TEST(LinuxcncProgram, MotionAndFeedAreModal) {
    EXPECT_EQ(log_of("G1 F500 X1\nX2\nG0 X3\nX4\n"),
              (Log{"move 1 500", "move 2 500", "move 3 0", "move 4 0"}));
}

TEST(LinuxcncProgram, RefusesWhatItDoesNotUnderstandBeforeAnythingMoves) {
    EXPECT_EQ(refusal("G0 X1\nG2 X5 I3\n"), "line 2: G2 is not understood");
    EXPECT_EQ(refusal("G20\n"), "line 1: G20 is not understood");
    EXPECT_EQ(refusal("\nM3 S1000\n"), "line 2: M3 is not understood");
    EXPECT_EQ(refusal("G1 Y5 F100\n"), "line 1: the word Y is not understood here");
    EXPECT_EQ(refusal("G0 X1 Q3\n"), "line 1: the word Q is not understood here");
    EXPECT_EQ(refusal("o1 sub\no1 endsub\n"), "line 1: o-word \"sub\" is not understood");
    EXPECT_EQ(refusal("G0 X1 X2\n"), "line 1: the word x stands twice");
    EXPECT_NE(refusal("G0 X[1 + ]\n"), "");
    EXPECT_NE(refusal("G0 X[1\n"), "");
    EXPECT_NE(refusal("(open\n"), "");
    EXPECT_NE(refusal("G4\n"), "");
    EXPECT_NE(refusal("M66 P0\n"), "");
}

TEST(LinuxcncProgram, RefusesOWordsWithoutPartner) {
    EXPECT_EQ(refusal("o1 if [1]\nG0 X1\n"), "line 1: this o-word has no end");
    EXPECT_EQ(refusal("G0 X1\no1 endwhile\n"), "line 2: this o-word has no beginning");
    EXPECT_EQ(refusal("o1 while [1]\no2 endwhile\n"), "line 2: this o-word has no beginning");
}

TEST(LinuxcncProgram, RefusesWhileRunningWhatOnlyShowsThere) {
    EXPECT_EQ(log_of("G1 X1\n"), (Log{"line 1: G1 with zero feed rate"}));
    EXPECT_EQ(log_of("X1\n"), (Log{"line 1: an axis word without G0 or G1"}));
    EXPECT_EQ(log_of("G0 X#<never>\n"), (Log{"line 1: #<never> is not set"}));
}

} // namespace
} // namespace axiscal::simulate::linuxcnc_program_test
