#include "tools/axiscal/imports/readings_case.hpp"
#include "tools/axiscal/imports/rtl_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace axiscal::imports_test {
namespace {

/// Laid out as the writer among the public programs does.
std::string rtl_file() {
    return "HEADER::\r\nFile type  : rtl\r\nOwner      : Linear\r\nVersion no : V20.02.02\r\n\r\n"
           "TARGET DATA::\r\nFiletype  : ISO\r\nTarget-count: 3\r\nTargets :\r\n"
           "  0.000000  50.000000  100.000000\r\nFlags: 0 0 2 0\r\n\r\n"
           "USER-TEXT::\r\nMachine:TESTMILL\r\nSerial No:0001\r\nDate:2026-11-21 10:00:00\r\n"
           "By:OP\r\nAxis:X\r\nLocation:LAB\r\nTITLE:X linear\r\n\r\n"
           "RUNS::\r\nRun-count:2\r\n\r\nDEVIATIONS::\r\nRun Target Data:\r\n"
           "1   1      0.000\r\n1   2      1.250\r\n1   3      2.500\r\n"
           "2   3      2.100\r\n2   2      0.900\r\n2   1      -0.300\r\n\r\n"
           "ENVIRONMENT::\r\nAir temp   :20.1\r\nMat temp 1 :20.3\r\nDate Time  :\r\nEOF::\r\n";
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = rtl_file();
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

nlohmann::json case_of(const std::string& text) {
    auto read = read_rtl(text);
    EXPECT_TRUE(read) << (read ? "" : describe(read.error()));
    const auto made = case_of_readings(*read);
    EXPECT_TRUE(made) << (made ? "" : describe(made.error()));
    return made.value_or(nlohmann::json{});
}

Error refusal_of(const std::string& text) {
    auto read = read_rtl(text);
    if (!read) return read.error();
    const auto made = case_of_readings(*read);
    EXPECT_FALSE(made) << "taken";
    return made ? Error{} : made.error();
}

TEST(RtlFile, BecomesACaseWithItsDirectionsByTheOrderOfTheTargets) {
    EXPECT_TRUE(is_rtl(rtl_file()));
    const auto made = case_of(rtl_file());
    EXPECT_EQ(made.at("targets"), nlohmann::json({0.0, 50.0, 100.0}));
    EXPECT_EQ(made.at("forward"), nlohmann::json({{0.0}, {1.25}, {2.5}}));
    EXPECT_EQ(made.at("backward"), nlohmann::json({{-0.3}, {0.9}, {2.1}}));
    EXPECT_EQ(made.at("unit"), "um");
    EXPECT_EQ(made.at("target_unit"), "mm");
    EXPECT_EQ(made.at("machine"), "TESTMILL");
    EXPECT_EQ(made.at("axis").at("name"), "X");
    EXPECT_EQ(made.at("note"), "imported, readings by others");
}

TEST(RtlFile, WhoseFirstRunFallsIsBackwardWhateverItsNumber) {
    std::string text = rtl_file();
    for (auto at = text.find("\n1   "); at != std::string::npos; at = text.find("\n1   ", at))
        text.replace(at, 5, "\n9   ");
    for (auto at = text.find("\n2   "); at != std::string::npos; at = text.find("\n2   ", at))
        text.replace(at, 5, "\n1   ");
    for (auto at = text.find("\n9   "); at != std::string::npos; at = text.find("\n9   ", at))
        text.replace(at, 5, "\n2   ");
    EXPECT_EQ(case_of(text).at("forward"), nlohmann::json({{0.0}, {1.25}, {2.5}}));
}

TEST(RtlFile, ThatItsWriterHasSortedGoesByTheNumbersOfTheRunsAndSaysSo) {
    const std::string sorted = with("2   3      2.100\r\n2   2      0.900\r\n2   1      -0.300",
                                    "2   1      -0.300\r\n2   2      0.900\r\n2   3      2.100");
    const auto made = case_of(sorted);
    EXPECT_EQ(made.at("backward"), nlohmann::json({{-0.3}, {0.9}, {2.1}}));
    EXPECT_NE(made.at("note").get<std::string>().find("even ones as backward"), std::string::npos);
    auto one_way = sorted;
    one_way.replace(one_way.find("0 0 2 0"), 7, "0 1 2 0");
    const auto twice = case_of(one_way);
    EXPECT_FALSE(twice.contains("backward"));
    EXPECT_EQ(twice.at("forward"), nlohmann::json({{0.0, -0.3}, {1.25, 0.9}, {2.5, 2.1}}));
}

TEST(RtlFile, HasDecimalCommasOtherBlanksAndNoEnvironmentAsWell) {
    std::string commas = with("1   2      1.250\r\n", "1\t2\t+1.250\n");
    std::ranges::replace(commas, '.', ',');
    EXPECT_EQ(case_of(commas).at("forward").at(1).at(0), 1.25);
    const Error mixed = refusal_of(with("50.000000", "50,000000"));
    EXPECT_EQ(mixed.field, "line 10");
    EXPECT_NE(mixed.detail.find("comma where other numbers have a point"), std::string::npos);
    std::string bare = rtl_file();
    bare.resize(bare.find("ENVIRONMENT::"));
    EXPECT_NE(case_of(bare).at("note").get<std::string>().find("EOF::"), std::string::npos);
}

// 1 mrad is 3600 * 180 / (1000 pi) = 206.2648 seconds of arc.
TEST(RtlFile, OfAnAngleIsTakenAsMilliradiansAndSaysSo) {
    const auto made = case_of(with("File type  : rtl", "File type:rta"));
    EXPECT_EQ(made.at("axis").at("kind"), "rotary");
    EXPECT_EQ(made.at("unit"), "arcsec");
    EXPECT_EQ(made.at("target_unit"), "deg");
    EXPECT_NEAR(made.at("forward").at(1).at(0).get<double>(), 1.25 * 206.2648, 1e-4);
    EXPECT_NE(made.at("note").get<std::string>().find("milliradians"), std::string::npos);
}

TEST(RtlFile, OfOneDirectionWithARunOfZerosBehindEachLosesThese) {
    std::string text = with("2   3      2.100\r\n2   2      0.900\r\n2   1      -0.300",
                            "2   3      0.000\r\n2   2      0.000\r\n2   1      0.000");
    EXPECT_TRUE(case_of(text).contains("backward")) << "it says that it holds both directions";
    text.replace(text.find("0 0 2 0"), 7, "0 1 2 0");
    const auto made = case_of(text);
    EXPECT_FALSE(made.contains("backward"));
    EXPECT_EQ(made.at("forward"), nlohmann::json({{0.0}, {1.25}, {2.5}}));
    EXPECT_NE(made.at("note").get<std::string>().find("zero throughout"), std::string::npos);
}

TEST(RtlFile, ThatIsNotWholeOrNotOneAxisIsRefusedWithThePlace) {
    const auto says = [](const Error& error, const std::string& field, const std::string& words) {
        EXPECT_EQ(error.field, field) << describe(error);
        EXPECT_NE(error.detail.find(words), std::string::npos) << describe(error);
    };
    says(refusal_of(rtl_file().substr(0, 300)), "file", "has no section");
    says(refusal_of(with("2   1      -0.300\r\n", "")), "file", "run 2 has no reading of target 1");
    says(refusal_of(with("2   1      -0.300", "2   1      -0.3OO")), "line 32", "is no number");
    says(refusal_of(with("2   1      -0.300", "2   4      -0.300")), "line 32", "from 1 to 3");
    says(refusal_of(with("2   1      -0.300", "3   1      -0.300")), "line 32", "from 1 to 2");
    says(refusal_of(with("2   1      -0.300", "2   2      -0.300")), "line 32", "twice");
    says(refusal_of(with("2   1      -0.300", "2   1")), "line 32", "2 words");
    says(refusal_of(with("Target-count: 3\r\n", "")), "file", "states no \"Target-count\"");
    says(refusal_of(with("Target-count: 3", "Target-count: 4")), "file", "3 targets and states 4");
    says(refusal_of(with("rtl", "b5r")), "line 2", "neither rtl");
    says(refusal_of(with("EOF::", "DEVIATIONS::")), "line 38", "two axes in one file");
    says(refusal_of(with("2   3      2.100\r\n2   2      0.900\r\n2   1      -0.300",
                         "2   2      0.900\r\n2   3      2.100\r\n2   1      -0.300")),
         "line 30", "turns within");
}

TEST(RtlFile, OfTypePosIsTakenWithARemark) {
    const auto made = case_of(with("File type  : rtl", "File type  : pos"));
    EXPECT_EQ(made.at("unit"), "um");
    EXPECT_NE(made.at("note").get<std::string>().find("of type pos"), std::string::npos);
}

TEST(RtlFile, OfAnotherVersionIsTakenWithARemark) {
    EXPECT_NE(
        case_of(with("V20.02.02", "V21.00.00")).at("note").get<std::string>().find("V21.00.00"),
        std::string::npos);
}

} // namespace
} // namespace axiscal::imports_test
