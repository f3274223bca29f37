#include "tools/axiscal/imports/import_file.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::pos_file_test {
namespace {

using Json = nlohmann::json;

const std::string both =
    "Position   \tBidirectional Avg Error\r\n0.0000     \t0.00000\r\n40.0000    \t0.00112\r\n"
    "80.0000    \t0.00205\r\n";
const std::string forward = "Position   \tForward Directional Avg Error\r\n0.0000     \t0.00000\r\n"
                            "40.0000    \t0.00126\r\n80.0000    \t0.00231\r\n";
const std::string backward =
    "Position   \tReverse Directional Avg Error\r\n0.0000     \t0.00010\r\n"
    "40.0000    \t0.00098\r\n80.0000    \t0.00179\r\n";

Json case_of(const std::string& text) {
    const auto file = import_file(text, std::nullopt);
    EXPECT_TRUE(file) << (file ? "" : describe(file.error()));
    return file ? file->document : Json{};
}

TEST(PosFile, GivesTheAveragesOfBothDirectionsAsOneRunEachWay) {
    const Json made = case_of("Machine: X\r\n" + both + forward + backward + "Notes\r\n1 2 3\r\n");
    EXPECT_EQ(made.at("targets"), Json({0.0, 40.0, 80.0}));
    EXPECT_EQ(made.at("unit"), "mm");
    EXPECT_EQ(made.at("forward"), Json({{0.0}, {0.00126}, {0.00231}}));
    EXPECT_EQ(made.at("backward"), Json({{0.0001}, {0.00098}, {0.00179}}));
    EXPECT_NE(made.at("note").get<std::string>().find("averages alone"), std::string::npos);
}

TEST(PosFile, WithoutTheBackwardOnesHasThemOfTheOthers) {
    const Json made = case_of(both + forward);
    EXPECT_NEAR(made.at("backward").at(1).at(0).get<double>(), 0.00098, 1e-15);
    EXPECT_FALSE(case_of(forward).contains("backward"));
}

TEST(PosFile, ThatDoesNotTellTheDirectionsOrIsNotWholeIsRefused) {
    const auto refused = [](const std::string& text) {
        const auto file = import_file(text, std::nullopt);
        EXPECT_FALSE(file);
        return file ? std::string{} : describe(file.error());
    };
    EXPECT_NE(refused(both).find("both directions together alone"), std::string::npos);
    EXPECT_NE(refused(both.substr(0, both.find("80.0")) + forward).find("other positions"),
              std::string::npos);
    EXPECT_NE(refused(backward).find("no forward averages"), std::string::npos);
    EXPECT_NE(refused(forward + forward).find("two axes in one file"), std::string::npos);
    EXPECT_NE(refused("Position \tForward Directional Avg Error\r\n").find("holds no reading"),
              std::string::npos);
    EXPECT_NE(refused(forward + "80.0 0.001\r\n").find("line 5"), std::string::npos);
    EXPECT_NE(refused(forward + "90.0\r\n").find("line 5"), std::string::npos);
}

} // namespace
} // namespace axiscal::pos_file_test
