#include "drivers/registry.hpp"
#include "tests/support/made_instrument.hpp"

#include <gtest/gtest.h>

namespace axiscal::registry_test {
namespace {

const std::string umd_keys = "link = \"serial:/dev/ttyACM0\"\nwavelength = \"632.991 nm\"\n"
                             "fold = \"corner cube\"\nfastest = \"30000 mm/min\"\n";

std::string all_refusals(const testing::MadeInstrument& made) {
    std::string text;
    for (const Refusal& refusal : made.refusals)
        text += refusal.describe() + "\n";
    return text;
}

TEST(Registry, FindsEveryDriverByItsName) {
    for (const InstrumentDriver& driver : instrument_drivers())
        EXPECT_EQ(find_driver(driver.name).value(), &driver);
}

TEST(Registry, OffersTheNearestName) {
    const auto missing = find_driver("dracal");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().fault, Fault::unknown_instrument);
    EXPECT_NE(missing.error().detail.find("did you mean \"dracal-vcp\""), std::string::npos);
    EXPECT_EQ(find_driver("spectrometer").error().detail.find("did you mean"), std::string::npos);
}

TEST(Registry, RefusesAnUnknownDriverInTheStationFile) {
    const auto made = testing::make_instrument("umd2", "driver = \"umd2\"\n");
    EXPECT_EQ(made.instrument, nullptr);
    EXPECT_NE(all_refusals(made).find("did you mean \"umd\""), std::string::npos);
}

TEST(Registry, SaysNothingOfTheKeysOfADriverThatItDoesNotKnow) {
    const auto made = testing::make_instrument("udm", "driver = \"udm\"\n" + umd_keys);
    ASSERT_EQ(made.refusals.size(), 1U) << all_refusals(made);
    EXPECT_EQ(made.refusals.front().key, "driver");
    EXPECT_NE(made.refusals.front().reason.find("did you mean \"umd\""), std::string::npos);
}

TEST(Registry, JudgesTheKeysOfASerialLineBesideALinkThatItCannotRead) {
    const std::string link = "link = \"serial:/dev/ttyACM0\"\n";
    for (const char* wrong : {"link = \"seriel:/dev/ttyACM0\"\n", "link = 5\n", ""}) {
        const std::string keys = wrong + umd_keys.substr(link.size());
        const auto right =
            testing::make_instrument("umd", keys + "baud = 9600\nparity = \"even\"\n");
        ASSERT_EQ(right.refusals.size(), 1U) << all_refusals(right);
        EXPECT_EQ(right.refusals.front().key, "link");
        const auto both = testing::make_instrument("umd", keys + "baud = 1\n");
        EXPECT_EQ(both.refusals.size(), 2U) << all_refusals(both);
    }
}

TEST(Registry, SaysNothingOfTheChannelsUnitsOrInputsOfAModelThatItDoesNotKnow) {
    InstrumentConfig config;
    config.channels.push_back({});
    config.channels.back().channel = "angle";
    const auto made = testing::make_instrument(
        "ascii-gauge",
        "link = \"serial:/dev/ttyUSB0\"\nmodel = \"elcomat\"\nunit = \"arcsec\"\ninput = 2\n",
        config);
    ASSERT_EQ(made.refusals.size(), 1U) << all_refusals(made);
    EXPECT_EQ(made.refusals.front().key, "model");
}

TEST(Registry, MakesALaserWithItsOptics) {
    const auto made = testing::make_instrument("umd", umd_keys);
    EXPECT_EQ(all_refusals(made), "");
    ASSERT_TRUE(made.instrument->optics());
    EXPECT_DOUBLE_EQ(made.instrument->optics()->vacuum_wavelength.in(nm), 632.991);
    EXPECT_EQ(made.instrument->optics()->optical_fold, 2);
    EXPECT_FALSE(made.instrument->resolution());
    EXPECT_EQ(made.instrument->channels().front().name, "axis 1");
}

TEST(Registry, MakesAUmdOnAScaleWithoutOpticsWhoseZeroHoldsOnlyWhileItCounts) {
    const auto made = testing::make_instrument(
        "umd", "link = \"serial:/dev/ttyACM0\"\nresolution = \"0.1 um\"\nfastest = \"30 m/min\"\n");
    EXPECT_EQ(all_refusals(made), "");
    EXPECT_FALSE(made.instrument->optics());
    ASSERT_TRUE(made.instrument->resolution());
    EXPECT_DOUBLE_EQ(made.instrument->resolution()->in(um), 0.1);
    EXPECT_TRUE(made.instrument->incremental());
    EXPECT_EQ(made.instrument->channels().front().name, "axis 1");
}

TEST(Registry, RefusesAUmdThatIsScaleAndLaserOrNeither) {
    const std::string both = all_refusals(testing::make_instrument(
        "umd", umd_keys + "resolution = \"0.1 um\"\ncounts_per_cycle = 4\nphase = \"none\"\n"));
    for (const char* key : {"wavelength", "fold", "counts_per_cycle", "phase"})
        EXPECT_NE(both.find(std::string{key} + ": belongs to a laser"), std::string::npos)
            << key << "\n"
            << both;
    const std::string neither = all_refusals(testing::make_instrument(
        "umd", "link = \"serial:/dev/ttyACM0\"\nfold = \"corner cube\"\nfastest = \"1 m/s\"\n"));
    EXPECT_NE(neither.find("or resolution (length of one count) for a scale"), std::string::npos)
        << neither;
}

TEST(Registry, RefusesWrongDriverKeysAllAtOnce) {
    const auto made =
        testing::make_instrument("umd", "link = \"usb:1\"\nwavelength = \"633\"\nfold = "
                                        "\"corner\"\naxis = 4\nspeed = 1\nfastest = \"30\"\n");
    const std::string text = all_refusals(made);
    for (const char* key : {"link", "wavelength", "fold", "axis", "fastest", "speed"})
        EXPECT_NE(text.find(key), std::string::npos) << key << "\n" << text;
}

TEST(Registry, RefusesAChannelThatTheInstrumentDoesNotHave) {
    InstrumentConfig config;
    config.channels.push_back({});
    config.channels.back().channel = "axis 2";
    const auto made = testing::make_instrument("umd", umd_keys, config);
    for (const char* part : {"it has axis 1, ", "; did you mean \"axis 1\"?"})
        EXPECT_NE(all_refusals(made).find(part), std::string::npos) << all_refusals(made);
}

TEST(Registry, RefusesACorrectionInAnotherUnitThanTheChannels) {
    InstrumentConfig config;
    config.channels.push_back({});
    config.channels.back().channel = "air temperature";
    config.channels.back().correction = 20;
    config.channels.back().correction_unit = "Pa";
    const auto made =
        testing::make_instrument("dracal-vcp", "link = \"serial:/dev/ttyACM1\"\n", config);
    EXPECT_NE(all_refusals(made).find("counts in degC"), std::string::npos) << all_refusals(made);
}

TEST(Registry, RefusesAnAirChannelAsMaterial) {
    InstrumentConfig config;
    config.channels.push_back({});
    config.channels.back().channel = "air temperature";
    config.channels.back().medium = Medium::material;
    const auto made =
        testing::make_instrument("dracal-vcp", "link = \"serial:/dev/ttyACM1\"\n", config);
    EXPECT_NE(all_refusals(made).find("measures air, not material"), std::string::npos)
        << all_refusals(made);
}

} // namespace
} // namespace axiscal::registry_test
