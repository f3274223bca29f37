#include "scenario.hpp"
#include "tests/support/source_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace axiscal::simulate::scenario_test {
namespace {

std::string refusal(const std::string& toml) {
    const auto scenario = parse_scenario(toml, true);
    return scenario ? "" : scenario.error().detail;
}

TEST(Scenario, EveryShippedFileIsRead) {
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(
             test::source_dir() + "/tools/axiscal-simulate/scenarios")) {
        const auto scenario = read_scenario(entry.path().string());
        EXPECT_TRUE(scenario) << entry.path() << (scenario ? "" : scenario.error().detail);
        ++read;
    }
    EXPECT_GE(read, 4);
}

TEST(Scenario, RefusesAPrismBeforeAnythingButAUmd) {
    const std::string prism = "[straightness]\nfactor = 36\n";
    EXPECT_EQ(refusal(prism), "");
    EXPECT_NE(refusal(prism + "[laser]\nkind = \"hpi-3d\"\n").find("straightness needs the laser"),
              std::string::npos);
    EXPECT_NE(refusal(prism + "[indexing_table]\n").find("straightness needs an axis"),
              std::string::npos);
    EXPECT_NE(refusal("[straightness]\nfactor = 0\n").find("straightness.factor must be above 0"),
              std::string::npos);
}

TEST(Scenario, RefusesAnOpticalSquareWithoutItsPrism) {
    const std::string square = "[squareness]\naxes_um_per_m = 25\nsquare_turned = true\n";
    EXPECT_EQ(refusal(square + "[straightness]\nfactor = 36\n"), "");
    EXPECT_NE(refusal(square).find("squareness needs [straightness]"), std::string::npos);
    EXPECT_NE(refusal("[straightness]\n[squareness]\nturned = true\n")
                  .find("squareness.turned is not a known key"),
              std::string::npos);
}

TEST(Scenario, ReadsTomlAndJsonAlike) {
    const auto toml = parse_scenario("seed = 7\n[errors]\nreversal_um = -3.5\n", true);
    const auto json = parse_scenario(R"({"seed":7,"errors":{"reversal_um":-3.5}})", false);
    ASSERT_TRUE(toml && json);
    EXPECT_EQ(toml->seed, json->seed);
    EXPECT_EQ(toml->errors.reversal_um, json->errors.reversal_um);
}

TEST(Scenario, RefusesAllAtOnceByName) {
    const std::string reasons = refusal("[errors]\nreversal = 3\nnoise_um = \"much\"\n"
                                        "[laser]\nkind = \"xl\"\n[[sensor]]\nkind = \"comet\"\n");
    for (const char* part :
         {"errors.reversal is not a known key", "errors.noise_um has the wrong type",
          "laser.kind is one of", "sensor[0].name is missing"})
        EXPECT_NE(reasons.find(part), std::string::npos) << part << " in " << reasons;
}

TEST(Scenario, RefusesAContrastThatNoWireTells) {
    const std::string reasons = refusal("[laser]\nkind = \"umd0\"\nbeam_radius_mm = 2.0\n");
    EXPECT_NE(reasons.find("laser.beam_radius_mm needs ids3010"), std::string::npos) << reasons;
    EXPECT_EQ(refusal("[laser]\nkind = \"ids3010\"\nbeam_radius_mm = 2.0\n"
                      "beam_tilt_mrad = -3.0\ncontrast_percent = 70.0\n"),
              "");
}

TEST(Scenario, RefusesTextThatIsNoToml) {
    EXPECT_NE(refusal("[errors\n"), "");
}

} // namespace
} // namespace axiscal::simulate::scenario_test
