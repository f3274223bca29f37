// Every instrument's tape under virtual time, compared with its expectation to the last digit.
#include "drivers/link/tape_link.hpp"
#include "drivers/link/tape_recording.hpp"
#include "drivers/link/usb_link.hpp"
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

TEST(Tape, IsRefusedWithTheLineThatIsWrong) {
    const std::string header = "origin = simulator\n";
    for (const auto& [text, word] :
         {std::pair{"what = x\n< 0 00\n", "origin"}, std::pair{"origin = hearsay\n", "origin"},
          std::pair{"origin = simulator\n< 5 00\n< 4 00\n", "line 3"},
          std::pair{"origin = simulator\n< 5 0g\n", "line 2"},
          std::pair{"origin = simulator\n< 5 000\n", "half"},
          std::pair{"origin = simulator\nhello\n", "line 2"}}) {
        const auto tape = parse_tape(text);
        ASSERT_FALSE(tape) << text;
        EXPECT_NE(tape.error().detail.find(word), std::string::npos) << tape.error().detail;
    }
    EXPECT_TRUE(parse_tape(header + "# remark\n\n< 0 00ff\n! 7\n"));
}

Task<void> play(TapePlayer& player, Scheduler& scheduler, std::ostream& copy) {
    const MonotonicTime begin = scheduler.now();
    const LinkSettings nowhere;
    auto opened = co_await player.open(nowhere, begin + std::chrono::seconds{1});
    TapeRecorderLink link{*std::move(opened), scheduler, copy, begin};
    std::vector<std::byte> question{std::byte{0x3f}};
    co_await link.write_all(std::move(question), begin + std::chrono::seconds{1});
    while (true) {
        const auto arrived = co_await link.read_some(scheduler.now() + std::chrono::seconds{1});
        if (!arrived && arrived.error().fault == Fault::link_closed) co_return;
    }
}

Task<void> read_both_endpoints(TapePlayer& player, Scheduler& scheduler, std::string& told) {
    const LinkSettings nowhere;
    const auto opened = co_await player.open_usb(nowhere, scheduler.now());
    co_await scheduler.sleep_for(std::chrono::milliseconds{10});
    for (const int endpoint : {0x82, 0x83, 0x82}) {
        const MonotonicTime deadline = scheduler.now() + std::chrono::milliseconds{20};
        const auto packet = co_await (*opened)->bulk_in(endpoint, 64, deadline);
        told += packet ? std::to_string(std::to_integer<int>(packet->bytes.at(0))) + " "
                       : std::string{fault_name(packet.error().fault)} + " ";
    }
}

// 2026-11-22: a driver that was a few milliseconds late met the packet of the other endpoint, which
// ended its session and was lost to the next one.
TEST(Tape, KeepsAPacketForTheEndpointThatItCameFrom) {
    const auto tape = parse_tape("origin = simulator\n< 5000000 8301\n< 6000000 8202\n");
    ASSERT_TRUE(tape);
    testing::VirtualScheduler scheduler;
    TapePlayer player{scheduler, *tape};
    std::string told;
    boost::asio::co_spawn(scheduler.executor(), read_both_endpoints(player, scheduler, told),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::seconds{1});
    EXPECT_EQ(told, "link_timeout 1 2 ");
}

/// Opens, asks on 0x01 and waits 20 ms for the answer, as the driver of a U6 does; then once more.
Task<void> ask_twice(TapePlayer& player, Scheduler& scheduler, std::string& told) {
    const LinkSettings nowhere;
    for (int opening = 0; opening < 2; ++opening) {
        const MonotonicTime patience = scheduler.now() + std::chrono::seconds{2};
        const auto opened = co_await player.open_usb(nowhere, patience);
        std::vector<std::byte> question{std::byte{0xb0}};
        const auto asked = co_await (*opened)->bulk_out(0x01, std::move(question), patience);
        const MonotonicTime soon = scheduler.now() + std::chrono::milliseconds{20};
        const auto answer = co_await (*opened)->bulk_in(0x82, 64, soon);
        told += std::string{asked ? "asked" : fault_name(asked.error().fault)} +
                (answer ? ", answered; " : ", silent; ");
    }
}

