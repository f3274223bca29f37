#include "config/certificate_dates.hpp"
#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <regex>
#include <string>
#include <utility>

namespace axiscal::channel_calibration_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::read_changed;
using test::read_text;
using Reading = test::StationReading;

TEST(StationExample, HoldsTheCertificatesOfItsChannels) {
    const StationConfig config = read_text(example_text()).config;
    const ChannelCalibration& air = config.instruments[1].channels[0].calibration;
    EXPECT_EQ(air.expanded_uncertainty, 0.1);
    EXPECT_EQ(air.coverage, 2);
    EXPECT_TRUE(air.corrections.empty());
    const ChannelConfig& screw = config.instruments[2].channels[0];
    ASSERT_EQ(screw.calibration.corrections.size(), 2U);
    EXPECT_DOUBLE_EQ(screw.calibration.corrections[1].reading, 25);
    EXPECT_DOUBLE_EQ(screw.calibration.corrections[1].correction, 0.04);
    EXPECT_EQ(screw.table_unit, "degC");
    EXPECT_EQ(screw.uncertainty_unit, "degC");
}

TEST(StationConfig, RefusesATableOfCorrectionsThatIsNone) {
    const std::string line = "reading = \"25 degC\"\n";
    expect_refused_once(read_changed(line, "reading = \"10 degC\"\n"),
                        "must be above that of the line before");
    expect_refused_once(read_changed(line, "reading = \"1013 hPa\"\n"),
                        "has a unit that does not belong to the reading's");
    expect_refused_once(read_changed("correction = \"0.04 K\"\n", "correction = \"-12 K\"\n"),
                        "makes a higher reading the lower value");
    const Reading none = read_changed("uncertainty = \"0.06 K\"\n", "uncertainty = \"0 K\"\n");
    expect_refused_once(none, "is 0: state the certificate's");
    EXPECT_TRUE(std::regex_search(none.told, std::regex{"^station\\.toml:[0-9]+: "})) << none.told;
    expect_refused_once(read_changed("uncertainty = \"0.06 K\"\n", "k = 3\n"),
                        "belongs to uncertainty");
    const std::string place = "place = \"nut side, left end\"\n";
    expect_refused_once(read_changed(place, place + "correction = \"0.05 K\"\n"),
                        "is given together with a table of corrections");
    expect_refused_once(read_changed(place, place + "calibrated_on = \"2026-01-02\"\n"
                                                    "due_on = \"2026-01-01\"\n"),
                        "is before calibrated_on");
}

TEST(StationConfig, ReadsATableOfLengths) {
    std::string text = example_text();
    for (const auto& [from, to] : {std::pair{"\"15 degC\"", "\"-0.5 mm\""},
                                   {"\"0.06 K\"\n\n[[", "\"-0.8 um\"\n\n[["},
                                   {"\"25 degC\"", "\"500 um\""},
                                   {"\"0.04 K\"", "\"250 nm\""}}) {
        const auto at = text.find(from, text.find("[[instrument.channel.correction_at]]"));
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, std::string{from}.size(), to);
    }
    const Reading reading = read_text(text);
    EXPECT_EQ(reading.told, "");
    const ChannelConfig& channel = reading.config.instruments[2].channels[0];
    EXPECT_EQ(channel.table_unit, "m");
    ASSERT_EQ(channel.calibration.corrections.size(), 2U);
    EXPECT_DOUBLE_EQ(channel.calibration.corrections[0].reading, -0.5e-3);
    EXPECT_DOUBLE_EQ(channel.calibration.corrections[0].correction, -0.8e-6);
    EXPECT_DOUBLE_EQ(channel.calibration.corrections[1].reading, 0.5e-3);
    EXPECT_DOUBLE_EQ(channel.calibration.corrections[1].correction, 0.25e-6);
    expect_refused_once(read_changed("correction = \"0.02 K\"", "correction = \"1.5 mm\""),
                        "is more than 1 mm");
}

TEST(CertificateDates, NameWhatHasExpiredWithItsLine) {
    const StationConfig config = read_text(example_text()).config;
    EXPECT_TRUE(expired_certificates(config, "2027-01-20").empty()); // the day itself is good
    const auto notes = expired_certificates(config, "2027-01-21");
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].reason.find("\"material\" was due on 2027-01-20"), std::string::npos);
    EXPECT_EQ(notes[0].line, config.instruments[2].line);
    EXPECT_EQ(expired_certificates(config, "2028-01-01").size(), 3U);
    const std::string place = "place = \"nut side, left end\"\n";
    const StationConfig own = read_changed(place, place + "due_on = \"2026-12-31\"\n").config;
    EXPECT_TRUE(expired_certificates(own, "2026-12-31").empty());
    const auto of_channel = expired_certificates(own, "2027-01-20");
    ASSERT_EQ(of_channel.size(), 1U);
    EXPECT_NE(of_channel[0].reason.find("material/contact 1"), std::string::npos);
}

TEST(StationConfig, RefusesACorrectionWithoutUnit) {
    expect_refused_once(
        read_changed("correction = \"-0.03 K\"", "correction = -0.03"),
        "instrument \"air\".channel \"air temperature\".correction: is a bare number");
}

} // namespace
} // namespace axiscal::channel_calibration_test
