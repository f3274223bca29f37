// An axis that a linear scale measures: [axis.scale] in the place of laser, beam and air.
#include "tests/unit/config/station_text.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>

namespace axiscal::station_scale_config_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::read_text;
using Reading = test::StationReading;

const std::string stated = "channel = \"laser/axis 1\"\ncoefficient = \"8.5 um/(m*K)\"\n";

/// The example with these lines in [axis.scale], and nothing of laser and air.
std::string scale_text(const std::string& lines) {
    std::string text = example_text();
    for (const std::string key : {"\nlaser = ", "\ndead_path = "}) {
        const auto begin = text.find(key) + 1;
        text.erase(begin, text.find('\n', begin) + 1 - begin);
    }
    const std::string list = "[\"material/contact 1\", \"material/contact 2\"]";
    text.replace(text.find(list), list.size(), "[\"material/contact 1\", \"material/contact 3\"]");
    const auto air = text.find("\n[axis.air]\n");
    text.erase(air, text.find("\n[cycle]\n", air) - air);
    return text.insert(text.find("\n[cycle]\n"), "\n[axis.scale]\n" + lines);
}

TEST(StationScale, NeedsNeitherBeamNorAir) {
    using namespace std::chrono_literals;
    const Reading reading =
        read_text(scale_text(stated + "temperature = [\"material/contact 2\"]\noldest = \"20 s\"\n"
                                      "standard_uncertainty = \"0.5 um/(m*K)\"\n"
                                      "temperature_width = \"0.4 K\"\n"));
    EXPECT_EQ(reading.told, "");
    const AxisConfig& axis = reading.config.axis;
    ASSERT_TRUE(axis.scale);
    EXPECT_EQ(axis.laser.instrument, "laser");
    EXPECT_EQ(axis.laser.channel, "axis 1");
    EXPECT_DOUBLE_EQ(axis.scale->setup.coefficient.in(um_per_m_kelvin), 8.5);
    ASSERT_TRUE(axis.scale->setup.standard_uncertainty && axis.scale->setup.temperature_width);
    EXPECT_DOUBLE_EQ(axis.scale->setup.standard_uncertainty->in(um_per_m_kelvin), 0.5);
    EXPECT_DOUBLE_EQ(axis.scale->setup.temperature_width->in(kelvin), 0.4);
    ASSERT_EQ(axis.scale->temperature.size(), 1U);
    EXPECT_EQ(axis.scale->temperature[0].channel, "contact 2");
    EXPECT_EQ(axis.air.oldest, 20s);
    EXPECT_TRUE(axis.air_temperature.instrument.empty());
    EXPECT_EQ(axis.material_temperature.size(), 2U);
    EXPECT_FALSE(reading.config.circles_alone());
}

TEST(StationScale, IsNamedBesideNoLaserAndNoBeam) {
    const std::string good = scale_text(stated + "temperature = [\"material/contact 2\"]\n");
    for (const std::string key :
         {"laser = \"laser/axis 1\"", "dead_path = \"120 mm\"", "beam_walk = \"0.5 mm\""}) {
        std::string text = good;
        text.insert(text.find("\nsign = ") + 1, key + "\n");
        expect_refused_once(read_text(text), "belongs to a laser, and [axis.scale] says");
    }
}

TEST(StationScale, NeedsItsTemperatureAndItsCoefficient) {
    expect_refused_once(read_text(scale_text(stated + "temperature = []\n")),
                        "axis.scale.temperature: names no sensor");
    expect_refused_once(read_text(scale_text("channel = \"laser/axis 1\"\n"
                                             "temperature = [\"material/contact 2\"]\n")),
                        "axis.scale.coefficient");
    expect_refused_once(read_text(scale_text(stated + "temperature = [\"air/air temperature\"]\n")),
                        "cannot serve as material");
}

} // namespace
} // namespace axiscal::station_scale_config_test
