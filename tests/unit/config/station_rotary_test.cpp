#include "tests/unit/config/station_text.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::station_rotary_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::explained_keys;
using test::read_changed;
using test::read_text;
using Reading = test::StationReading;

/// The example as a rotary axis: every coordinate in degrees.
std::string rotary_text() {
    std::string text = example_text();
    const std::vector<std::pair<std::string, std::string>> changes{
        {"name = \"X\"\n", "name = \"C\"\n"},
        {"kind = \"linear\"", "kind = \"rotary\""},
        {"travel_low = \"0 mm\"", "travel_low = \"-5 deg\""},
        {"travel_high = \"1000 mm\"", "travel_high = \"365 deg\""},
        {"feedback_pitch = \"10 mm\"", "feedback_pitch = \"72 arcsec\""},
        {"interval = \"93 mm\"", "interval = \"30 deg\""},
        {"first_target = \"33 mm\"", "first_target = \"0 deg\""},
        {"overrun = \"2 mm\"", "overrun = \"1 deg\""},
        {"feed = \"1000 mm/min\"", "feed = \"360 deg/min\""},
        {"spread_limit = \"2 um\"", "spread_limit = \"0.5 arcsec\""},
        {"fastest = \"30 m/min\"", "fastest = \"90 deg/s\""}};
    for (const auto& [from, to] : changes)
        text.replace(text.find(from), from.size(), to);
    const auto erase = [&text](const std::string& from, const std::string& to) {
        const auto begin = text.find(from);
        text.erase(begin, text.find(to, begin) - begin);
    };
    erase("dead_path = ", "\n");                      // an angle has none
    erase("coefficient = \"11.5", "temperature = ["); // nor does it expand
    erase("[uncertainty]", "[certificate]");          // whose terms are those of a length
    const std::string cycle = "\n[cycle]\n";
    return text.insert(text.find(cycle), "\n[axis.angle]\nmethod = \"indexing-table\"\n"
                                         "step = \"1 deg\"\narm = \"32.61 mm\"\n");
}

TEST(StationConfig, ReadsARotaryAxisInDegrees) {
    const Reading reading = read_text(rotary_text());
    EXPECT_EQ(reading.told, "");
    EXPECT_EQ(reading.config.cycle.axis_kind, AxisKind::rotary);
    EXPECT_DOUBLE_EQ(reading.config.cycle.travel_high.in(mm), 365);
    EXPECT_DOUBLE_EQ(reading.config.cycle.feed.in(mm_per_minute), 360);
    ASSERT_TRUE(reading.config.cycle.feedback_pitch);
    EXPECT_DOUBLE_EQ(reading.config.cycle.feedback_pitch->in(mm), 0.02);
    EXPECT_EQ(reading.config.statements.feed, "360 deg/min");
}

TEST(StationConfig, RefusesTheBudgetOfALengthOnARotaryAxis) {
    expect_refused_once(read_text(rotary_text() + "\n[uncertainty]\neve = \"1 um\"\n"),
                        "\"um\" is no unit of an angle");
    expect_refused_once(read_text(rotary_text() + "\n[uncertainty]\nmisalignment = \"1 mm\"\n"),
                        "uncertainty.misalignment: is not a key of this table");
}

TEST(StationConfig, ReadsTheBudgetOfAnnexBInSecondsOfArc) {
    const Reading reading = read_text(rotary_text() + "\n[uncertainty]\ndevice = \"1.2 arcsec\"\n"
                                                      "eve = \"0.5 arcsec\"\n"
                                                      "[uncertainty.target]\nE = \"2 arcsec\"\n");
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.uncertainty);
    const UncertaintySetup& stated = *reading.config.uncertainty;
    EXPECT_NEAR(stated.device_U.fixed->in(mm)*3600, 1.2, 1e-12);
    EXPECT_NEAR(stated.eve->in(mm)*3600, 0.5, 1e-12);
    ASSERT_EQ(stated.targets.size(), 1U);
    EXPECT_NEAR(stated.targets[0].limit.in(mm)*3600, 2, 1e-12);
}

TEST(StationConfig, PointsToADriftTestOfARotaryAxis) {
    const std::string table = rotary_text() + "\n[uncertainty]\neve_run = \"latest\"\n";
    const Reading reading = read_text(table);
    EXPECT_EQ(reading.told, "");
    EXPECT_EQ(reading.config.eve_run, "latest");
    ASSERT_TRUE(reading.config.uncertainty);
    EXPECT_FALSE(reading.config.uncertainty->eve);
    expect_refused_once(read_text(table + "eve = \"1 arcsec\"\n"),
                        "uncertainty.eve_run: is given together with");
}

