#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <regex>
#include <string>

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

} // namespace
} // namespace axiscal::station_trigger_test
