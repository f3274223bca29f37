#include "tests/unit/config/station_text.hpp"

#include <chrono>
#include <gtest/gtest.h>
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

TEST(StationExample, ExplainsEveryKeyThatIsRead) {
    const auto explained = explained_keys(example_text());
    const auto asked = read_text(example_text()).asked;
    EXPECT_GT(asked.size(), 100U);
    for (const std::string& key : asked)
        EXPECT_TRUE(explained.contains(key)) << key << " is not in the example";
}

// Every commented-out key is a real one of its table: uncommented, it is at most out of place.
TEST(StationExample, OffersNoKeyThatDoesNotExist) {
    const std::string text = example_text();
    const auto asked = read_text(text).asked;
    const std::set<std::string> known{asked.begin(), asked.end()};
    for (const std::string& key : explained_keys(text)) {
        if (key.starts_with("instrument.") && !key.starts_with("instrument.channel")) continue;
        EXPECT_TRUE(known.contains(key)) << key << " is in the example, but nobody reads it";
    }
}

} // namespace
} // namespace axiscal::station_example_test
