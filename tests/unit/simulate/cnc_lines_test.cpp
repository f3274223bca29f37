#include "cnc/cnc_lines.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::cnc_lines_test {
namespace {

CncScenario cnc(const std::string& shape, const std::string& fault = "", int request = 1) {
    CncScenario scenario;
    scenario.shape = shape;
    if (!fault.empty()) scenario.faults = {{fault, request, 2.0}};
    return scenario;
}

/// Everything that is due at this time.
std::vector<CncWrite> sent(CncLines& lines, double now_s = 0) {
    std::vector<CncWrite> writes;
    while (const auto write = lines.due(now_s)) {
        writes.push_back(*write);
        lines.written();
    }
    return writes;
}

void announce(CncLines& lines, double sequence, double nominal_mm) {
    lines.set_analog(1, 6, 0);
    lines.set_analog(2, 2, 0);
    lines.set_analog(3, nominal_mm, 0);
    lines.set_analog(4, 4, 0);
    lines.set_analog(5, 70000, 0);
    lines.set_analog(0, sequence, 0);
}

TEST(CncLines, BlockHasTheDocumentedWords) {
    CncLines lines{cnc("sequence-block")};
    announce(lines, 17, -12.3456);
    const auto writes = sent(lines);
    ASSERT_EQ(writes.size(), 1U);
    // CMD 2, CMD_SEQ, TARGET_INDEX, DIRECTION, NOMINAL_POS -123456 = 0xFFFE1DC0, RUN_INDEX,
    // FEED 70000 = 0x00011170
    const std::array<std::uint16_t, 9> words{2, 17, 6, 2, 0xFFFE, 0x1DC0, 4, 0x0001, 0x1170};
    EXPECT_EQ(writes[0].words, words);
}

TEST(CncLines, TheCommandIsTheProgramsOwnWhereItSetsOne) {
    CncLines lines{cnc("sequence-block")};
    lines.set_analog(command_output, 1, 0);
    announce(lines, 1, 8);
    lines.set_analog(command_output, 2, 0);
    announce(lines, 2, 12);
    const auto writes = sent(lines);
    ASSERT_EQ(writes.size(), 2U) << "a command alone is no request";
    EXPECT_EQ(writes[0].words[0], 1); // CMD: prepare
    EXPECT_EQ(writes[0].words[1], 1); // CMD_SEQ
    EXPECT_EQ(writes[1].words[0], 2); // CMD: capture
    EXPECT_EQ(writes[1].words[1], 2);
}

TEST(CncLines, ZeroIsAlwaysWrittenAndIsNoRequest) {
    CncLines lines{cnc("single-register")};
    lines.set_analog(0, 0, 0);
    const auto writes = sent(lines);
    ASSERT_EQ(writes.size(), 1U);
    EXPECT_EQ(writes[0].words[0], 0);
    EXPECT_EQ(lines.requests(), 0);
}

TEST(CncLines, InputComparesDoneWithTheSequence) {
    CncLines lines{cnc("sequence-block")};
    EXPECT_FALSE(lines.input(0)); // nothing heard yet
    lines.answered({std::uint16_t{0}});
    EXPECT_TRUE(lines.input(0));
    lines.set_analog(0, 5, 0);
    EXPECT_FALSE(lines.input(0));
    lines.answered({std::uint16_t{5}});
    EXPECT_TRUE(lines.input(0));
    lines.disconnected();
    EXPECT_FALSE(lines.input(0));
}

TEST(CncLines, CoilAndIndexWaitsForTheDiscreteInput) {
    CncLines lines{cnc("coil-and-index")};
    lines.set_analog(0, 3, 0);
    lines.set_digital(0, true, 0);
    const auto writes = sent(lines);
    ASSERT_EQ(writes.size(), 2U);
    EXPECT_FALSE(writes[0].is_coil);
    EXPECT_TRUE(writes[1].is_coil && writes[1].coil);
    EXPECT_EQ(lines.requests(), 1);
    EXPECT_FALSE(lines.input(0));
    CncAnswer answer;
    answer.acknowledged = true;
    lines.answered(answer);
    EXPECT_TRUE(lines.input(0));
}

TEST(CncLines, ANewConnectionFindsTheRequestStanding) {
    CncLines lines{cnc("sequence-block")};
    announce(lines, 9, 1);
    EXPECT_EQ(sent(lines).size(), 1U);
    lines.connected();
    lines.connected(); // the first one died before anything was written
    const auto again = sent(lines);
    ASSERT_EQ(again.size(), 1U);
    EXPECT_EQ(again[0].words[1], 9);
}

TEST(CncLines, InjectsEachFaultAtItsRequest) {
    const auto first = [](const std::string& fault) {
        auto lines = std::make_unique<CncLines>(cnc("sequence-block", fault));
        announce(*lines, 1, 100);
        return lines;
    };
    auto doubled = first("doubled"), missed = first("missed"), late = first("late");
    EXPECT_EQ(sent(*doubled).size(), 2U);
    EXPECT_EQ(sent(*missed).size(), 0U);
    EXPECT_TRUE(missed->input(0)); // and goes on as if it had been answered
    EXPECT_EQ(sent(*late, 1.9).size(), 0U);
    EXPECT_EQ(sent(*late, 2.1).size(), 1U);
    auto order = first("out-of-order"), direction = first("wrong-direction"),
         target = first("wrong-target");
    EXPECT_EQ(sent(*order).at(0).words[1], 2);
    EXPECT_EQ(sent(*direction).at(0).words[3], 1);
    const auto moved = sent(*target).at(0).words;
    EXPECT_EQ(moved[2], 7);
    EXPECT_EQ(moved[4] * 65536 + moved[5], 1100000); // 110 mm
}

TEST(CncLines, FaultsStayWithTheirRequest) {
    CncLines lines{cnc("sequence-block", "missed", 2)};
    announce(lines, 1, 100);
    announce(lines, 2, 110);
    announce(lines, 3, 120);
    const auto writes = sent(lines);
    ASSERT_EQ(writes.size(), 2U);
    EXPECT_EQ(writes[0].words[1], 1);
    EXPECT_EQ(writes[1].words[1], 3);
    EXPECT_FALSE(lines.input(0));
}

} // namespace
} // namespace axiscal::simulate::cnc_lines_test
