// Every instrument's tape under virtual time, compared with its expectation to the last digit.
#include "drivers/recording/tape_link.hpp"
#include "drivers/recording/tape_recording.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace axiscal::tape_replay_test {
namespace {

struct TapeCase {
    std::string tape, driver, keys;
};
std::ostream& operator<<(std::ostream& out, const TapeCase& which) {
    return out << which.tape;
}

std::string file_text(const std::string& name) {
    std::ifstream file{test::source_dir() + "/tests/traces/" + name};
    EXPECT_TRUE(file) << name;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// What the supervisor does without its patience: opens again at once until the tape is at its end.
Task<void> run_to_the_end(Instrument& instrument,
                          InstrumentContext context,
                          const TapePlayer& player,
                          testing::SampleRecorder& sink) {
    while (!player.at_end()) {
        const auto ended = co_await instrument.run(context);
        sink.lines.push_back("ended " + std::string{fault_name(ended.error().fault)});
        if (ended.error().fault == Fault::internal) co_return; // it would write the same again
    }
}

class TapeReplay : public ::testing::TestWithParam<TapeCase> {};

TEST_P(TapeReplay, GivesExactlyWhatIsExpected) {
    const TapeCase& which = GetParam();
    const auto tape = parse_tape(file_text(which.tape + ".tape"));
    ASSERT_TRUE(tape) << describe(tape.error());
    testing::VirtualScheduler scheduler;
    TapePlayer player{scheduler, *tape};
    testing::SampleRecorder sink{scheduler.now()};
    const auto instrument = testing::instrument(which.driver, which.keys);
    sink.name_channels(instrument->channels());
    const InstrumentContext context{&scheduler, &player, &sink};
    boost::asio::co_spawn(scheduler.executor(), run_to_the_end(*instrument, context, player, sink),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::minutes{1});
    sink.lines.push_back(testing::text_of(instrument->counters()));
    EXPECT_EQ(sink.text(), file_text(which.tape + ".expected"));
}

/// Direction and bytes of each transfer, without its time.
std::string transfers_of(const Tape& tape) {
    std::string text;
    for (const TapeEntry& entry : tape.entries) {
        text += static_cast<char>(entry.direction);
        for (const std::byte byte : entry.bytes)
            text += " " + std::to_string(std::to_integer<int>(byte));
        text += "\n";
    }
    return text;
}

/// A driver writes when it is ready, which may be earlier than the tape was made.
TEST_P(TapeReplay, IsRecordedAsItWasPlayed) {
    const TapeCase& which = GetParam();
    const auto tape = parse_tape(file_text(which.tape + ".tape"));
    ASSERT_TRUE(tape);
    testing::VirtualScheduler scheduler;
    TapePlayer player{scheduler, *tape};
    std::stringstream copy;
    RecordingOpener recorder{scheduler, player, copy};
    testing::SampleRecorder sink{scheduler.now()};
    const auto instrument = testing::instrument(which.driver, which.keys);
    const InstrumentContext context{&scheduler, &recorder, &sink};
    boost::asio::co_spawn(scheduler.executor(), run_to_the_end(*instrument, context, player, sink),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::minutes{1});
    const auto recorded = parse_tape("origin = simulator\n" + copy.str());
    ASSERT_TRUE(recorded) << describe(recorded.error());
    // What ends the tape is met as a closed link.
    std::string wanted = transfers_of(*tape), got = transfers_of(*recorded);
    if (got == wanted + "!\n") wanted += "!\n";
    EXPECT_EQ(got, wanted);
}

const std::string umd_keys = "link = \"serial:/dev/null\"\nwavelength = \"632.991354 nm\"\n"
                             "fastest = \"0.5 m/s\"\n";
const std::string corner_cube = umd_keys + "fold = \"corner cube\"\n";
const std::string glass_scale =
    "link = \"serial:/dev/null\"\nresolution = \"5 um\"\nfastest = \"0.5 m/s\"\n";
const std::string plane_mirror = umd_keys + "fold = \"plane mirror\"\n";
const std::string usb_keys = "link = \"usb:any\"\n";
const std::string ballbar_keys = "link = \"usb:470012345\"\nscale_length = \"1 mm\"\n";
const std::string can_keys = "link = \"can:can0\"\n";
const std::string w1_keys = "sensors = [\"28-0000075b3c2a\", \"28-0000075b3c2b\"]\n";
const std::string counter_keys = "device = \"/dev/counter0\"\nevent = \"capture\"\nbits = 16\n"
                                 "resolution = \"0.5 um\"\nfastest = \"0.5 m/s\"\n";
const std::string line_keys = "link = \"serial:/dev/null\"\n";
const std::string ids_keys = "link = \"tcp:192.168.1.1:9090\"\nair = \"corrected here\"\n"
                             "wavelength = \"1530 nm\"\nfastest = \"0.5 m/s\"\n"
                             "poll_period = \"100 ms\"\n";
const std::string lasertex_keys =
    line_keys + "position = \"raw\"\nwavelength = \"632.991354 nm\"\nfastest = \"0.5 m/s\"\n";
/// Its value follows.
const std::string model_keys = "link = \"serial:/dev/null\"\nmodel = ";

INSTANTIATE_TEST_SUITE_P(
    Instruments,
    TapeReplay,
    ::testing::Values(TapeCase{"umd2-homodyne", "umd", corner_cube},
                      TapeCase{"umd1-heterodyne", "umd", corner_cube},
                      TapeCase{"umd0-homodyne", "umd", plane_mirror},
                      TapeCase{"umd2-sixteen-bit", "umd", corner_cube},
                      TapeCase{"umd2-glass-scale", "umd", glass_scale},
                      TapeCase{"dracal-vcp-pth450", "dracal-vcp", line_keys},
                      TapeCase{"dracal-vcp-faults", "dracal-vcp", line_keys},
                      TapeCase{"gauge-nd-28x", "ascii-gauge", model_keys + "\"nd-28x\"\n"},
                      TapeCase{"gauge-mitutoyo", "ascii-gauge",
                               model_keys + "\"mitutoyo\"\nunit = \"mm\"\n"},
                      TapeCase{"gauge-sylvac", "ascii-gauge", model_keys + "\"sylvac\"\n"},
                      TapeCase{"gauge-elcomat", "ascii-gauge", model_keys + "\"elcomat-x\"\n"},
                      TapeCase{"ids3010", "ids3010", ids_keys},
                      TapeCase{"ids3010-corrects-twice", "ids3010", ids_keys},
                      TapeCase{"lasertex-hpi-3d", "lasertex", lasertex_keys},
                      TapeCase{"vaisala-ptu300", "vaisala", model_keys + "\"ptu300\"\n"},
                      TapeCase{"vaisala-ptb330-poll", "vaisala",
                               model_keys + "\"ptb330\"\naddress = 1\n"
                                            "checksum = \"CS4\"\n"},
                      TapeCase{"dracal-usbtenki-pth", "dracal-usbtenki", usb_keys},
                      TapeCase{"temper-x", "temper", usb_keys},
                      TapeCase{"temper-serial", "temper-serial", line_keys},
                      TapeCase{"canopen-404-cantrans", "canopen-404", can_keys},
                      TapeCase{"canopen-406-temposonics", "canopen-406", can_keys},
                      TapeCase{"labjack-u6-stream", "labjack-u6", ballbar_keys},
                      TapeCase{"ds18b20", "ds18b20", w1_keys},
                      TapeCase{"counter-capture", "counter", counter_keys}),
    [](const auto& which) {
        std::string name = which.param.tape;
        std::erase(name, '-');
        return name;
    });

} // namespace
} // namespace axiscal::tape_replay_test
