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

TEST(CertificateDates, NameWhatHasExpiredWithItsLine) {
    const StationConfig config = read_text(example_text()).config;
    EXPECT_TRUE(expired_certificates(config, "2027-01-20").empty()); // the day itself is good
    const auto notes = expired_certificates(config, "2027-01-21");
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].reason.find("\"material\" was due on 2027-01-20"), std::string::npos);
    EXPECT_EQ(notes[0].line, config.instruments[2].line);
    EXPECT_EQ(expired_certificates(config, "2028-01-01").size(), 3U);
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
    const auto begin = text.find("[uncertainty]"), end = text.find("[certificate]");
    return text.erase(begin, end - begin); // its terms are those of a length
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
                        "uncertainty: holds the budget of a linear axis");
}

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
