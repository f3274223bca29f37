#include "tests/unit/config/station_text.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace axiscal::station_environment_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::read_changed;
using test::read_text;
using Reading = test::StationReading;

/// The example with these lines in [environment].
Reading read_environment_table(const std::string& lines) {
    return read_changed("\n[environment]\n", "\n[environment]\n" + lines + "\n");
}

TEST(StationEnvironment, AsksForNothingThatIsNotStated) {
    const Reading without = read_changed("\n[environment]\n", "\n");
    EXPECT_EQ(without.told, "");
    EXPECT_FALSE(without.config.environment.stated());
    EXPECT_FALSE(read_text(example_text()).config.environment.stated());
}

TEST(StationEnvironment, ReadsLimitsAndChangesInTheUnitsOfTheReadings) {
    const Reading reading = read_environment_table(
        "air_low = \"18 degC\"\nair_high = \"298.15 K\"\nair_change_per_hour = \"1.5 K\"\n"
        "pressure_high = \"1030 hPa\"\npressure_change_per_hour = \"5 hPa\"\n"
        "humidity_low = \"20 %\"\nmaterial_change_per_hour = \"0.5 K\"\nchange_window = \"20 "
        "min\"");
    EXPECT_EQ(reading.told, "");
    const EnvironmentLimits& limits = reading.config.environment;
    EXPECT_DOUBLE_EQ(limits.air_temperature.low.value(), 18);
    EXPECT_NEAR(limits.air_temperature.high.value(), 25, 1e-9);
    EXPECT_DOUBLE_EQ(limits.air_temperature.change_per_hour.value(), 1.5);
    EXPECT_DOUBLE_EQ(limits.air_pressure.high.value(), 103'000);
    EXPECT_DOUBLE_EQ(limits.air_pressure.change_per_hour.value(), 500);
    EXPECT_FALSE(limits.air_pressure.low);
    EXPECT_DOUBLE_EQ(limits.air_humidity.low.value(), 20);
    EXPECT_FALSE(limits.material_temperature.low || limits.material_temperature.high);
    EXPECT_DOUBLE_EQ(limits.material_temperature.change_per_hour.value(), 0.5);
    EXPECT_EQ(limits.change_window, std::chrono::minutes{20});
    EXPECT_TRUE(limits.stated() && limits.asks_for_change());
}

TEST(StationEnvironment, RefusesLimitsThatNothingLiesBetween) {
    const std::pair<const char*, const char*> cases[]{
        {"air_low = \"25 degC\"\nair_high = \"18 degC\"",
         "environment.air_high: does not lie above air_low"},
        {"material_high = 25", "environment.material_high: is a bare number"},
        {"humidity_high = \"120 %\"", "is out of range"},
        {"pressure_hihg = \"1030 hPa\"", "did you mean \"pressure_high\"?"}};
    for (const auto& [lines, refusal] : cases)
        expect_refused_once(read_environment_table(lines), refusal);
}

} // namespace
} // namespace axiscal::station_environment_test
