#include "acquisition/program/probing_program.hpp"

#include "analysis/probing/probing_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace axiscal::probing_program_test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in{text};
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

int count_of(const std::string& text, const std::string& words) {
    int found = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
        ++found;
    return found;
}

TEST(ProbingProgram, ZeroesTheBlockByOneTouchOfEachFaceAndThenMeasures) {
    const std::string text = write_probing_linuxcnc({}, "probe.txt").value();
    const auto opened = text.find("(LOGOPEN,probe.txt)"), closed = text.find("(LOGCLOSE)");
    ASSERT_TRUE(opened != text.npos && closed != text.npos);
    const std::string before = text.substr(0, opened),
                      within = text.substr(opened, closed - opened);
    EXPECT_EQ(count_of(before, "G38.2"), 3);
    EXPECT_EQ(count_of(before, "G10 L2 P1 X[#5221 + #5061]"), 1);
    EXPECT_EQ(count_of(before, "G10 L2 P1 Y[#5222 + #5062]"), 1);
    EXPECT_EQ(count_of(before, "G10 L2 P1 Z[#5223 + #5063]"), 1);
    for (const char* axis : {"X", "Y", "Z"})
        EXPECT_EQ(count_of(within, std::string{"G38.2 "} + axis + "-5.0000 F480.0000"), 16) << axis;
}

TEST(ProbingProgram, TouchesFromGrowingDistances) {
    const auto lines = lines_of(write_probing_linuxcnc({}, "probe.txt").value());
    std::vector<std::string> starts;
    for (std::size_t i = 2; i < lines.size(); ++i)
        if (lines[i].starts_with("G38.2 X")) starts.push_back(lines[i - 2]);
    ASSERT_EQ(starts.size(), 17U);
    EXPECT_EQ(starts[0], "G1 X10.0000 F1000.0"); // the zeroing touch
    for (std::size_t i = 1; i <= 6; ++i)
        EXPECT_EQ(starts[i], "G1 X2.0000 F1000.0"); // five references, the first distance
    EXPECT_EQ(starts[7], "G1 X2.0016 F1000.0");
    EXPECT_EQ(starts[16], "G1 X2.0160 F1000.0");
}

// LinuxCNC, issue 3650: its read-ahead may take the values of an earlier touch.
TEST(ProbingProgram, TakesNoValueBeforeTheProbeHasSpoken) {
    const auto lines = lines_of(write_probing_linuxcnc({}, "probe.txt").value());
    int touches = 0;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        if (!lines[i].starts_with("G38.2")) continue;
        ++touches;
        EXPECT_EQ(lines[i + 1], "o<touched> call") << lines[i];
    }
    EXPECT_EQ(touches, 3 + 3 * 16);
    const auto asked = std::find(lines.begin(), lines.end(), "o<early> if [#5070 EQ 0]");
    ASSERT_NE(asked, lines.end());
    EXPECT_EQ(*(asked - 1), "o<touched> sub");
    EXPECT_EQ(*(asked + 2), "M2");
}

TEST(ProbingProgram, IsReadBackFromItsFirstLine) {
    ProbingPlan plan;
    plan.feed_mm_per_min = 123.5, plan.first_mm = 1.25, plan.step_mm = 0.0031;
    plan.touches = 20, plan.references = 0;
    const auto read = read_probing_id(write_probing_linuxcnc(plan, "p.txt").value());
    ASSERT_TRUE(read);
    EXPECT_EQ(probing_id(*read), probing_id(plan));
    EXPECT_FALSE(read_probing_id("(axiscal seed=1 pass=whole)"));
    EXPECT_FALSE(read_probing_id(""));
    const std::string head = "(axiscal probing feed=480 first=2 step=0.0016 references=5 touches=";
    EXPECT_TRUE(read_probing_id(head + "11)"));
    for (const char* number : {"nan)", "1e300)", "99999999999)", "-3)", ")", "201)"})
        EXPECT_FALSE(read_probing_id(head + number)) << number;
}