/// The rotary example with other lines in [axis.angle].
Reading read_angle_table(const std::string& lines, bool laser = true) {
    std::string text = rotary_text();
    const std::string head = "\n[axis.angle]\n";
    const auto begin = text.find(head) + head.size();
    text.replace(begin, text.find("\n[cycle]\n") - begin, lines);
    const std::string key = "laser = \"laser/axis 1\"\n";
    if (!laser) {
        text.erase(text.find(key), key.size());
        const auto air = text.find("\n[axis.air]\n");
        text.erase(air, text.find("\n[axis.angle]\n", air) - air);
    }
    return read_text(text);
}

/// The example of an indexing table as that of a polygon, with the keys that it offers for one.
std::string polygon_text() {
    std::string text = example_text("rotary");
    for (const std::string line :
         {"\nlaser = \"laser/axis 1\"", "\nstep = \"5 deg\"", "\narm = \"32.61 mm\""})
        text.erase(text.find(line), line.size());
    const std::vector<std::pair<std::string, std::string>> changes{
        {"\nmethod = \"indexing-table\"", "\nmethod = \"polygon\""},
        {"\n# faces = ", "\nfaces = "},
        {"\n# autocollimator = \"collimator/angle\"", "\nautocollimator = \"laser/axis 1\""}};
    for (const auto& [from, to] : changes)
        text.replace(text.find(from), from.size(), to);
    const auto air = text.find("\n[axis.air]\n");
    return text.erase(air, text.find("\n[cycle]\n", air) - air);
}

bool asks(const Reading& reading, const std::string& key) {
    return std::ranges::find(reading.asked, key) != reading.asked.end();
}

TEST(StationAngle, TheExampleExplainsEveryKeyOfAPolygon) {
    const Reading polygon = read_text(polygon_text());
    ASSERT_TRUE(polygon.config.axis.angle);
    EXPECT_EQ(polygon.config.axis.angle->setup.method, AngleMethod::polygon);
    EXPECT_TRUE(asks(polygon, "axis.angle.autocollimator"));
    std::set<std::string> explained = explained_keys(example_text("rotary"));
    explained.merge(explained_keys(example_text()));
    for (const std::string& key : polygon.asked)
        EXPECT_TRUE(explained.contains(key)) << key;
}

TEST(StationAngle, TheExampleIsReadAndExplainsEveryKeyOfTheAngle) {
    const std::string text = example_text("rotary");
    const Reading reading = read_text(text);
    EXPECT_EQ(reading.told, "");
    EXPECT_TRUE(reading.config.warnings.empty());
    EXPECT_EQ(reading.config.axis.angle->setup.run_out, "8 um at a radius of 100 mm");
    const Reading polygon = read_text(polygon_text());
    const auto explained = explained_keys(text);
    int keys = 0;
    for (const std::string& key : reading.asked)
        if (key.starts_with("axis.angle.")) {
            ++keys;
            EXPECT_TRUE(explained.contains(key)) << key;
        }
    EXPECT_GE(keys, 13);
    for (const std::string& key : explained)
        if (key.starts_with("axis.angle.")) {
            EXPECT_TRUE(asks(reading, key) || asks(polygon, key)) << key;
        }
}

TEST(StationAngle, ReadsAnIndexingTableWithItsPapers) {
    std::string list;
    for (int i = 0; i < 36; ++i)
        list += (i ? ", " : "") + std::string{"\"0."} + std::to_string(i % 10) + " arcsec\"";
    const Reading reading = read_angle_table(
        "method = \"indexing-table\"\nstep = \"10 deg\"\narm = \"32.61 mm\"\nrange = \"15 deg\"\n"
        "turn_time = \"6 s\"\nby_hand = true\nserial = \"T-7\"\n"
        "certificate_number = \"W-12\"\ndue_on = \"2027-01-31\"\n"
        "certificate_sense = \"against_axis\"\ndeviations = [" +
        list + "]\n");
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.axis.angle);
    const RotarySetup& setup = reading.config.axis.angle->setup;
    const InstrumentRecord& artefact = reading.config.axis.angle->artefact;
    EXPECT_EQ(setup.method, AngleMethod::indexing_table);
    EXPECT_DOUBLE_EQ(setup.step_deg, 10);
    EXPECT_DOUBLE_EQ(setup.arm.in(mm), 32.61);
    EXPECT_DOUBLE_EQ(setup.range_deg, 15);
    EXPECT_TRUE(setup.by_hand);
    EXPECT_FALSE(setup.certificate_with_axis);
    ASSERT_EQ(setup.deviations_arcsec.size(), 36U);
    EXPECT_NEAR(setup.deviations_arcsec[7], 0.7, 1e-12);
    EXPECT_EQ(artefact.name, "indexing table");
    EXPECT_EQ(artefact.certificate_number, "W-12");
    EXPECT_EQ(setup.run_out, "");
}

