// [tolerances] of the station file.

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/config/station_text.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace axiscal::station_tolerances_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::read_text;
using Reading = test::StationReading;

/// The example with this table before the certificate's.
std::string with_table(const std::string& table, const std::string& example = "station") {
    std::string text = example_text(example);
    return text.insert(text.find("[certificate]"), table + "\n");
}

const std::string agreed = R"([tolerances]
name = "agreed limits"
source = "order 17"
rule = "guard-U"
limits = [
  { parameter = "A", travel_up_to = "500 mm", limit = "20 um" },
  { parameter = "A", limit = "0.03 mm" },
  { parameter = "G_b", limit = "12 um" },
  { parameter = "E_VE", limit = "3 um" },
  { parameter = "E_TD,X", limit = "2 um" },
])";

TEST(StationTolerances, MeanWhatTheirWordsSay) {
    const Reading reading = read_text(with_table(agreed));
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.tolerances);
    const ToleranceRecord& set = *reading.config.tolerances;
    EXPECT_EQ(set.name, "agreed limits");
    EXPECT_EQ(set.source, "order 17");
    EXPECT_EQ(set.rule, DecisionRule::guard_U);
    EXPECT_FALSE(set.to_be_checked);
    ASSERT_EQ(set.limits.size(), 5U);
    EXPECT_EQ(set.limits[0].travel_up_to, 500);
    EXPECT_EQ(set.limits[0].limit, 20);
    EXPECT_FALSE(set.limits[1].travel_up_to);
    EXPECT_EQ(set.limits[1].limit, 30);
}

// 3 arcsec are 3 pi / 648000 = 14.544410433 um over a metre.
TEST(StationTolerances, OfASquarenessAreAngles) {
    const auto limit_of = [](const std::string& limit) {
        return read_text(with_table("[tolerances]\nsource = \"order 17\"\nrule = \"simple\"\n"
                                    "limits = [{ parameter = \"squareness_least_squares\", "
                                    "limit = \"" +
                                    limit + "\" }]"));
    };
    EXPECT_EQ(limit_of("20 um/m").config.tolerances.value().limits.at(0).limit, 20);
    EXPECT_EQ(limit_of("15 urad").config.tolerances.value().limits.at(0).limit, 15);
    EXPECT_NEAR(limit_of("3 arcsec").config.tolerances.value().limits.at(0).limit, 14.544410433,
                1e-9);
    EXPECT_NE(limit_of("15 um").told.find("limit"), std::string::npos);
}

TEST(StationTolerances, EachKindOfTestTakesItsOwn) {
    const ToleranceRecord set = read_text(with_table(agreed)).config.tolerances.value();
    const auto names = [&](TestKind kind) {
        std::string all;
        if (const auto own = limits_of_kind(set, kind, false))
            for (const ToleranceLimit& limit : own->limits)
                all += limit.parameter + " ";
        return all;
    };
    EXPECT_EQ(names(TestKind::positioning), "A A ");
    EXPECT_EQ(names(TestKind::circular), "G_b ");
    EXPECT_EQ(names(TestKind::drift), "E_VE ");
    EXPECT_EQ(names(TestKind::probing), "E_TD,X ");
    ToleranceRecord circles_alone = set;
    circles_alone.limits = {{"G_b", {}, 12}};
    EXPECT_FALSE(limits_of_kind(circles_alone, TestKind::positioning, false));
}

TEST(StationTolerances, OfARotaryAxisAreAngles) {
    const Reading reading = read_text(with_table(
        R"([tolerances]
source = "order 17"
rule = "14253-1:2017"
limits = [{ parameter = "A", travel_up_to = "360 deg", limit = "12 arcsec" }, { parameter = "R", limit = "0.001 deg" }])",
        "rotary"));
    EXPECT_EQ(reading.told, "");
    const auto& limits = reading.config.tolerances.value().limits;
    EXPECT_EQ(limits[0].limit, 12);
    EXPECT_EQ(limits[0].travel_up_to, 360);
    EXPECT_EQ(limits[1].limit, 3.6);
}

