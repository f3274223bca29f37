#include "tests/unit/config/station_text.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>

namespace axiscal::station_example_test {
namespace {

using test::example_text;
using test::explained_keys;
using test::read_text;
using Reading = test::StationReading;

TEST(StationExample, IsReadWithoutRefusalOrWarning) {
    const Reading reading = read_text(example_text());
    EXPECT_EQ(reading.told, "");
    EXPECT_TRUE(reading.config.warnings.empty());
}

TEST(StationExample, MeansWhatItsWordsSay) {
    using namespace std::chrono_literals;
    const StationConfig config = read_text(example_text()).config;
    EXPECT_EQ(config.station, "bay 3");
    EXPECT_EQ(config.state_directory, "/var/lib/axiscal");
    EXPECT_EQ(config.axis.name, "X");
    EXPECT_EQ(config.axis.program_axis, "X");
    EXPECT_EQ(config.axis.sign, 1);
    EXPECT_EQ(config.axis.laser.instrument, "laser");
    EXPECT_EQ(config.axis.laser.channel, "axis 1");
    EXPECT_DOUBLE_EQ(config.axis.dead_path.in(mm), 120);
    EXPECT_DOUBLE_EQ(config.axis.material.coefficient.in(um_per_m_kelvin), 11.5);
    EXPECT_EQ(config.axis.air.co2_ppm, 450);
    ASSERT_EQ(config.axis.material_temperature.size(), 2U);
    EXPECT_EQ(config.cycle.axis_kind, AxisKind::linear);
    EXPECT_EQ(config.cycle.target_count, 11);
    EXPECT_EQ(config.cycle.approaches, 5);
    EXPECT_DOUBLE_EQ(config.cycle.travel_high.in(mm), 1000);
    EXPECT_DOUBLE_EQ(config.cycle.overrun.in(mm), 2);
    EXPECT_DOUBLE_EQ(config.cycle.feed.in(mm_per_minute), 1000);
    EXPECT_EQ(config.cycle.dwell, 4s);
    EXPECT_EQ(config.capture.window, 500ms);
    EXPECT_DOUBLE_EQ(config.capture.slope_limit_um_per_s, 1);
    EXPECT_EQ(config.trigger.shape, TriggerShape::sequence_block);
    EXPECT_EQ(config.trigger.transport, TriggerTransport::tcp_server);
    EXPECT_EQ(config.trigger.port, 1502);
    EXPECT_EQ(config.console.port, 8470);
    EXPECT_EQ(config.statements.state, "as found");
    EXPECT_EQ(config.statements.axis, "X");
    EXPECT_EQ(config.statements.feed, "1000 mm/min");
    EXPECT_EQ(config.statements.dwell, "4 s");
    ASSERT_EQ(config.instruments.size(), 3U);
    EXPECT_EQ(config.instruments[1].driver, "dracal-vcp");
    ASSERT_EQ(config.instruments[1].channels.size(), 2U);
    EXPECT_DOUBLE_EQ(config.instruments[1].channels[0].correction, -0.03);
    EXPECT_EQ(config.instruments[1].channels[0].correction_unit, "degC");
    EXPECT_DOUBLE_EQ(config.instruments[1].channels[1].correction, 20);
    EXPECT_EQ(config.instruments[1].channels[1].correction_unit, "Pa");
    EXPECT_EQ(config.instruments[2].channels[0].medium, Medium::material);
}

void erase_between(std::string& text, const std::string& from, const std::string& to) {
    const auto begin = text.find(from);
    ASSERT_NE(begin, std::string::npos) << from;
    text.erase(begin, text.find(to, begin) - begin);
}

/// The example with its table [axis.scale] stated as it is offered, but for the channel's
/// instrument, and without what belongs to a laser.
std::string text_with_scale() {
    static const std::regex offered{"(^|\n)# (\\[|\\w+ = )"};
    std::string text = example_text();
    const auto begin = text.find("# [axis.scale]"), end = text.find("\n\n", begin);
    const std::string table = std::regex_replace(text.substr(begin, end - begin), offered, "$1$2");
    text.replace(begin, end - begin, table);
    const std::string channel = "\"scale/axis 1\"";
    text.replace(text.find(channel), channel.size(), "\"laser/axis 1\"");
    erase_between(text, "\nlaser = ", "\n#");
    erase_between(text, "\ndead_path = ", "\n#");
    erase_between(text, "\n[axis.air]\n", "\n[cycle]\n");
    return text;
}

TEST(StationExample, OffersALinearScaleThatIsReadAsItStandsThere) {
    const Reading reading = read_text(text_with_scale());
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.axis.scale);
    const ScaleConfig& scale = *reading.config.axis.scale;
    EXPECT_DOUBLE_EQ(scale.setup.coefficient.in(um_per_m_kelvin), 8.5);
    ASSERT_TRUE(scale.setup.temperature_width);
    EXPECT_DOUBLE_EQ(scale.setup.temperature_width->in(kelvin), 0.4);
    ASSERT_EQ(scale.temperature.size(), 1U);
    EXPECT_EQ(scale.temperature[0].channel, "contact 3");
}

/// What a scale or a rotary axis reads beyond the laser of the example; a polygon: StationAngle.
TEST(StationExample, AndTheRotaryOneExplainEveryKeyOfTheirVariants) {
    std::set<std::string> explained = explained_keys(example_text());
    explained.merge(explained_keys(example_text("rotary")));
    for (const std::string& text : {text_with_scale(), example_text("rotary")})
        for (const std::string& key : read_text(text).asked)
            EXPECT_TRUE(explained.contains(key)) << key << " is in no example";
}

TEST(StationExample, ExplainsEveryKeyThatIsRead) {
    const auto explained = explained_keys(example_text());
    const auto asked = read_text(example_text()).asked;
    EXPECT_GT(asked.size(), 100U);
    for (const std::string& key : asked)
        EXPECT_TRUE(explained.contains(key)) << key << " is not in the example";
}

std::set<std::string> asked_of_scale() {
    const auto asked = read_text(text_with_scale()).asked;
    return {asked.begin(), asked.end()};
}

// Every commented-out key is a real one of its table: uncommented, it is at most out of place.
TEST(StationExample, OffersNoKeyThatDoesNotExist) {
    const std::string text = example_text();
    const auto asked = read_text(text).asked;
    std::set<std::string> known{asked.begin(), asked.end()};
    known.merge(asked_of_scale());
    for (const std::string& key : explained_keys(text)) {
        if (key.starts_with("instrument.") && !key.starts_with("instrument.channel")) continue;
        EXPECT_TRUE(known.contains(key)) << key << " is in the example, but nobody reads it";
    }
}

} // namespace
} // namespace axiscal::station_example_test
