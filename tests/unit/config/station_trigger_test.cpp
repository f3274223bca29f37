#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <regex>
#include <string>
#include <vector>

namespace axiscal::station_trigger_test {
namespace {

using test::example_text;
using test::expect_refused_once;
using test::read_text;
using Reading = test::StationReading;

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

class TriggerTable : public ::testing::TestWithParam<TriggerCase> {};

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
    ::testing::Values(
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp\"\nport = 502\n", ""},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp-mirrored\"\nport = 502\n"
                    "host = \"cnc.plant.example\"\nbase_address = 32768\n",
                    ""},
        TriggerCase{"shape = \"single-register\"\ntransport = \"tcp\"\nport = 1502\n"
                    "cnc_timeout = \"13 s\"\n", // the example's capture.timeout is 10 s
                    ""},
        TriggerCase{
            "shape = \"single-register\"\ntransport = \"tcp\"\nport = 1502\n"
            "cnc_timeout = \"12 s\"\n",
            "trigger.cnc_timeout: is shorter than the time that the station itself may need: "
            "with this capture.timeout it must be at least 13 s"},
        TriggerCase{"shape = \"single-register\"\ntransport = \"rtu\"\n"
                    "serial_port = \"/dev/ttyS0\"\nparity = \"even\"\nunit_id = 3\n",
                    ""},
        TriggerCase{"shape = \"single-register\"\ntransport = \"rtu\"\nserial_port = \"COM5\"\n",
                    "trigger.serial_port: \"COM5\" is a port's name on Windows; Linux names it by "
                    "a file: write \"/dev/serial/by-id/...\" or \"/dev/ttyUSB0\""},
        TriggerCase{"shape = \"coil-and-index\"\ntransport = \"tcp\"\nport = 1502\n"
                    "index_grace = \"20 ms\"\n",
                    ""},
        TriggerCase{"shape = \"dwell\"\nwindow = \"0.5 mm\"\nstability_range = \"2 um\"\n"
                    "hysteresis = \"0.2 mm\"\n",
                    ""},
        TriggerCase{"shape = \"dwell\"\nwindow = \"1.5 mm\"\nstability_range = \"2 um\"\n"
                    "hysteresis = \"0.499 mm\"\n",
                    ""},
        TriggerCase{
            "shape = \"dwell\"\nwindow = \"1.5 mm\"\nstability_range = \"2 um\"\n"
            "hysteresis = \"0.5 mm\"\n", // the example's overrun is 2 mm
            "trigger.hysteresis: together with window it is 2 mm, but the axis reverses after "
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
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp\"\n", ""},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp\"\n"
                    "allowed_clients = [\"192.168.10.20\"]\n",
                    ""},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp-mirrored\"\n"
                    "host = \"192.168.10.20\"\n",
                    "trigger.port: is missing"},
        TriggerCase{"shape = \"sequence-block\"\ntransport = \"tcp-mirrored\"\nport = 502\n",
                    "trigger.host: is missing"},
        TriggerCase{
            "shape = \"single-register\"\ntransport = \"tcp\"\nport = 1502\nhost = \"0.0.0.0\"",
            "trigger.host: \"0.0.0.0\" accepts connections from other computers: list those that "
            "may connect"},
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

/// Tables with several mistakes: `refusals` are all of them, in the order of the lines.
struct HiddenCase {
    const char* table;
    std::vector<const char*> refusals;
};

class WrongTriggerTable : public ::testing::TestWithParam<HiddenCase> {};

TEST_P(WrongTriggerTable, TellsEveryMistakeBesideAWrongShapeOrTransportAndNoOther) {
    const Reading reading = read_trigger_table(GetParam().table);
    for (const char* refusal : GetParam().refusals)
        EXPECT_NE(reading.told.find(refusal), std::string::npos) << refusal << "\n" << reading.told;
    EXPECT_EQ(test::count_lines(reading.told), static_cast<int>(GetParam().refusals.size()))
        << reading.told;
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes,
    WrongTriggerTable,
    ::testing::Values(
        HiddenCase{"shape = \"sequense-block\"\ntransport = \"tcp\"\nport = 150200\n",
                   {"did you mean \"sequence-block\"?", "trigger.port: 150200 is out of range"}},
        HiddenCase{"shape = \"sequence-block\"\ntransport = \"tpc\"\nport = 150200\n",
                   {"trigger.transport: \"tpc\" is not one of", "port: 150200 is out of range"}},
        HiddenCase{
            "shape = \"sequense-block\"\ntransport = \"tpc\"\nport = 150200\nprot = 1\n"
            "unit_id = 500\nwindow = 1\nindex_grace = \"1 h\"\nbaud = 1\n"
            "serial_port = \"ttyS0\"\nallowed_clients = [\"cnc\"]\n",
            {"shape: \"sequense-block\" is not one of", "transport: \"tpc\" is not one of",
             "port: 150200 is out of range", "prot: is not a key of this table; did you mean",
             "unit_id: 500 is out of range", "window: is a bare number",
             "index_grace: \"1 h\" is out of range", "baud: 1 is out of range",
             "serial_port: \"ttyS0\" is no whole path", "allowed_clients: \"cnc\" is no address"}},
        // which keys belong here cannot be told: each that is right by itself is let be
        HiddenCase{"shape = \"sequense-block\"\ntransport = \"tpc\"\nhost = \"cnc\"\nport = 502\n"
                   "baud = 9600\nunit_id = 3\nwindow = \"0.5 mm\"\nbase_address = 8\n",
                   {"shape: \"sequense-block\" is not one of", "transport: \"tpc\" is not one of"}},
        HiddenCase{"shape = \"dwel\"\nwindow = \"0.5 mm\"\nstability_range = \"2 um\"\n"
                   "hysteresis = \"0.2 mm\"\n", // and needs no transport
                   {"did you mean \"dwell\"?"}},
        HiddenCase{"shape = \"dwell\"\ntransport = \"tcp\"\nport = 150200\n",
                   {"does not go with shape \"dwell\"", "port: 150200 is out of range"}},
        // the word that is right decides about its own keys
        HiddenCase{"shape = \"sequense-block\"\ntransport = \"tcp\"\nport = 502\nbaud = 9600\n",
                   {"did you mean \"sequence-block\"?", "baud: belongs to transport \"rtu\""}},
        HiddenCase{"shape = \"single-register\"\ntransport = \"tpc\"\nindex_grace = \"9 ms\"\n",
                   {"transport: \"tpc\" is not one of",
                    "index_grace: belongs to shape \"coil-and-index\""}},
        HiddenCase{"", {"trigger.shape: is missing", "trigger.transport: is missing"}}));

/// An overrun that cannot be read is not compared with the halt that the trigger waits for.
TEST(StationTrigger, ADwellIsNotJudgedByAnOverrunThatIsRefused) {
    std::string text = example_text();
    text = std::regex_replace(text, std::regex{"\n(shape|transport|host|port) = [^\n]*"}, "\n");
    text = std::regex_replace(text, std::regex{"\noverrun = [^\n]*"}, "\noverrun = \"2 s\"");
    const auto at = text.find("[trigger]\n");
    expect_refused_once(read_text(text.insert(at + 10, "shape = \"dwell\"\nwindow = \"0.5 mm\"\n"
                                                       "stability_range = \"2 um\"\n"
                                                       "hysteresis = \"0.2 mm\"\n")),
                        "cycle.overrun: \"s\" is no unit of a length");
}

} // namespace
} // namespace axiscal::station_trigger_test
