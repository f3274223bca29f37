#include "cnc/marlin_program.hpp"

#include "recording_machine.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::marlin_program_test {
namespace {

TEST(MarlinProgram, DwellsInMilliseconds) {
    const auto program = MarlinProgram::parse("; a comment\nG21\nG90\nM84 S0 ; motors stay on\nG1 "
                                              "X12.5 F3000\nM400\nG4 P1500\nG1 X20\nG4 S2\n",
                                              'X');
    ASSERT_TRUE(program);
    RecordingMachine machine;
    ASSERT_TRUE(program->run(machine));
    EXPECT_EQ(machine.log,
              (std::vector<std::string>{"move 12.5 3000", "dwell 1.5", "move 20 3000", "dwell 2"}));
}

TEST(MarlinProgram, RefusesWhatItDoesNotUnderstand) {
    const auto refusal = [](const std::string& text) {
        const auto program = MarlinProgram::parse(text, 'X');
        return program ? std::string{} : program.error().detail;
    };
    EXPECT_EQ(refusal("G1 X1 F100\nM66 P0\n"), "line 2: M66 is not understood");
    EXPECT_EQ(refusal("G1 Y1 F100\n"), "line 1: the word Y is not understood here");
    EXPECT_EQ(refusal("G1 X1\n"), "line 1: a move without a feed rate (F)");
    EXPECT_EQ(refusal("G4 Pfast\n"), "line 1: \"Pfast\" is not a word with a number");
    EXPECT_NE(refusal("M84\nG91\n"), "");
}

} // namespace
} // namespace axiscal::simulate::marlin_program_test
