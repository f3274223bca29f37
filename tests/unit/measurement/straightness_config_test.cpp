// The table [straightness]: what it says, what [cycle] says in its place, and each key that is
// wrong by itself.
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "tests/unit/config/station_text.hpp"

#include <any>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace axiscal::straightness_config_test {
namespace {

/// A linear axis X of 1000 mm before a laser.
StationConfig station_of_x() {
    StationConfig station;
    station.axis.laser = {"laser", "axis 1"};
    InstrumentConfig laser;
    laser.name = "laser";
    station.instruments.push_back(laser);
    station.cycle.travel_low = mm(0);
    station.cycle.travel_high = mm(1000);
    station.cycle.overrun = mm(5);
    station.cycle.interval = mm(90);
    station.cycle.feed = mm_per_minute(1000);
    station.capture.fastest = mm_per_minute(30'000);
    return station;
}

constexpr const char* least_text = "across = \"Y\"\nsign = 1\nfactor = 36.012\n";

struct ReadTable {
    std::any config;
    std::string told; ///< refusals, one a line; empty: accepted
    [[nodiscard]] const StraightnessConfig& operator*() const {
        return *std::any_cast<StraightnessConfig>(&config);
    }
};

ReadTable read_table(const std::string& keys, const StationConfig& station = station_of_x()) {
    auto document = test::document_of("[straightness]\n" + keys);
    ReadTable table;
    table.config = read_straightness_section(document.root().table("straightness"), station);
    table.told = test::told(document);
    return table;
}

ReadTable read_more(const std::string& keys) {
    return read_table(least_text + keys);
}

TEST(StraightnessTable, WhatItLeavesOutTheCycleSays) {
    const ReadTable table = read_table(least_text);
    ASSERT_EQ(table.told, "");
    const StraightnessConfig& config = *table;
    EXPECT_EQ(config.setup.across, "Y");
    EXPECT_EQ(config.setup.factor, 36.012);
    EXPECT_EQ(config.setup.mirror, MirrorPosition::normal);
    EXPECT_EQ(config.range, 2.5_mm);
    EXPECT_EQ(config.feed, mm_per_minute(1000));
    EXPECT_EQ(config.dwell, std::chrono::seconds{3});
    EXPECT_FALSE(config.setup.uncertainty.factor_U);
    EXPECT_EQ(config.optics.name, "straightness optics");
}

TEST(StraightnessTable, ElevenEvenTargetsAreDrivenInBothDirections) {
    const ReadTable table = read_more("approaches = 2\n");
    ASSERT_EQ(table.told, "");
    const RunPlan& plan = (*table).plan;
    ASSERT_EQ(plan.targets.size(), 11U);
    EXPECT_EQ(plan.targets.front(), mm(5));
    EXPECT_EQ(plan.targets[1], mm(104));
    EXPECT_EQ(plan.targets.back(), mm(995));
    EXPECT_EQ(plan.pass, "straightness");
    EXPECT_EQ(plan.points.size(), 44U);
    EXPECT_EQ(plan.points[11], (PlannedPoint{11, 10, Direction::negative, 0}));
    EXPECT_FALSE(plan.seed);
    EXPECT_EQ(plan.datum, mm(0));
    EXPECT_NE(plan.remark.find("no random part"), std::string::npos);
}

TEST(StraightnessTable, TargetsAreItsOwnOrTheListOfTheCycle) {
    StationConfig station = station_of_x();
    station.cycle.targets = std::vector<Length>{mm(70), mm(270), mm(470)};
    EXPECT_EQ((*read_table(least_text, station)).plan.targets, *station.cycle.targets);
    const ReadTable own = read_table(
        std::string{least_text} + "targets = [\"100 mm\", \"300 mm\", \"600 mm\"]\n", station);
    EXPECT_EQ((*own).plan.targets, (std::vector<Length>{mm(100), mm(300), mm(600)}));
    const ReadTable grid = read_table(std::string{least_text} + "interval = \"400 mm\"\n", station);
    EXPECT_EQ((*grid).plan.targets, (std::vector<Length>{mm(5), mm(405), mm(805)}));
}

TEST(StraightnessTable, TheFactorFollowsFromTheAngleOfThePrism) {
    const ReadTable table = read_table("across = \"Y\"\nsign = -1\nprism_angle = \"1.5916 deg\"\n");
    ASSERT_EQ(table.told, "");
    EXPECT_NEAR((*table).setup.factor, 36.0, 0.001);
    EXPECT_EQ((*table).setup.sign, -1);
}

TEST(StraightnessTable, WhatIsStatedForTheBudgetIsKept) {
    const ReadTable table =
        read_more("factor_uncertainty = \"0.5 %\"\nfactor_k = 2.2\nmirror_limit = 0.15\n"
                  "eve = \"0.4 um\"\nresolution = \"0.1 nm\"\nrange = \"1.5 mm\"\n"
                  "mirror = \"reversed\"\nplace = \"prism on the table\"\n"
                  "[straightness.optics]\nserial = \"W-7\"\ncertificate_number = \"C-9\"\n"
                  "calibrated_on = \"2026-01-31\"\ndue_on = \"2027-01-31\"\n");
    ASSERT_EQ(table.told, "");
    const StraightnessSetup& setup = (*table).setup;
    EXPECT_NEAR(setup.uncertainty.factor_U.value().in(percent), 0.5, 1e-9);
    EXPECT_EQ(setup.uncertainty.factor_k, 2.2);
    EXPECT_EQ(setup.uncertainty.mirror_limit_um_per_m2, 0.15);
    EXPECT_NEAR(setup.uncertainty.eve.value().in(um), 0.4, 1e-9);
    EXPECT_EQ(setup.mirror, MirrorPosition::reversed);
    EXPECT_NEAR(setup.resolution.in(nm), 0.1, 1e-9);
    EXPECT_EQ((*table).range, mm(1.5));
    EXPECT_EQ((*table).optics.serial, "W-7");
    EXPECT_EQ((*table).optics.due_on, "2027-01-31");
}

struct Wrong {
    const char* keys; ///< beside the least that a table needs
    const char* told; ///< a part of the only refusal
};

TEST(StraightnessTable, EachKeyThatIsWrongIsToldByItself) {
    const Wrong wrong[] = {
        {"prism_angle = \"1.6 deg\"\n", "straightness.prism_angle: is given together with factor"},
        {"factor_uncertainty = \"1 %\"\nfactor_limit = \"2 %\"\n", "straightness.factor_limit"},
        {"factor_k = 2\n", "straightness.factor_k: belongs to factor_uncertainty"},
        {"mirror = \"turned\"\n", "straightness.mirror: \"turned\" is not one of"},
        {"eve = \"1 um\"\neve_run = \"latest\"\n", "straightness.eve_run: is given together"},
        {"range = \"2.5\"\n", "straightness.range"},
        {"channel = \"laser/axis 2\"\n",
         "straightness.channel: is another channel than axis.laser"},
        {"interval = \"50 mm\"\ntargets = [\"5 mm\", \"9 mm\", \"20 mm\"]\n",
         "straightness.interval: is given together with targets"},
        {"targets = [\"10 mm\", \"500 mm\"]\n", "straightness.targets: has 2 targets"},
        {"targets = [\"10 mm\", \"500 mm\", \"400 mm\"]\n", "does not rise"},
        {"targets = [\"1 mm\", \"500 mm\", \"900 mm\"]\n", "1 mm leaves no overrun"},
        {"interval = \"0.5 mm\"\n", "straightness.targets: has 1001 targets or more"},
        {"approaches = 0\n", "straightness.approaches: 0 is out of range"},
        {"overrun = \"600 mm\"\n", "straightness.overrun: 600 mm at both ends leaves nothing"},
        {"datum = \"-1 mm\"\n", "straightness.datum: -1 mm lies outside the travel"},
        {"travel_low = \"1200 mm\"\n", "straightness.travel_high: must lie above travel_low"},
        {"feed = \"50000 mm/min\"\n", "straightness.feed: is above capture.fastest"},
        {"dwell = \"0.2 s\"\n", "straightness.dwell: is shorter than capture.window"},
        {"base = \"100 mm\"\n", "straightness.base"},
        {"[straightness.optics]\ncalibrated_on = \"2026-02-01\"\ndue_on = \"2026-01-01\"\n",
         "straightness.optics.due_on: is before calibrated_on"},
    };
    for (const auto& [keys, told] : wrong) {
        const ReadTable table = read_more(keys);
        EXPECT_NE(table.told.find(told), std::string::npos) << keys << table.told;
        EXPECT_EQ(test::count_lines(table.told), 1) << keys << table.told;
    }
}

TEST(StraightnessTable, WithoutDirectionSignOrFactorItIsNotReady) {
    const std::string told = read_table("").told;
    for (const char* key : {"straightness.across: is missing", "straightness.sign: is missing",
                            "straightness.factor: is missing: state it from the certificate"})
        EXPECT_NE(told.find(key), std::string::npos) << told;
    EXPECT_NE(read_table("across = \"X\"\nsign = 1\nfactor = 36\n").told.find("is the axis itself"),
              std::string::npos);
    EXPECT_NE(read_table("across = \"Y\"\nsign = 0\nfactor = 36\n").told.find("-1 when it falls"),
              std::string::npos);
}

TEST(StraightnessTable, AngleStepsAreRefusedOnceWhateverElseIsStated) {
    const ReadTable table = read_table("method = \"angle-steps\"\nbase = \"100 mm\"\n");
    EXPECT_EQ(table.told, "station.toml:2: straightness.method: \"angle-steps\" is not measured "
                          "live yet; say \"wollaston\"\n");
    EXPECT_FALSE(table.config.has_value());
}

TEST(StraightnessTable, AStationThatCannotMeasureItSaysWhy) {
    StationConfig rotary = station_of_x(), scale = station_of_x(), dwell = station_of_x();
    rotary.cycle.axis_kind = AxisKind::rotary;
    scale.axis.scale.emplace();
    dwell.trigger.shape = TriggerShape::dwell;
    EXPECT_NE(read_table(least_text, rotary).told.find("of a linear axis"), std::string::npos);
    EXPECT_NE(read_table(least_text, scale).told.find("needs a laser"), std::string::npos);
    EXPECT_NE(read_table(least_text, dwell).told.find("sends requests"), std::string::npos);
}

TEST(StraightnessTable, WhatTheAxisWasRefusedForIsNotToldTwice) {
    StationConfig station = station_of_x();
    station.cycle.travel_low = station.cycle.travel_high = Length{};
    EXPECT_EQ(read_table(least_text, station).told, "");
    station = station_of_x();
    station.cycle.overrun = Length{};
    EXPECT_EQ(read_table(least_text, station).told, "");
}

} // namespace
} // namespace axiscal::straightness_config_test