TEST(ProbingProgram, RefusesWhatTheMachineCannotDo) {
    const auto refused = [](auto change) {
        ProbingPlan plan;
        change(plan);
        return !write_probing_linuxcnc(plan, "p.txt");
    };
    EXPECT_TRUE(refused([](ProbingPlan& p) { p.feed_mm_per_min = 0; }));
    EXPECT_TRUE(refused([](ProbingPlan& p) { p.first_mm = 0.01; }));
    EXPECT_TRUE(refused([](ProbingPlan& p) { p.step_mm = 0; }));
    EXPECT_TRUE(refused([](ProbingPlan& p) { p.touches = 1; }));
    EXPECT_TRUE(refused([](ProbingPlan& p) { p.step_mm = 1; })); // 12 mm: beyond clear
    EXPECT_FALSE(write_probing_linuxcnc({}, "a folder/p.txt"));
    EXPECT_FALSE(write_probing_linuxcnc({}, ""));
}

TEST(ProbingLog, BecomesTheSeriesOfTheCase) {
    ProbingPlan plan;
    plan.touches = 3, plan.references = 1;
    std::string log;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 4; ++i) {
            const double late_mm = -0.001 * (i + 1) - 0.01 * axis;
            double at[3] = {7, 7, 7};
            at[axis] = late_mm;
            log += std::string{"-"} + "XYZ"[axis] + (i == 0 ? " reference " : " touch ") +
                   std::to_string(2 + 0.0016 * std::max(i - 1, 0)) + " " + std::to_string(at[0]) +
                   " " + std::to_string(at[1]) + " " + std::to_string(at[2]) + "\n";
        }
    const auto record = read_probing_log(plan, log);
    ASSERT_TRUE(record) << describe(record.error());
    const ProbingDelayCase stated = case_of(*record);
    ASSERT_EQ(stated.series.size(), 6U);
    EXPECT_TRUE(stated.series[2].reference);
    EXPECT_EQ(stated.series[3].direction, (std::array<double, 3>{0, -1, 0}));
    ASSERT_EQ(stated.series[3].trigger_mm.size(), 3U);
    EXPECT_NEAR(stated.series[3].trigger_mm[0], 0.012, 1e-9); // later along -Y: larger
    EXPECT_NEAR(stated.series[3].approach_mm[2], 2.0032, 1e-9);
    const auto results = evaluate_probing_delay(stated);
    ASSERT_TRUE(results);
    EXPECT_NEAR((*results)[5].variation_mm, 0.002, 1e-9);
    EXPECT_EQ((*results)[1].symbol, "E_TD,X");
}

TEST(ProbingLog, RefusesALogThatIsNotOfThisProgram) {
    ProbingPlan plan;
    plan.touches = 2, plan.references = 0;
    const std::string first = "-X touch 2 0 0 0\n";
    const std::string others = "-X touch 2.0016 0 0 0\n-Y touch 2 0 0 0\n-Y touch 2.0016 0 0 0\n"
                               "-Z touch 2 0 0 0\n-Z touch 2.0016 0 0 0\n";
    EXPECT_TRUE(read_probing_log(plan, first + others + "\n"));
    EXPECT_FALSE(read_probing_log(plan, first));
    EXPECT_FALSE(read_probing_log(plan, first + others + first));
    EXPECT_FALSE(read_probing_log(plan, ""));
    for (const char* other : {"+X touch 2 0 0 0\n", "-X tap 2 0 0 0\n", "-X touch 2 0 0\n",
                              "-A touch 2 0 0 0\n", "-X touch 2 0 nan 0\n", "-Y touch 2 0 0 0\n",
                              "-X reference 2 0 0 0\n", "-X touch 2.0016 0 0 0\n"})
        EXPECT_FALSE(read_probing_log(plan, other + others)) << other;
    const auto words = read_probing_log(plan, first + "nothing was touched\n");
    ASSERT_FALSE(words);
    EXPECT_NE(words.error().detail.find("line 2"), std::string::npos);
}

} // namespace
} // namespace axiscal::probing_program_test
