// The whole station file against the instruments that it names.
#include "acquisition/station/station_loader.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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

/// The example with each piece of text exchanged for the one beside it.
std::string example_with_all(const std::vector<std::pair<std::string, std::string>>& changes) {
    std::string text = example_with("[station]", "[station]");
    for (const auto& [from, to] : changes) {
        EXPECT_NE(text.find(from), std::string::npos) << from;
        text.replace(text.find(from), from.size(), to);
    }
    return text;
}

const std::pair<std::string, std::string> four_targets{"target_count = 11", "target_count = 4"};
const std::string too_few = "the standard asks for at least 5";

/// Every mistake at once: a plan is judged although a key that it does not need is wrong.
TEST(StationLoader, TellsOfTooFewTargetsBesideOtherMistakes) {
    const std::string told = refusals_of(example_with_all(
        {four_targets, {"\nsign = 1\n", "\nsgin = 1\n"}, {"port = 1502", "port = 150200"}}));
    EXPECT_NE(told.find(too_few), std::string::npos) << told;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 4) << told; // sgin: no key; sign: missing
    EXPECT_LT(told.find(too_few), told.find("150200")) << told;       // by line
}

TEST(StationLoader, DoesNotJudgeTargetsByKeysThatCannotBeRead) {
    const std::vector<std::pair<std::string, std::string>> unread{
        {"overrun = \"2 mm\"", "overrun = \"2 s\""},
        {"travel_high = \"1000 mm\"", "travel_high = \"1000\""},
        {"feedback_pitch = \"10 mm\"", "feedback_pitch = 10"},
        {"kind = \"linear\"", "kind = \"linaer\""},
        {"interval = \"93 mm\"", "interval = \"93 mm\"\napproach = 5"}};
    for (const auto& change : unread) {
        const std::string told = refusals_of(example_with_all({four_targets, change}));
        EXPECT_EQ(told.find(too_few), std::string::npos) << told;
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
    }
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
