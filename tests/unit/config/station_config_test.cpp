#include "config/certificate_dates.hpp"
#include "config/station_config.hpp"
#include "tests/support/source_dir.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

namespace axiscal {
namespace {

const std::string example_path = test::source_dir() + "/config/station.example.toml";

std::string example_text() {
    std::ifstream file{example_path};
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty());
    return text.str();
}

struct Reading {
    StationConfig config;
    std::vector<std::string> asked;
    std::string told;
};

/// Reads `text`; the drivers' own keys are none of this test's business.
Reading read_text(const std::string& text) {
    auto document = SettingsDocument::parse(text, "station.toml");
    EXPECT_TRUE(document) << (document ? "" : document.error().detail);
    Reading reading;
    if (!document) return reading;
    reading.config = read_station(*document);
    for (Settings& options : reading.config.instrument_options)
        options.accept_rest();
    for (const Refusal& refusal : document->finish())
        reading.told += refusal.describe() + "\n";
    reading.asked = document->asked_keys();
    return reading;
}

/// The example with one piece of its text exchanged.
Reading read_changed(const std::string& from, const std::string& to) {
    std::string text = example_text();
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return read_text(text);
}

int count_lines(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

void expect_refused_once(const Reading& reading, const std::string& part) {
    EXPECT_NE(reading.told.find(part), std::string::npos) << part << "\n" << reading.told;
    EXPECT_EQ(count_lines(reading.told), 1) << reading.told;
}

TEST(StationExample, IsReadWithoutRefusalOrWarning) {
    const Reading reading = read_text(example_text());
    EXPECT_EQ(reading.told, "");
    EXPECT_TRUE(reading.config.warnings.empty());
}

TEST(StationExample, MeansWhatItsWordsSay) {
    using namespace std::chrono_literals;
    const StationConfig config = read_text(example_text()).config;
    EXPECT_EQ(config.station, "bay 3");
    EXPECT_EQ(config.state_directory, "/var/lib/axiscal");
    EXPECT_EQ(config.axis.name, "X");
    EXPECT_EQ(config.axis.program_axis, "X");
    EXPECT_EQ(config.axis.sign, 1);
    EXPECT_EQ(config.axis.laser.instrument, "laser");
    EXPECT_EQ(config.axis.laser.channel, "axis 1");
    EXPECT_DOUBLE_EQ(config.axis.dead_path.in(mm), 120);
    EXPECT_DOUBLE_EQ(config.axis.material.coefficient.in(um_per_m_kelvin), 11.5);
    EXPECT_EQ(config.axis.air.co2_ppm, 450);
    ASSERT_EQ(config.axis.material_temperature.size(), 2U);
    EXPECT_EQ(config.cycle.axis_kind, AxisKind::linear);
    EXPECT_EQ(config.cycle.target_count, 11);
    EXPECT_EQ(config.cycle.approaches, 5);
    EXPECT_DOUBLE_EQ(config.cycle.travel_high.in(mm), 1000);
    EXPECT_DOUBLE_EQ(config.cycle.overrun.in(mm), 2);
    EXPECT_DOUBLE_EQ(config.cycle.feed.in(mm_per_minute), 1000);
    EXPECT_EQ(config.cycle.dwell, 4s);
    EXPECT_EQ(config.capture.window, 500ms);
    EXPECT_DOUBLE_EQ(config.capture.slope_limit_um_per_s, 1);
    EXPECT_EQ(config.trigger.shape, TriggerShape::sequence_block);
    EXPECT_EQ(config.trigger.transport, TriggerTransport::tcp_server);
    EXPECT_EQ(config.trigger.port, 1502);
    EXPECT_EQ(config.console.port, 8470);
    EXPECT_EQ(config.statements.state, "as found");
    EXPECT_EQ(config.statements.axis, "X");
    EXPECT_EQ(config.statements.feed, "1000 mm/min");
    EXPECT_EQ(config.statements.dwell, "4 s");
    ASSERT_EQ(config.instruments.size(), 3U);
    EXPECT_EQ(config.instruments[1].driver, "dracal-vcp");
    ASSERT_EQ(config.instruments[1].channels.size(), 2U);
    EXPECT_DOUBLE_EQ(config.instruments[1].channels[0].correction, -0.03);
    EXPECT_EQ(config.instruments[1].channels[0].correction_unit, "degC");
    EXPECT_DOUBLE_EQ(config.instruments[1].channels[1].correction, 20);
    EXPECT_EQ(config.instruments[1].channels[1].correction_unit, "Pa");
    EXPECT_EQ(config.instruments[2].channels[0].medium, Medium::material);
}

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
                        "stands beside a table of corrections");
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

/// "table.key" for every assignment in the file, also in a comment ("# key = ...").
std::set<std::string> explained_keys(const std::string& text) {
    static const std::regex header{R"(^(?:# )?\[+([a-z_.]+)\]+$)"},
        key{R"(^(?:# )?([A-Za-z_0-9]+) = .*)"};
    std::set<std::string> keys;
    std::istringstream lines{text};
    std::string line, table;
    std::smatch found;
    while (std::getline(lines, line)) {
        if (std::regex_match(line, found, header)) {
            table = found[1];
            for (auto dot = table.find('.'); dot != std::string::npos;
                 dot = table.find('.', dot + 1))
                keys.insert(table.substr(0, dot));
            keys.insert(table);
        } else if (std::regex_match(line, found, key)) {
            keys.insert(table + "." + found[1].str());
        }
    }
    return keys;
}

TEST(StationExample, ExplainsEveryKeyThatIsRead) {
    const auto explained = explained_keys(example_text());
    const auto asked = read_text(example_text()).asked;
    EXPECT_GT(asked.size(), 100U);
    for (const std::string& key : asked)
        EXPECT_TRUE(explained.contains(key)) << key << " is not in the example";
}

// Every commented-out key is a real one of its table: uncommented, it is at most out of place.
TEST(StationExample, OffersNoKeyThatDoesNotExist) {
    const std::string text = example_text();
    const auto asked = read_text(text).asked;
    const std::set<std::string> known{asked.begin(), asked.end()};
    for (const std::string& key : explained_keys(text)) {
        if (key.starts_with("instrument.") && !key.starts_with("instrument.channel")) continue;
        EXPECT_TRUE(known.contains(key)) << key << " is in the example, but nobody reads it";
    }
}

TEST(StationConfig, RefusesEachMissingSafetyValue) {
    for (const std::string key :
         {"travel_low", "travel_high", "sign", "dead_path", "coefficient", "overrun", "feed",
          "spread_limit", "fastest", "shape", "transport", "port", "kind", "laser"}) {
        const std::string text =
            std::regex_replace(example_text(), std::regex{"\n" + key + " = [^\n]*"}, "\n");
        const std::string told = read_text(text).told;
        EXPECT_NE(told.find("." + key + ": is missing"), std::string::npos) << key << "\n" << told;
    }
}

TEST(StationConfig, TellsEverythingOfAnEmptyFileAtOnce) {
    const Reading reading = read_text("");
    for (const char* key : {"instrument:", "axis.kind:", "axis.travel_low:", "cycle.feed:",
                            "capture.spread_limit:", "trigger.shape:"})
        EXPECT_NE(reading.told.find(key), std::string::npos) << key << "\n" << reading.told;
}

TEST(StationConfig, RefusesTravelLimitsInTheWrongOrder) {
    const Reading reading = read_changed("travel_high = \"1000 mm\"", "travel_high = \"-1 mm\"");
    expect_refused_once(reading, "axis.travel_high: must lie above travel_low");
}

TEST(StationConfig, WantsEitherAListOfTargetsOrAnInterval) {
    const std::string list = "targets = [\"0 mm\", \"200 mm\", \"410 mm\"]";
    expect_refused_once(read_changed("interval = \"93 mm\"", "interval = \"93 mm\"\n" + list),
                        "cycle.interval: stands beside targets");
    expect_refused_once(read_changed("interval = \"93 mm\"\n", "\n"), "cycle.interval: is missing");
    const Reading both = read_changed("interval = \"93 mm\"\n", list + "\n");
    EXPECT_NE(both.told.find("cycle.target_count: belongs to interval"), std::string::npos);
    EXPECT_NE(both.told.find("cycle.first_target: belongs to interval"), std::string::npos);
    EXPECT_EQ(count_lines(both.told), 2) << both.told;
}

TEST(StationConfig, WarnsOfASingleMaterialSensor) {
    const Reading reading = read_changed("\"material/contact 1\", ", "");
    EXPECT_EQ(reading.told, "");
    ASSERT_EQ(reading.config.warnings.size(), 1U);
    EXPECT_NE(reading.config.warnings[0].describe().find("at least two"), std::string::npos);
}

TEST(StationConfig, RefusesARunWithoutMaterialSensor) {
    expect_refused_once(read_changed("\"material/contact 1\", \"material/contact 2\"", ""),
                        "axis.material.temperature: names no sensor");
}

TEST(StationConfig, RefusesAnAirChannelAsMaterial) {
    expect_refused_once(read_changed("\"material/contact 1\"", "\"air/air temperature\""),
                        "is a channel of medium air");
}

TEST(StationConfig, RefusesAMaterialChannelAsAir) {
    expect_refused_once(
        read_changed("temperature = \"air/air temperature\"",
                     "temperature = \"material/contact 1\""),
        "axis.air.temperature: \"material/contact 1\" is a channel of medium material");
}

TEST(StationConfig, RefusesTheSameSensorTwice) {
    expect_refused_once(read_changed("\"material/contact 1\", \"material/contact 2\"",
                                     "\"material/contact 1\", \"material/contact 1\""),
                        "stands there twice");
}

TEST(StationConfig, RefusesARoleOfAnUnknownInstrument) {
    expect_refused_once(read_changed("laser = \"laser/axis 1\"", "laser = \"lasr/axis 1\""),
                        "did you mean \"laser\"?");
}

TEST(StationConfig, RefusesARoleWithoutChannel) {
    for (const char* role : {"laser", "laser/", "/axis 1", ""})
        expect_refused_once(
            read_changed("laser = \"laser/axis 1\"", "laser = \"" + std::string{role} + "\""),
            "axis.laser: \"" + std::string{role} + "\" names no channel");
}

TEST(StationConfig, RefusesASignOfZero) {
    expect_refused_once(read_changed("sign = 1", "sign = 0"), "axis.sign: is 1 when");
}

TEST(StationConfig, RefusesAWindowLongerThanTheHalt) {
    expect_refused_once(read_changed("dwell = \"4 s\"", "dwell = \"0.4 s\""),
                        "capture.window: is longer than cycle.dwell");
}

TEST(StationConfig, RefusesAFeedFasterThanTheAxis) {
    expect_refused_once(read_changed("feed = \"1000 mm/min\"", "feed = \"40 m/min\""),
                        "capture.fastest: is below cycle.feed");
}

TEST(StationConfig, RefusesTwoInstrumentsOfOneName) {
    const Reading reading = read_changed("name = \"material\"", "name = \"air\"");
    EXPECT_NE(
        reading.told.find("instrument[2].name: \"air\" is the name of the instrument in line"),
        std::string::npos)
        << reading.told;
}

TEST(StationConfig, RefusesAConsoleHostThatIsNoAddress) {
    expect_refused_once(
        read_changed("# host = \"127.0.0.1\"\n# port = 8470", "host = \"bay3.plant.example\""),
        "console.host: \"bay3.plant.example\" is no address");
}

TEST(StationConfig, RefusesPathsThatDependOnTheStartingFolder) {
    expect_refused_once(
        read_changed("# state_directory = \"/var/lib/axiscal\"", "state_directory = \"var\""),
        "station.state_directory: \"var\" is no whole path");
}

TEST(StationConfig, RefusesACorrectionWithoutUnit) {
    expect_refused_once(read_changed("correction = \"-0.03 K\"", "correction = -0.03"),
                        "instrument[1].channel[0].correction: is a bare number");
}

TEST(StationConfig, RefusesAnUnknownKeyOfAChannel) {
    expect_refused_once(read_changed("place = \"nut side", "palce = \"nut side"),
                        "instrument[2].channel[0].palce: is not a key of this table; did you mean "
                        "\"place\"?");
}

/// The trigger table of the example, replaced.
Reading read_trigger_table(const std::string& table) {
    std::string text = example_text();
    text = std::regex_replace(text, std::regex{"\n(shape|transport|host|port) = [^\n]*"}, "\n");
    const auto at = text.find("[trigger]\n");
    return read_text(text.insert(at + 10, table));
}

struct TriggerCase {
    const char* table;
    const char* refusal; ///< empty: accepted
};

class TriggerTable : public testing::TestWithParam<TriggerCase> {};

TEST_P(TriggerTable, IsAcceptedOrRefusedWithTheWayOut) {
    const Reading reading = read_trigger_table(GetParam().table);
    if (std::string{GetParam().refusal}.empty()) {
        EXPECT_EQ(reading.told, "");
    } else {
        expect_refused_once(reading, GetParam().refusal);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Combinations,
    TriggerTable,
    testing::Values(
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp\"\nport = 502\n", ""},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp-mirrored\"\nport = 502\n"
                    "host = \"cnc.plant.example\"\nbase_address = 32768\n",
                    ""},
        TriggerCase{"shape = \"single-register\"\ntransport = \"rtu\"\n"
                    "serial_port = \"/dev/ttyS0\"\nparity = \"even\"\nunit_id = 3\n",
                    ""},
        TriggerCase{"shape = \"coil-and-index\"\ntransport = \"tcp\"\nport = 1502\n"
                    "index_grace = \"20 ms\"\n",
                    ""},
        TriggerCase{"shape = \"dwell\"\nwindow = \"0.5 mm\"\nstability_range = \"2 um\"\n"
                    "hysteresis = \"0.2 mm\"\n",
                    ""},
        TriggerCase{"shape = \"dwell\"\nwindow = \"1.5 mm\"\nstability_range = \"2 um\"\n"
                    "hysteresis = \"0.499 mm\"\n",
                    ""},
        TriggerCase{"shape = \"dwell\"\nwindow = \"1.5 mm\"\nstability_range = \"2 um\"\n"
                    "hysteresis = \"0.5 mm\"\n", // the example's overrun is 2 mm
                    "trigger.hysteresis: and window together are 2 mm, and the axis turns after "
                    "cycle.overrun = 2 mm"},
        TriggerCase{"shape = \"dwell\"\ntransport = \"tcp\"\n", "does not go with shape \"dwell\""},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"none\"\n",
                    "\"none\" goes with shape \"dwell\" only"},
        TriggerCase{"shape = \"single-register\"\ntransport = \"tcp-mirrored\"\n",
                    "exists for shape \"sequence-block\" only"},
        TriggerCase{"shape = \"coil-and-index\"\ntransport = \"tcp-mirrored\"\n",
                    "exists for shape \"sequence-block\" only"},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"rtu\"\n",
                    "trigger.serial_port: is missing"},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp\"\n",
                    "trigger.port: is missing"},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp-mirrored\"\nport = 502\n",
                    "trigger.host: is missing"},
        TriggerCase{
            "shape = \"single-register\"\ntransport = \"tcp\"\nport = 1502\nhost = \"0.0.0.0\"",
            "trigger.host: \"0.0.0.0\" is heard by other computers: name those that may "
            "connect"},
        TriggerCase{"shape = \"single-register\"\ntransport = \"tcp\"\nport = 1502\nhost = "
                    "\"0.0.0.0\"\nallowed_clients = [\"cnc\"]",
                    "trigger.allowed_clients: \"cnc\" is no address"},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp\"\nport = 502\nbaud = 9600\n",
                    "trigger.baud: belongs to transport \"rtu\""},
        TriggerCase{"shape = \"single-register\"\ntransport = \"tcp\"\nport = 502\n"
                    "watch_heartbeat = true\n",
                    "trigger.watch_heartbeat: belongs to shape \"sequence-block\""},
        TriggerCase{"shape = \"sequense-block\"\ntransport = \"tcp\"\nport = 502\n",
                    "did you mean \"sequence-block\"?"}));

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

