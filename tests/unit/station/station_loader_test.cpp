// The whole station file against the instruments that it names.
#include "acquisition/station/station_loader.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace axiscal::station_loader_test {
namespace {

const std::string config_folder = test::source_dir() + "/config";

std::string example_with(const std::string& from, const std::string& to) {
    std::ifstream file{config_folder + "/station.example.toml"};
    std::stringstream stream;
    stream << file.rdbuf();
    std::string text = stream.str();
    text.replace(text.find(from), from.size(), to);
    return text;
}

std::string refusals_of(const std::string& text) {
    setenv("AXISCAL_PROFILE_PATH", (config_folder + "/profiles").c_str(), 1);
    const testing::ScratchFolder scratch;
    const std::string path = scratch.path() + "/station.toml";
    std::ofstream{path} << text;
    const auto loaded = load_station(path);
    std::string told;
    if (!loaded)
        for (const Refusal& refusal : loaded.error())
            told += refusal.describe() + "\n";
    return told;
}

TEST(StationLoader, AcceptsTheExample) {
    EXPECT_EQ(refusals_of(example_with("[station]", "[station]")), "");
}

TEST(StationLoader, SaysOnceWhereAFileIsThatCannotBeReadOrParsed) {
    const auto absent = load_station("/nonexistent/station.toml");
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().front().describe().find("/nonexistent/station.toml: the file"), 0U);
    const std::string told = refusals_of("a = 1\na = 2\n");
    EXPECT_NE(told.find("station.toml:2:"), std::string::npos) << told;
    EXPECT_EQ(told.find("station.toml"), told.rfind("station.toml")) << told;
}

/// A scale's lengths would be divided by the index of air.
TEST(StationLoader, RefusesAScaleInPlaceOfTheLaser) {
    std::string text = example_with("[station]", "[station]");
    const auto begin = text.find("driver = \"umd\"");
    const auto end = text.find("[[instrument]]", begin);
    text.replace(begin, end - begin,
                 "driver = \"counter\"\ndevice = \"/dev/counter0\"\nevent = \"index\"\nbits = 32\n"
                 "resolution = \"0.1 um\"\nfastest = \"30 m/min\"\n\n");
    const std::string told = refusals_of(text);
    EXPECT_NE(told.find("axis.laser"), std::string::npos) << told;
    EXPECT_NE(told.find("gives true lengths"), std::string::npos) << told;
    EXPECT_NE(told.find("[axis.scale]"), std::string::npos) << told;
}

/// The example with [axis.scale] in the place of laser, beam and air.
std::string example_by_scale() {
    std::string text = example_with("laser = \"laser/axis 1\"\n", "");
    const auto erase = [&text](const std::string& from, const std::string& to) {
        const auto begin = text.find(from) + 1;
        text.erase(begin, text.find(to, begin) - begin + 1);
    };
    erase("\ndead_path = ", "\n");
    erase("\n[axis.air]\n", "\n[cycle]\n");
    const std::string list = "[\"material/contact 1\", \"material/contact 2\"]";
    text.replace(text.find(list), list.size(), "[\"material/contact 1\"]");
    return text.insert(text.find("\n[cycle]\n"), "\n[axis.scale]\nchannel = \"laser/axis 1\"\n"
                                                 "coefficient = \"8.5 um/(m*K)\"\n"
                                                 "temperature = [\"material/contact 2\"]\n");
}

TEST(StationLoader, TakesAScaleThatStatesItsResolution) {
    std::string text = example_by_scale();
    const std::string laser = "wavelength = \"632.991354 nm\"", fold = "fold = \"corner cube\"\n";
    text.replace(text.find(laser), laser.size(), "resolution = \"5 um\"");
    text.erase(text.find(fold), fold.size());
    EXPECT_EQ(refusals_of(text), "");
}

/// A laser's wavelengths would stand for lengths.
TEST(StationLoader, RefusesALaserInPlaceOfTheScale) {
    const std::string told = refusals_of(example_by_scale());
    EXPECT_NE(told.find("axis.scale.channel"), std::string::npos) << told;
    EXPECT_NE(told.find("states no resolution"), std::string::npos) << told;
}

} // namespace
} // namespace axiscal::station_loader_test
