#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <regex>
#include <string>

namespace axiscal::station_config_test {
namespace {

using test::count_lines;
using test::example_text;
using test::expect_refused_once;
using test::read_changed;
using test::read_text;
using Reading = test::StationReading;

TEST(StationConfig, RefusesEachMissingSafetyValue) {
    for (const std::string key : {"travel_low", "travel_high", "sign", "dead_path", "coefficient",
                                  "overrun", "feed", "shape", "transport"}) {
        const std::string text =
            std::regex_replace(example_text(), std::regex{"\n" + key + " = [^\n]*"}, "\n");
        const std::string told = read_text(text).told;
        EXPECT_NE(told.find("." + key + ": is missing"), std::string::npos) << key << "\n" << told;
    }
}

TEST(StationConfig, TellsEverythingOfAnEmptyFileAtOnce) {
    const Reading reading = read_text("");
    for (const char* key :
         {"instrument:", "axis.travel_low:", "axis.sign:", "cycle.feed:", "trigger.shape:"})
        EXPECT_NE(reading.told.find(key), std::string::npos) << key << "\n" << reading.told;
}

TEST(StationConfig, RefusesTravelLimitsInTheWrongOrder) {
    const Reading reading = read_changed("travel_high = \"1000 mm\"", "travel_high = \"-1 mm\"");
    expect_refused_once(reading, "axis.travel_high: must lie above travel_low");
}

TEST(StationConfig, WantsEitherAListOfTargetsOrAnInterval) {
    const std::string list = "targets = [\"0 mm\", \"200 mm\", \"410 mm\"]";
    expect_refused_once(read_changed("interval = \"93 mm\"", "interval = \"93 mm\"\n" + list),
                        "cycle.interval: is given together with targets");
    const Reading both = read_changed("interval = \"93 mm\"\n", list + "\n");
    EXPECT_NE(both.told.find("cycle.target_count: belongs to interval"), std::string::npos);
    EXPECT_NE(both.told.find("cycle.first_target: belongs to interval"), std::string::npos);
    EXPECT_EQ(count_lines(both.told), 2) << both.told;
}

/// The example without what has a default, and the values that stand for it.
TEST(StationConfig, WhatCanHarmNothingMayBeLeftOut) {
    std::string text = example_text();
    for (const char* key :
         {"kind", "laser", "temperature", "pressure", "humidity", "interval", "target_count",
          "first_target", "spread_limit", "fastest", "port", "host"})
        text = std::regex_replace(text, std::regex{std::string{"\n"} + key + " = [^\n]*"}, "\n");
    const Reading reading = read_text(text);
    EXPECT_EQ(reading.told, "");
    const StationConfig& config = reading.config;
    EXPECT_EQ(config.cycle.axis_kind, AxisKind::linear);
    EXPECT_EQ(config.capture.spread_limit, um(2));
    EXPECT_EQ(config.capture.fastest, mm_per_minute(60'000));
    EXPECT_EQ(config.trigger.port, 1502);
    EXPECT_EQ(config.trigger.host, "127.0.0.1");
    for (const RoleConfig& role :
         {config.axis.laser, config.axis.air_temperature, config.axis.air_pressure,
          config.axis.air_humidity, config.axis.material_temperature.at(0)})
        EXPECT_TRUE(role.by_kind && role.instrument.empty());
    EXPECT_FALSE(config.circles_alone());
}

/// 1000 mm less 2 x 2 mm of overrun hold 10 intervals and 0.3 p at both ends: 93.96 mm. Up to 2 m
/// five targets lie on a metre, above it none are more than 250 mm apart.
TEST(StationConfig, ElevenTargetsFillATravelWithoutAnInterval) {
    const auto interval_mm = [](const std::string& travel) {
        std::string text = std::regex_replace(
            example_text(), std::regex{"\n(interval|target_count|first_target) = [^\n]*"}, "\n");
        text.replace(text.find("\"1000 mm\""), 9, '"' + travel + '"');
        return read_text(text).config.cycle.interval.value().in(mm);
    };
    EXPECT_DOUBLE_EQ(interval_mm("1000 mm"), 93);
    EXPECT_DOUBLE_EQ(interval_mm("2000 mm"), 188);
    EXPECT_DOUBLE_EQ(interval_mm("8 m"), 250);
    EXPECT_NEAR(interval_mm("10 mm"), 6.0 / 10.6, 1e-12);
}

TEST(StationConfig, WarnsOfASingleMaterialSensor) {
    const Reading reading = read_changed("\"material/contact 1\", ", "");
    EXPECT_EQ(reading.told, "");
    ASSERT_EQ(reading.config.warnings.size(), 1U);
    EXPECT_NE(reading.config.warnings[0].describe().find("at least two"), std::string::npos);
}

TEST(StationConfig, RefusesARunWithoutMaterialSensor) {
    expect_refused_once(read_changed("\"material/contact 1\", \"material/contact 2\"", ""),
                        "axis.material.temperature: names no sensor");
}

TEST(StationConfig, RefusesAnAirChannelAsMaterial) {
    expect_refused_once(read_changed("\"material/contact 1\"", "\"air/air temperature\""),
                        "is a channel of medium air");
}

TEST(StationConfig, RefusesAMaterialChannelAsAir) {
    expect_refused_once(
        read_changed("temperature = \"air/air temperature\"",
                     "temperature = \"material/contact 1\""),
        "axis.air.temperature: \"material/contact 1\" is a channel of medium material");
}

TEST(StationConfig, RefusesTheSameSensorTwice) {
    expect_refused_once(read_changed("\"material/contact 1\", \"material/contact 2\"",
                                     "\"material/contact 1\", \"material/contact 1\""),
                        "stands there twice");
}

TEST(StationConfig, RefusesARoleOfAnUnknownInstrument) {
    expect_refused_once(read_changed("laser = \"laser/axis 1\"", "laser = \"lasr/axis 1\""),
                        "did you mean \"laser\"?");
}

TEST(StationConfig, RefusesARoleWithoutChannel) {
    for (const char* role : {"laser", "laser/", "/axis 1", ""})
        expect_refused_once(
            read_changed("laser = \"laser/axis 1\"", "laser = \"" + std::string{role} + "\""),
            "axis.laser: \"" + std::string{role} + "\" names no channel");
}

TEST(StationConfig, RefusesASignOfZero) {
    expect_refused_once(read_changed("sign = 1", "sign = 0"), "axis.sign: is 1 when");
}

TEST(StationConfig, RefusesAWindowLongerThanTheHalt) {
    expect_refused_once(read_changed("dwell = \"4 s\"", "dwell = \"0.4 s\""),
                        "capture.window: is longer than cycle.dwell");
}

TEST(StationConfig, RefusesAFeedFasterThanTheAxis) {
    expect_refused_once(read_changed("feed = \"1000 mm/min\"", "feed = \"40 m/min\""),
                        "capture.fastest: is below cycle.feed");
}

TEST(StationConfig, RefusesTwoInstrumentsOfOneName) {
    const Reading reading = read_changed("name = \"material\"", "name = \"air\"");
    EXPECT_NE(
        reading.told.find("instrument \"air\".name: \"air\" is the name of the instrument in line"),
        std::string::npos)
        << reading.told;
}

TEST(StationConfig, RefusesAConsoleHostThatIsNoAddress) {
    expect_refused_once(
        read_changed("# host = \"127.0.0.1\"\n# port = 8470", "host = \"bay3.plant.example\""),
        "console.host: \"bay3.plant.example\" is no address");
}

TEST(StationConfig, RefusesPathsThatDependOnTheStartingFolder) {
    expect_refused_once(
        read_changed("# state_directory = \"/var/lib/axiscal\"", "state_directory = \"var\""),
        "station.state_directory: \"var\" is no whole path");
}

TEST(StationConfig, RefusesAnUnknownKeyOfAChannel) {
    expect_refused_once(read_changed("place = \"nut side", "palce = \"nut side"),
                        "instrument \"material\".channel \"contact 1\".palce: is not a key of this "
                        "table; did you mean "
                        "\"place\"?");
}

TEST(StationConfig, RefusesAConsoleThatOthersHearWithoutAListOfClients) {
    const std::string commented = "# host = \"127.0.0.1\"\n# port = 8470\n";
    for (const char* host : {"0.0.0.0", "::", "192.168.10.5"})
        expect_refused_once(read_changed(commented, "host = \"" + std::string{host} + "\"\n"),
                            "console.host: \"" + std::string{host} +
                                "\" accepts connections from other computers: list "
                                "those that may connect");
    expect_refused_once(
        read_changed(commented, "host = \"0.0.0.0\"\nallowed_clients = [\"office\"]\n"),
        "console.allowed_clients: \"office\" is no address");
    for (const char* right : {"host = \"0.0.0.0\"\nallowed_clients = [\"192.168.10.0/24\"]\n",
                              "host = \"0.0.0.0\"\nport = 0\n", "host = \"::1\"\n"})
        EXPECT_EQ(read_changed(commented, right).told, "") << right;
}

TEST(StationConfig, ACertificateGoesWithItsKeyAndBothAreWholePaths) {
    const std::string commented = "# certificate = \"/etc/axiscal/tls/fullchain.pem\"\n"
                                  "# key = \"/etc/axiscal/tls/key.pem\"\n";
    expect_refused_once(read_changed(commented, "certificate = \"/a.pem\"\n"),
                        "console.certificate: needs its key, too");
    expect_refused_once(read_changed(commented, "key = \"/a.key\"\n"),
                        "console.key: is of no use without its certificate");
    expect_refused_once(read_changed(commented, "certificate = \"/a.pem\"\nkey = \"a.key\"\n"),
                        "console.key: \"a.key\" is no whole path");
    const auto both = read_changed(commented, "certificate = \"/a.pem\"\nkey = \"/a.key\"\n");
    EXPECT_EQ(both.told, "");
    EXPECT_TRUE(both.config.console.speaks_tls());
    EXPECT_EQ(both.config.console.key_line, both.config.console.certificate_line + 1);
    EXPECT_FALSE(read_changed(commented, "").config.console.speaks_tls());
}

} // namespace
} // namespace axiscal::station_config_test
