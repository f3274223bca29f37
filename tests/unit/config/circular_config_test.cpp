#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::circular_config_test {
namespace {

using test::example_text;
using test::read_text;
using Reading = test::StationReading;

/// The example with `bar` below [ballbar] and `circle` below [circular].
Reading read_with(const std::string& bar, const std::string& circle) {
    std::string text = example_text();
    for (const auto& [table, lines] : {std::pair{"[ballbar]\n", bar}, {"[circular]\n", circle}}) {
        const std::string header = table;
        text.insert(text.find("\n" + header) + 1 + header.size(), lines);
    }
    return read_text(text);
}

const std::string sensor = "sensor = \"laser/axis 1\"\n";
const std::string radius = "radius = \"100 mm\"\n", feed = "feed = \"2 m/min\"\n";

TEST(CircularConfig, WithoutARadiusThereIsNoCircularTest) {
    const Reading reading = read_with("", "");
    EXPECT_EQ(reading.told, "");
    EXPECT_FALSE(reading.config.circular);
}

TEST(CircularConfig, WhatIsLeftOutIsTheUsualCircle) {
    const Reading reading = read_with(sensor, radius + feed);
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.circular);
    const CircularPlan& plan = reading.config.circular->setup.plan;
    EXPECT_NEAR(plan.feed_mm_per_s, 2000.0 / 60, 1e-12);
    EXPECT_EQ(plan.senses, (std::vector{Sense::ccw, Sense::cw}));
    EXPECT_EQ(plan.arc_deg, 360);
    EXPECT_EQ(plan.overshoot_deg, 180);
    EXPECT_FALSE(reading.config.circular->setup.capture.low_pass_hz);
    EXPECT_EQ(reading.config.circular->setup.capture.averaged, 1);
    EXPECT_NEAR(*reading.config.circular->setup.machine_alpha_per_K, 11.5e-6, 1e-18);
}

TEST(CircularConfig, EveryKeyArrivesInItsUnit) {
    const Reading reading =
        read_with(sensor + "sign = -1\nlength = \"150.0123 mm\"\nlength_U = \"0.5 um\"\n"
                           "expansion = \"0.5 um/(m*K)\"\ntemperature = \"material/contact 2\"\n",
                  radius + feed +
                      "plane = \"ZX\"\nsenses = [\"cw\"]\nrepeats = 3\nwarm_up = 1\n"
                      "start = \"-20 deg\"\narc = \"220 deg\"\novershoot = \"10 deg\"\n"
                      "feed_in = \"0.8 mm\"\nfeed_in_side = \"inside\"\nlow_pass_hz = 40\n"
                      "averaged = 4\ncentre = [\"1 mm\", \"2 mm\", \"-3 mm\"]\n");
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.circular);
    const auto& [setup, bar_temperature, eve_run] = *reading.config.circular;
    EXPECT_EQ(eve_run, "");
    EXPECT_EQ(setup.bar_sign, -1);
    EXPECT_NEAR(setup.bar_length_mm, 150.0123, 1e-9);
    EXPECT_NEAR(*setup.uncertainty.calibration_U_um, 0.5, 1e-12);
    EXPECT_EQ(*setup.uncertainty.calibration_k, 2);
    EXPECT_NEAR(*setup.bar_alpha_per_K, 0.5e-6, 1e-18);
    ASSERT_TRUE(bar_temperature);
    EXPECT_EQ(bar_temperature->channel, "contact 2");
    EXPECT_EQ(setup.plan.plane, CircularPlane::zx);
    EXPECT_EQ(setup.plan.senses, std::vector{Sense::cw});
    EXPECT_EQ(setup.plan.repeats, 3);
    EXPECT_EQ(setup.uncertainty.runs, 3);
    EXPECT_EQ(setup.plan.warm_up, 1);
    EXPECT_NEAR(setup.plan.start_deg, -20, 1e-12);
    EXPECT_NEAR(setup.plan.arc_deg, 220, 1e-12);
    EXPECT_FALSE(setup.plan.feed_in_outside);
    EXPECT_EQ(*setup.capture.low_pass_hz, 40);
    EXPECT_EQ(setup.capture.averaged, 4);
    EXPECT_NEAR(setup.plan.centre_mm[2], -3, 1e-12);
}

/// The example with lines below [circular.uncertainty] of a circle that is driven.
Reading read_with_budget(const std::string& lines) {
    std::string text = example_text();
    for (const auto& [table, more] : {std::pair{"[ballbar]\n", sensor},
                                      {"[circular]\n", radius + feed},
                                      {"[circular.uncertainty]\n", lines}}) {
        const std::string header = table;
        text.insert(text.find("\n" + header) + 1 + header.size(), more);
    }
    return read_text(text);
}

