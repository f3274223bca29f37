#include "tools/axiscal/imports/import_map.hpp"
#include "tools/axiscal/imports/readings_case.hpp"
#include "tools/axiscal/imports/stream_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace axiscal::stream_file_test {
namespace {

using Json = nlohmann::json;

const std::string map_text = R"(kind = "stream"
unit = "mm"
[reading]
signal = "IOC:ILD"
take = "last"
[target]
signal = "AXIS:Cmd"
[capture]
signal = "IOC:Test"
digits = "dcp"
forward = 1
backward = 2
)";

ImportMap map_of(const std::string& text) {
    auto map = import_map(text, "map.toml");
    EXPECT_TRUE(map) << (map ? "" : describe(map.error()));
    return map.value_or(ImportMap{});
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

/// Grows by tenths of a second, as a stream is logged.
class Log {
public:
    Log& add(const std::string& name, const std::string& value) {
        char time[48];
        std::snprintf(time, sizeof time, "2026-04-06 12:%02d:%02d.%06d", at_ / 600, at_ / 10 % 60,
                      at_ % 10 * 100'000);
        text_ += name + "  " + time + " " + value + "\n";
        ++at_;
        return *this;
    }
    Log& point(const std::string& target, const std::string& reading, const std::string& number) {
        return add("AXIS:Cmd", target)
            .add("IOC:ILD", "99")
            .add("IOC:ILD", reading)
            .add("IOC:Test", number);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    int at_ = 0;
    std::string text_;
};

/// Two cycles over three targets.
std::string stream() {
    Log log;
    log.add("IOC:Test", "0").add("AXIS:Act", "0 LOLO MAJOR");
    log.point("-20", "-20.001", "111").point("0", "0.002", "112").point("20", "20.003", "113");
    log.point("20", "20.007", "213").point("0", "0.006", "212").point("-20", "-19.995", "211");
    log.point("-20", "-20.002", "121").point("0", "0.003", "122").point("20", "20.004", "123");
    log.point("20", "20.008", "223").point("0", "0.007", "222").point("-20", "-19.994", "221");
    return log.add("IOC:Test", "0").add("IOC:ILD", "1234").text();
}

Json case_of(const std::string& text, const ImportMap& map) {
    auto read = read_stream(text, map);
    EXPECT_TRUE(read) << (read ? "" : describe(read.error()));
    if (!read) return {};
    const auto made = case_of_readings(*read);
    EXPECT_TRUE(made) << (made ? "" : describe(made.error()));
    return made.value_or(Json{});
}

void expect_refused(const std::string& text,
                    const ImportMap& map,
                    const std::string& field,
                    const std::string& words) {
    auto read = read_stream(text, map);
    Error error;
    if (!read)
        error = read.error();
    else if (const auto made = case_of_readings(*read); !made)
        error = made.error();
    EXPECT_EQ(error.field, field) << describe(error);
    EXPECT_NE(error.detail.find(words), std::string::npos) << describe(error);
}

TEST(StreamFile, GivesTheLastValueBeforeEachCapture) {
    EXPECT_TRUE(is_stream(stream()));
    const Json made = case_of(stream(), map_of(map_text));
    EXPECT_EQ(made.at("targets"), Json({-20.0, 0.0, 20.0}));
    EXPECT_EQ(made.at("forward"), Json({{-20.001, -20.002}, {0.002, 0.003}, {20.003, 20.004}}));
    EXPECT_EQ(made.at("backward"), Json({{-19.995, -19.994}, {0.006, 0.007}, {20.007, 20.008}}));
    EXPECT_EQ(made.at("readings"), "positions");
    EXPECT_EQ(made.at("unit"), "mm");
    EXPECT_EQ(made.at("note"), "imported, readings by others");
}

// Each point lasts 0.4 s: 99 and the reading came 0.2 s and 0.1 s before its capture.
TEST(StreamFile, GivesTheMeanOfTheWindowAndTheScaleThatTheMapStates) {
    const std::string mean =
        replaced(map_text, "take = \"last\"",
                 "take = \"mean\"\nbefore = \"0.2 s\"\nscale = -2\noffset = 0.5");
    const Json made = case_of(stream(), map_of(mean));
    EXPECT_DOUBLE_EQ(made.at("forward").at(1).at(0), ((-2 * 99 + 0.5) + (-2 * 0.002 + 0.5)) / 2);
    const std::string later = replaced(map_text, "take = \"last\"",
                                       "take = \"mean\"\nbefore = \"0.1 s\"\nafter = \"0.2 s\"");
    EXPECT_DOUBLE_EQ(case_of(stream(), map_of(later)).at("forward").at(1).at(0), (0.002 + 99) / 2);
}

TEST(StreamFile, TakesTheTargetsFromTheMapWhereTheStreamDoesNotHoldThem) {
    const std::string places =
        replaced(map_text, "signal = \"AXIS:Cmd\"", "places = [\"-20 mm\", \"0 mm\", \"20 mm\"]");
    EXPECT_EQ(case_of(stream(), map_of(places)), case_of(stream(), map_of(map_text)));
    expect_refused(replaced(stream(), " 113\n", " 114\n"), map_of(places), "line 14",
                   "none from 1 to 3");
}

TEST(StreamFile, WithoutMeaningOfTheNumbersGoesByTheOrderOfTheTargets) {
    const std::string mute =
        replaced(map_text, "digits = \"dcp\"\nforward = 1\nbackward = 2\n", "");
    EXPECT_EQ(case_of(stream(), map_of(mute)), case_of(stream(), map_of(map_text)));
}

TEST(StreamFile, WhoseNumbersCallTheDirectionsTheOtherWayRoundGoesByTheTargetsAndSaysSo) {
    std::string exchanged = replaced(map_text, "forward = 1", "forward = 2");
    exchanged = replaced(exchanged, "backward = 2", "backward = 1");
    const Json made = case_of(stream(), map_of(exchanged));
    EXPECT_EQ(made.at("forward"), Json({{-20.001, -20.002}, {0.002, 0.003}, {20.003, 20.004}}));
    EXPECT_NE(made.at("note").get<std::string>().find("the other way round"), std::string::npos);
}

TEST(StreamFile, ThatDoesNotFitThePlanIsRefusedWithThePlace) {
    const ImportMap map = map_of(map_text);
    expect_refused(replaced(stream(), " 122\n", " 0\n"), map, "file",
                   "forward cycle 2 has no reading of target 2");
    expect_refused(replaced(stream(), " 122\n", " 123\n"), map, "line 34",
                   "another target than before");
    expect_refused(replaced(stream(), " 122\n", " 322\n"), map, "line 34",
                   "neither forward nor backward");
    expect_refused(replaced(stream(), " 122\n", " 1222\n"), map, "line 34", "digits dcp");
    expect_refused(replaced(stream(), " 113\n", " 11\n"), map, "line 14", "neither forward");
    expect_refused(stream().substr(0, stream().rfind("1234")), map, "line 52", "is the file whole");
    expect_refused(replaced(stream(), " 0.003\n", " 0.003 READ INVALID\n"), map, "line 33",
                   "INVALID");
    expect_refused("IOC:Test 2026-04-06 12:00:00.000000 0\n", map, "file", "no line of");
    expect_refused(
        replaced(stream(), "IOC:ILD  2026-04-06 12:00:00.3", "IOC:Off  2026-04-06 12:00:00.3"),
        map_of(replaced(map_text, "take = \"last\"", "take = \"mean\"\nbefore = \"0 s\"")),
        "line 6", "no value at this capture");
}

TEST(StreamFile, ThatBeginsWithTheNumberOfAnEarlierJobPassesItOver) {
    const std::string left = "IOC:Test 2026-04-06 11:59:00.000000 223\n" + stream();
    EXPECT_EQ(case_of(left, map_of(map_text)), case_of(stream(), map_of(map_text)));
}

TEST(StreamFile, WithAlarmsIsTakenWithARemark) {
    const Json made =
        case_of(replaced(stream(), " 0.003\n", " 0.003 HIHI MAJOR\n"), map_of(map_text));
    EXPECT_NE(made.at("note").get<std::string>().find("1 value of the stream had an alarm"),
              std::string::npos);
}

} // namespace
} // namespace axiscal::stream_file_test
