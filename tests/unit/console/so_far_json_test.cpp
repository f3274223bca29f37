// How a run stands, as the interface gives it.
#include "acquisition/console/so_far_json.hpp"

#include "acquisition/console/api_json.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace axiscal::so_far_json_test {
namespace {

FiguresSoFar outside() {
    FiguresSoFar shown;
    shown.points_per_target = 3;
    shown.deviation_range_um = 13.5;
    shown.standard = "ISO 230-2:2014";
    shown.figures = {{"A", 14.25}};
    shown.limits = {{"A", 12.0, 14.25, Standing::outside, "A 14.2 of 12.0 um so far"}};
    shown.standing = Standing::outside;
    shown.sentence = "So far already outside: A 14.2 of 12.0 um.";
    shown.basis = "as shown at the machine";
    return shown;
}

TEST(SoFarJson, StandsInTheRunOfTheStatusWithEveryKey) {
    StationStatus status;
    status.run.emplace();
    EXPECT_TRUE(to_json(status).at("run").at("so_far").is_null());
    status.run->so_far = std::make_shared<const FiguresSoFar>(outside());
    const auto json = to_json(status).at("run").at("so_far");
    EXPECT_EQ(json.at("standing"), "outside");
    EXPECT_EQ(json.at("points_per_target"), 3);
    EXPECT_EQ(json.at("deviation_range_um"), 13.5);
    EXPECT_TRUE(json.at("reversal_max_um").is_null());
    EXPECT_EQ(json.at("standard"), "ISO 230-2:2014");
    EXPECT_EQ(json.at("figures").at(0).at("parameter"), "A");
    EXPECT_EQ(json.at("figures").at(0).at("value_um"), 14.25);
    EXPECT_EQ(json.at("limits").at(0).at("limit_um"), 12.0);
    EXPECT_EQ(json.at("limits").at(0).at("standing"), "outside");
    EXPECT_EQ(json.at("limits").at(0).at("sentence"), "A 14.2 of 12.0 um so far");
    EXPECT_EQ(json.at("basis"), "as shown at the machine");
}

TEST(SoFarJson, WithoutFiguresTheyAreNullAndNoEmptyList) {
    const auto json = to_json(FiguresSoFar{});
    EXPECT_TRUE(json.at("figures").is_null());
    EXPECT_EQ(json.at("limits"), nlohmann::ordered_json::array());
    EXPECT_EQ(json.at("standing"), "not judged");
}

TEST(SoFarJson, OneFigureAndOneLimitAreListsToo) {
    const auto json = to_json(outside());
    EXPECT_TRUE(json.at("figures").is_array());
    EXPECT_TRUE(json.at("limits").is_array());
}

TEST(SoFarJson, AChannelThatNothingMakesStaleSaysNull) {
    StationStatus status;
    status.channels.resize(1);
    EXPECT_TRUE(to_json(status).at("channels").at(0).at("stale_after_s").is_null());
    status.channels[0].stale_after_s = 60.0;
    EXPECT_EQ(to_json(status).at("channels").at(0).at("stale_after_s"), 60.0);
    status.axis.age_s = 0.5;
    status.axis.stale_after_s = 2.0;
    EXPECT_EQ(to_json(status).at("axis").at("age_s"), 0.5);
    EXPECT_EQ(to_json(status).at("axis").at("stale_after_s"), 2.0);
}

TEST(SoFarJson, TheAxisTellsBelowWhichStrengthTheCheckFails) {
    StationStatus status;
    EXPECT_TRUE(to_json(status).at("axis").at("least_strength_percent").is_null());
    status.axis.least_strength_percent = 20.0;
    EXPECT_EQ(to_json(status).at("axis").at("least_strength_percent"), 20.0);
}

} // namespace
} // namespace axiscal::so_far_json_test