TEST(StationAngle, TheExampleIsReadAndExplainsEveryKeyOfTheAngle) {
    std::ifstream file{test::source_dir() + "/config/rotary.example.toml"};
    std::ostringstream text;
    text << file.rdbuf();
    const Reading reading = read_text(text.str());
    EXPECT_EQ(reading.told, "");
    EXPECT_TRUE(reading.config.warnings.empty());
    EXPECT_EQ(reading.config.axis.angle->setup.run_out, "8 um at a radius of 100 mm");
    const auto explained = explained_keys(text.str());
    int keys = 0;
    for (const std::string& key : reading.asked)
        if (key.starts_with("axis.angle.")) {
            ++keys;
            EXPECT_TRUE(explained.contains(key)) << key;
        }
    EXPECT_GE(keys, 13);
    for (const std::string& key : explained)
        if (key.starts_with("axis.angle.")) {
            EXPECT_NE(std::ranges::find(reading.asked, key), reading.asked.end()) << key;
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
    const auto& [setup, artefact] = *reading.config.axis.angle;
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
    expect_refused_once(read_text(text), "a rotary axis needs a control that asks");
}

/// The example with its uncertainty table replaced.
Reading read_uncertainty_table(const std::string& table) {
    std::string text = example_text();
    const auto begin = text.find("[uncertainty]"), end = text.find("[certificate]");
    return read_text(text.replace(begin, end - begin, table + "\n"));
}

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
        {"device = \"1 um\"\ndevice_width = \"1 um\"", "uncertainty.device_width: stands beside"},
        {"misalignment = \"1 mm\"\nmisalignment_angle = \"1 mrad\"",
         "uncertainty.misalignment_angle: stands beside"},
        {"eve = \"1 um\"\neve_run = \"latest\"", "uncertainty.eve_run: stands beside"},
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
} // namespace axiscal
