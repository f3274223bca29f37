#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace axiscal::station_uncertainty_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::read_text;
using Reading = test::StationReading;

/// The example with its uncertainty table replaced.
Reading read_uncertainty_table(const std::string& table) {
    std::string text = example_text();
    const auto begin = text.find("[uncertainty]"), end = text.find("[certificate]");
    return read_text(text.replace(begin, end - begin, table + "\n"));
}

TEST(StationUncertainty, OfTheExampleMeansWhatItsWordsSay) {
    const Reading reading = read_text(example_text());
    ASSERT_TRUE(reading.config.uncertainty);
    const UncertaintySetup& setup = *reading.config.uncertainty;
    EXPECT_FALSE(setup.device_U.fixed);
    EXPECT_DOUBLE_EQ(setup.device_U.per_length.value().in(ppm), 0.7);
    EXPECT_EQ(setup.device_k, 2);
    EXPECT_FALSE(setup.device_width.stated());
    EXPECT_DOUBLE_EQ(setup.misalignment.value().in(mm), 1);
    EXPECT_DOUBLE_EQ(setup.temperature_width.value().in(kelvin), 0.7);
    EXPECT_FALSE(setup.expansion_width);
    EXPECT_DOUBLE_EQ(setup.eve.value().in(um), 1.7);
    EXPECT_EQ(setup.eve_model, EveModel::mean);
    ASSERT_EQ(setup.targets.size(), 3U);
    EXPECT_EQ(setup.targets[2].parameter, "R");
    EXPECT_DOUBLE_EQ(setup.targets[2].limit.in(um), 5);
}

TEST(StationUncertainty, IsAbsentWithoutItsTableAndEmptyWithAnEmptyOne) {
    const Reading without = read_uncertainty_table(""),
                  empty = read_uncertainty_table("[uncertainty]");
    EXPECT_EQ(without.told + empty.told, "");
    EXPECT_FALSE(without.config.uncertainty);
    ASSERT_TRUE(empty.config.uncertainty);
    EXPECT_FALSE(empty.config.uncertainty->device_U.stated());
    EXPECT_FALSE(empty.config.uncertainty->misalignment);
    EXPECT_FALSE(empty.config.uncertainty->temperature_width);
    EXPECT_FALSE(empty.config.uncertainty->eve);
}

TEST(StationUncertainty, ReadsTheOtherWaysToStateIt) {
    const Reading reading = read_uncertainty_table(
        "[uncertainty]\ndevice_width = \"0.5 um\"\nmisalignment_angle = \"36 arcsec\"\n"
        "expansion_width = \"2 um/(m*K)\"\neve_model = \"difference\"");
    EXPECT_EQ(reading.told, "");
    const UncertaintySetup& setup = reading.config.uncertainty.value();
    EXPECT_DOUBLE_EQ(setup.device_width.fixed.value().in(um), 0.5);
    EXPECT_FALSE(setup.device_width.per_length);
    EXPECT_DOUBLE_EQ(setup.misalignment_angle.value().in(arcsec), 36);
    EXPECT_FALSE(setup.misalignment);
    EXPECT_DOUBLE_EQ(setup.expansion_width.value().in(um_per_m_kelvin), 2);
    EXPECT_EQ(setup.eve_model, EveModel::difference);
}

TEST(StationUncertainty, PointsToADriftTest) {
    const Reading reading = read_uncertainty_table("[uncertainty]\neve_run = \"latest\"");
    EXPECT_EQ(reading.told, "");
    EXPECT_EQ(reading.config.eve_run, "latest");
    EXPECT_FALSE(reading.config.uncertainty.value().eve);
    EXPECT_EQ(read_text(example_text()).config.eve_run, "");
}

TEST(StationUncertainty, RefusesWhatContradictsItselfOrHasNoUnit) {
    const std::pair<const char*, const char*> cases[]{
        {"device = \"1 um\"\ndevice_width = \"1 um\"",
         "uncertainty.device_width: is given together with"},
        {"misalignment = \"1 mm\"\nmisalignment_angle = \"1 mrad\"",
         "uncertainty.misalignment_angle: is given together with"},
        {"eve = \"1 um\"\neve_run = \"latest\"", "uncertainty.eve_run: is given together with"},
        {"device_k = 3", "uncertainty.device_k: belongs to device"},
        {"device = 0.5", "uncertainty.device: is a bare number"},
        {"device = \"0.7 um/K\"", "\"um/K\" is no unit of a length or a length for each metre"},
        {"temperature_width = \"-0.7 K\"", "is out of range"},
        {"eve = \"2 mm\"", "is out of range"},
        {"eve_model = \"men\"", "did you mean \"mean\"?"},
        {"evee = \"1 um\"", "uncertainty.evee: is not a key of this table; did you mean \"eve\"?"},
        {"[uncertainty.target]\nU = \"1 um\"", "uncertainty.target.U: is not a key"}};
    for (const auto& [table, refusal] : cases)
        expect_refused_once(read_uncertainty_table("[uncertainty]\n" + std::string{table}),
                            refusal);
}

} // namespace
} // namespace axiscal::station_uncertainty_test