TEST(StationAngle, ReadsAPolygonWithoutALaser) {
    const Reading reading =
        read_angle_table("method = \"polygon\"\nfaces = 12\nrange = \"400 arcsec\"\n", false);
    EXPECT_EQ(reading.told, "");
    ASSERT_TRUE(reading.config.axis.angle);
    EXPECT_EQ(reading.config.axis.angle->setup.method, AngleMethod::polygon);
    EXPECT_DOUBLE_EQ(reading.config.axis.angle->setup.step_deg, 30);
}

TEST(StationAngle, NamesTheAutocollimatorOfAPolygonOnly) {
    const std::string key = "autocollimator = \"laser/axis 1\"\n"; // the channel is judged later
    const Reading read = read_angle_table("method = \"polygon\"\nfaces = 12\n" + key, false);
    EXPECT_EQ(read.told, "");
    ASSERT_TRUE(read.config.axis.angle);
    EXPECT_EQ(read.config.axis.angle->autocollimator.instrument, "laser");
    EXPECT_EQ(read.config.axis.angle->autocollimator.channel, "axis 1");
    const Reading typed = read_angle_table("method = \"polygon\"\nfaces = 12\n", false);
    EXPECT_EQ(typed.config.axis.angle->autocollimator.instrument, "");
    expect_refused_once(read_angle_table("method = \"indexing-table\"\nstep = \"5 deg\"\n"
                                         "arm = \"32.61 mm\"\n" +
                                         key),
                        "axis.angle.autocollimator: is not a key of this table");
    expect_refused_once(
        read_angle_table("method = \"polygon\"\nfaces = 12\nautocollimator = \"lase/angle\"\n",
                         false),
        "no [[instrument]] has the name \"lase\"");
}

TEST(StationAngle, RefusesADriftTestForTheBudgetBeforeAPolygon) {
    const std::string polygon = "method = \"polygon\"\nfaces = 12\n";
    const std::string budget = "\n[uncertainty]\neve_run = \"latest\"\n";
    expect_refused_once(read_angle_table(polygon + budget, false),
                        "uncertainty.eve_run: names a drift test, and before a polygon there is "
                        "none: state eve = ");
    EXPECT_EQ(read_angle_table(polygon + "\n[uncertainty]\neve = \"0.6 arcsec\"\n", false).told,
              "");
    expect_refused_once(read_angle_table(polygon + budget + "eve = \"0.6 arcsec\"\n", false),
                        "uncertainty.eve_run: is given together with");
}

TEST(StationAngle, TakesTheRunOutFromWhatPeopleState) {
    const Reading reading = read_text(std::regex_replace(
        rotary_text(), std::regex{"\\[certificate\\]\n"}, "[certificate]\nrun_out = \"8 um\"\n"));
    EXPECT_EQ(reading.told, "");
    EXPECT_EQ(reading.config.axis.angle->setup.run_out, "8 um");
    expect_refused_once(read_changed("\n[certificate]\n", "\n[certificate]\nrun_out = \"8 um\"\n"),
                        "certificate.run_out: is not a key"); // of a linear axis
}

TEST(StationAngle, RefusesWhatCannotBe) {
    const std::string table = "method = \"indexing-table\"\narm = \"32.61 mm\"\n";
    expect_refused_once(read_angle_table(table + "step = \"7 deg\"\n"), "does not divide a turn");
    expect_refused_once(read_angle_table(table + "step = \"8 deg\"\n"),
                        "is less than one and a half steps");
    expect_refused_once(read_angle_table(table + "step = \"5 deg\"\ndeviations = [\"0 arcsec\"]\n"
                                                 "certificate_sense = \"with_axis\"\n"),
                        "has 1 values, and the turn has 72 positions");
    expect_refused_once(read_angle_table("method = \"polygon\"\nfaces = 8\n"),
                        "is read by an autocollimator: remove axis.laser");
    expect_refused_once(read_angle_table(table + "step = \"1 deg\"\n", false),
                        "needs the angular interferometer");
}

TEST(StationAngle, ARotaryAxisNeedsAControlThatAsks) {
    std::string text = rotary_text();
    const auto begin = text.find("\n[trigger]\n"), end = text.find("\n[console]\n");
    text.replace(begin, end - begin,
                 "\n[trigger]\nshape = \"dwell\"\nwindow = \"0.2 deg\"\n"
                 "stability_range = \"2 arcsec\"\nhysteresis = \"0.1 deg\"\n");
    expect_refused_once(read_text(text), "a rotary axis needs a control that sends requests");
}

TEST(StationConfig, RefusesMillimetresOnARotaryAxis) {
    const std::string text =
        std::regex_replace(rotary_text(), std::regex{"overrun = \"1 deg\""}, "overrun = \"1 mm\"");
    expect_refused_once(read_text(text), "\"mm\" is no unit of an angle (this axis is rotary)");
}

TEST(StationConfig, RefusesDegreesOnALinearAxis) {
    expect_refused_once(read_changed("overrun = \"2 mm\"", "overrun = \"2 deg\""),
                        "\"deg\" is no unit of a length");
}

} // namespace
} // namespace axiscal::station_rotary_test
