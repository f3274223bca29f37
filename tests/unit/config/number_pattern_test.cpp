#include "config/number_pattern.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::number_pattern_test {
namespace {

TEST(NumberPattern, TakesPlainNumbersAndPatternsThatCount) {
    for (const char* right : {"", "2026-0147", "CAL-{year}-{count:4}", "{count}", "{count:9}/{year}",
                              "Kalibrierschein Nr. {count} für Halle 2", "{year}{year}-{count:1}"})
        EXPECT_EQ(mistake_in_number(right), "") << right;
}

TEST(NumberPattern, RefusesWhatWouldGiveOneNumberTwice) {
    for (const char* wrong : {"CAL-{year}", "{count}-{count}", "{year}-{count:4}{count}"})
        EXPECT_NE(mistake_in_number(wrong).find("needs {count} once"), std::string::npos) << wrong;
}

TEST(NumberPattern, NamesTheTokenThatItDoesNotKnow) {
    for (const char* token : {"{month}", "{count:0}", "{count:10}", "{count:}", "{Year}", "{}",
                              "{ count}", "{count:x}"})
        EXPECT_NE(mistake_in_number("N-" + std::string{token}).find("knows no " + std::string{token}),
                  std::string::npos)
            << token;
}

TEST(NumberPattern, RefusesHalfBracesLinesAndLongOnes) {
    for (const char* wrong : {"{count", "count}", "}{count}"})
        EXPECT_NE(mistake_in_number(wrong).find("brace without"), std::string::npos) << wrong;
    for (const char* wrong : {"a\nb", "a\tb", "\x7f"})
        EXPECT_NE(mistake_in_number(wrong).find("control character"), std::string::npos);
    EXPECT_NE(mistake_in_number(std::string(61, '7')).find("60 bytes"), std::string::npos);
}

} // namespace
} // namespace axiscal::number_pattern_test