TEST(CircularConfig, TheDriftMayBeStatedOrPointToATest) {
    const Reading stated = read_with_budget("eve = \"0.4 um\"\n");
    EXPECT_EQ(stated.told, "");
    EXPECT_EQ(stated.config.circular->eve_run, "");
    EXPECT_NEAR(stated.config.circular->setup.uncertainty.eve_um.value_or(0), 0.4, 1e-12);
    const Reading latest = read_with_budget("eve_run = \"latest\"\n");
    EXPECT_EQ(latest.told, "");
    EXPECT_EQ(latest.config.circular->eve_run, "latest");
    EXPECT_FALSE(latest.config.circular->setup.uncertainty.eve_um);
    EXPECT_EQ(latest.config.eve_run, "") << "that of the axis is another";
    const Reading both = read_with_budget("eve = \"0.4 um\"\neve_run = \"latest\"\n");
    EXPECT_NE(both.told.find("circular.uncertainty.eve_run: is given together with eve"),
              std::string::npos)
        << both.told;
}

TEST(CircularConfig, TheStartMayComeFromTheTriggerWhereItsNumberIsTheWord) {
    const Reading reading =
        read_with(sensor, radius + feed + "start_from = \"trigger\"\ntrigger_delay = \"8 ms\"\n");
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.circular);
    EXPECT_EQ(reading.config.circular->setup.plan.start, StartMethod::trigger);
    EXPECT_NEAR(reading.config.circular->setup.plan.trigger_delay_s, 0.008, 1e-12);
    EXPECT_EQ(read_with(sensor, radius + feed).config.circular->setup.plan.start,
              StartMethod::feed_step);
}

/// A station file without [axis], [cycle] and [capture].
Reading read_alone(const std::string& circle) {
    const std::string text = "[station]\nname = \"circles\"\n"
                             "[ballbar]\nsensor = \"bar/axis 1\"\n"
                             "[circular]\n" +
                             circle +
                             "[trigger]\nshape = \"single-register\"\ntransport = \"tcp\"\n"
                             "host = \"127.0.0.1\"\nport = 1502\n"
                             "[certificate]\nmachine = \"M\"\n"
                             "[[instrument]]\nname = \"bar\"\ndriver = \"made\"\n"
                             "[[instrument]]\nname = \"material\"\ndriver = \"made\"\n";
    return read_text(text);
}

TEST(CircularConfig, AStationMayHaveABallbarAndNoLaser) {
    const Reading bare = read_alone(radius + feed);
    EXPECT_EQ(bare.told, "");
    EXPECT_TRUE(bare.config.circles_alone());
    EXPECT_EQ(bare.config.axis.name, "XY");
    EXPECT_FALSE(bare.config.circular->setup.machine_alpha_per_K);
    const Reading warm = read_alone(radius + feed +
                                    "plane = \"YZ\"\nmachine_expansion = \"11.5 um/(m*K)\"\n"
                                    "machine_temperature = [\"material/contact 1\"]\n");
    EXPECT_EQ(warm.told, "");
    EXPECT_EQ(warm.config.axis.name, "YZ");
    EXPECT_NEAR(*warm.config.circular->setup.machine_alpha_per_K, 11.5e-6, 1e-18);
    ASSERT_EQ(warm.config.axis.material_temperature.size(), 1U);
    EXPECT_EQ(warm.config.axis.material_temperature[0].channel, "contact 1");
    EXPECT_FALSE(read_with(sensor, radius + feed).config.circles_alone());
    const Reading doubled =
        read_with(sensor, radius + feed + "machine_expansion = \"1 um/(m*K)\"\n");
    EXPECT_NE(doubled.told.find("machine_expansion: belongs to a station without [axis]"),
              std::string::npos)
        << doubled.told;
}

TEST(CircularConfig, WhatIsMissingOrDoubledIsTold) {
    EXPECT_NE(read_with("", radius + feed).told.find("[ballbar] sensor"), std::string::npos);
    EXPECT_NE(read_with(sensor, radius)
                  .told.find("the station calculates the angle on the circle from it"),
              std::string::npos);
    EXPECT_NE(read_with(sensor, radius + feed + "senses = [\"cw\", \"cw\"]\n").told.find("once"),
              std::string::npos);
    EXPECT_NE(read_with(sensor, radius + feed + "centre = [\"1 mm\"]\n").told.find("three"),
              std::string::npos);
}

} // namespace
} // namespace axiscal::circular_config_test