TEST(StationTolerances, WithoutARuleAreAllowedWithAWarning) {
    const Reading reading = read_text(with_table(
        "[tolerances]\nsource = \"order 17\"\nlimits = [{ parameter = \"A\", limit = \"9 um\" }]"));
    EXPECT_EQ(reading.told, "");
    EXPECT_EQ(reading.config.tolerances.value().rule, DecisionRule::none);
    const auto& warnings = reading.config.warnings;
    EXPECT_EQ(std::ranges::count(warnings, "tolerances.rule", &Refusal::key), 1);
}

TEST(StationTolerances, AreAbsentWithoutTheirTable) {
    EXPECT_FALSE(read_text(example_text()).config.tolerances);
}

TEST(StationTolerances, MayStandInAFileOfTheirOwn) {
    const testing::ScratchFolder folder;
    const std::string path = folder.file("limits.toml");
    std::ofstream{path} << "source = \"data sheet\"\nlimits = [{ parameter = \"A\", limit = \"9 "
                           "um\" }]\n";
    const std::string file = "[tolerances]\nfile = \"" + path + "\"\n";
    const Reading reading = read_text(with_table(file + "rule = \"simple\""));
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.tolerances);
    EXPECT_EQ(reading.config.tolerances->source, "data sheet");
    EXPECT_EQ(reading.config.tolerances->name, "limits of " + path);
    EXPECT_EQ(reading.config.tolerances->rule, DecisionRule::simple);
    EXPECT_EQ(reading.config.tolerances->limits.at(0).limit, 9);

    std::ofstream{path, std::ios::app} << "rule = \"guard-U\"\n";
    EXPECT_EQ(read_text(with_table(file)).config.tolerances->rule, DecisionRule::guard_U);
    const auto refuses = [](const std::string& told, const std::string& words) {
        EXPECT_NE(told.find(words), std::string::npos) << told;
    };
    refuses(read_text(with_table(file + "rule = \"simple\"")).told, "is another one in " + path);
    refuses(read_text(with_table(file + "source = \"x\"")).told, "given together with file");
    refuses(read_text(with_table("[tolerances]\nfile = \"limits.toml\"")).told, "tolerances.file");
    std::ofstream{path, std::ios::app} << "limit = 3\n";
    refuses(read_text(with_table(file)).told, path + ":4: limit");
}

std::string refused(const std::string& table) {
    return read_text(with_table("[tolerances]\n" + table)).told;
}

TEST(StationTolerances, RefuseWhatNobodyCouldDecideBy) {
    const std::string rest = "source = \"order 17\"\nrule = \"guard-U\"\n";
    const auto has = [](const std::string& told, const std::string& words) {
        EXPECT_NE(told.find(words), std::string::npos) << told;
        EXPECT_EQ(std::ranges::count(told, '\n'), 1) << told;
    };
    has(refused(rest + "limits = []"), "tolerances.limits: is empty");
    has(refused(rest), "tolerances.limits: is empty");
    has(refused("rule = \"guard-U\"\nlimits = [{ parameter = \"A\", limit = \"9 um\" }]"),
        "tolerances.source: is missing");
    has(refused(rest + "limits = [{ parameter = \"Q\", limit = \"9 um\" }]"), "parameter");
    has(refused(rest + "limits = [{ parameter = \"A\", limit = 9 }]"), "limit");
    has(refused(rest + "limits = [{ parameter = \"A\", limit = \"9 um\" }, { parameter = \"A\", "
                       "limit = \"8 um\" }]"),
        "stands there twice");
    has(refused(rest +
                "limits = [{ parameter = \"G_b\", travel_up_to = \"1 m\", limit = \"9 um\" }]"),
        "G_b has no travel");
    has(refused("source = \"order 17\"\nrule = \"mine\"\n"
                "limits = [{ parameter = \"A\", limit = \"9 um\" }]"),
        "14253-1:2017");
}

} // namespace
} // namespace axiscal::station_tolerances_test