// 2026-11-23, on the kernel: to open a U6 took 282 ms, and another one was looked into first. The
// tape was played as if it had taken none, and its answers came too late.
TEST(Tape, TakesAsLongToOpenAsItTook) {
    const auto tape = parse_tape("origin = simulator\n> 282000000 01b0\n< 301000000 82b1\n"
                                 "> 343000000 01b0\n< 362000000 82b1\n");
    ASSERT_TRUE(tape);
    testing::VirtualScheduler scheduler;
    TapePlayer player{scheduler, *tape};
    std::string told;
    boost::asio::co_spawn(scheduler.executor(), ask_twice(player, scheduler, told),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::seconds{5});
    EXPECT_EQ(told, "asked, answered; asked, answered; ");
}

/// A file of a 1-Wire sensor whose adapter answers EIO 5 ms after it was asked.
class UnreadableFile final : public ByteLink {
public:
    explicit UnreadableFile(Scheduler& scheduler)
        : scheduler_{scheduler} {}
    Task<Result<TimedBytes>> read_some(MonotonicTime /*deadline*/) override {
        co_await scheduler_.sleep_for(std::chrono::milliseconds{5});
        co_return fail(Fault::io, "28-0000075b3c2a/w1_slave",
                       std::make_error_code(std::errc::io_error));
    }
    Task<Result<void>> write_all(std::vector<std::byte> /*bytes*/,
                                 MonotonicTime /*deadline*/) override {
        co_return Result<void>{};
    }

private:
    Scheduler& scheduler_;
};

/// Asks for one file and waits for it as the driver of the sensors does; `fault` tells what came.
Task<void> ask_for_file(ByteLink& link, Scheduler& scheduler, std::optional<Fault>& fault) {
    const MonotonicTime latest = scheduler.now() + std::chrono::seconds{10};
    std::vector<std::byte> name{std::byte{0x61}};
    co_await link.write_all(std::move(name), latest);
    const auto answer = co_await link.read_some(latest);
    if (!answer) fault = answer.error().fault;
}

Task<void> replay_file(TapePlayer& player, Scheduler& scheduler, std::optional<Fault>& fault) {
    const LinkSettings nowhere;
    const auto opened = co_await player.open(nowhere, scheduler.now());
    co_await ask_for_file(**opened, scheduler, fault);
}

TEST(Tape, TellsOfAFileThatCannotBeReadInsteadOfFallingSilent) {
    testing::VirtualScheduler scheduler;
    std::stringstream copy;
    TapeRecorderLink recorder{std::make_unique<UnreadableFile>(scheduler), scheduler, copy,
                              scheduler.now()};
    std::optional<Fault> met, replayed;
    boost::asio::co_spawn(scheduler.executor(), ask_for_file(recorder, scheduler, met),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::seconds{1});
    EXPECT_EQ(met, Fault::io);
    EXPECT_EQ(copy.str(), "> 0 61\nx 5000000\n");
    const auto tape = parse_tape("origin = simulator\n" + copy.str());
    ASSERT_TRUE(tape);
    TapePlayer player{scheduler, *tape};
    boost::asio::co_spawn(scheduler.executor(), replay_file(player, scheduler, replayed),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::milliseconds{5});
    EXPECT_EQ(replayed, Fault::refused) << "at the moment when it was told";
}

TEST(Tape, IsRecordedAsItWasPlayed) {
    const std::string transfers = "> 0 3f\n< 1000 00ff41\n< 2000000000 42\n! 2000000001\n";
    const auto tape = parse_tape("origin = simulator\n" + transfers);
    ASSERT_TRUE(tape);
    testing::VirtualScheduler scheduler;
    TapePlayer player{scheduler, *tape};
    std::stringstream copy;
    boost::asio::co_spawn(scheduler.executor(), play(player, scheduler, copy),
                          boost::asio::detached);
    scheduler.run_for(std::chrono::seconds{10});
    EXPECT_EQ(copy.str(), transfers);
}

} // namespace
} // namespace axiscal::tape_replay_test
