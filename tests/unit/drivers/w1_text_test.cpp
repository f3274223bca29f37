// Literal texts: the kernel's documentation of w1_therm and the scratchpads of the DS18B20 data
// sheet (its table of temperatures and its power-on state).
#include "drivers/environment/w1_text.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/recording/tape_recording.hpp"
#include "drivers/wire/link_opener.hpp"
#include "tests/support/loop_until.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/scratch_folder.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <span>
#include <sstream>

namespace axiscal::w1_text_test {
namespace {

const std::string warm = "72 01 4b 46 7f ff 0e 10 57 : crc=57 YES\n"
                         "72 01 4b 46 7f ff 0e 10 57 t=23125\n";

TEST(W1Slave, ReadsTheTemperatureOfTheScratchpad) {
    EXPECT_EQ(parse_w1_slave(warm).value(), 23.125);
    // -0.5 degC of the data sheet's table: FFF8 hex.
    EXPECT_EQ(parse_w1_slave("f8 ff 4b 46 7f ff 08 10 f8 : crc=f8 YES\n"
                             "f8 ff 4b 46 7f ff 08 10 f8 t=-500\n")
                  .value(),
              -0.5);
    // -55 degC: FC90 hex.
    EXPECT_EQ(parse_w1_slave("90 fc 4b 46 7f ff 0c 10 4f : crc=4f YES\n"
                             "90 fc 4b 46 7f ff 0c 10 4f t=-55000\n")
                  .value(),
              -55);
}

TEST(W1Slave, RefusesThePowerOnValue) {
    const auto cold_start = parse_w1_slave("50 05 4b 46 7f ff 0c 10 1c : crc=1c YES\n"
                                           "50 05 4b 46 7f ff 0c 10 1c t=85000\n");
    ASSERT_FALSE(cold_start);
    EXPECT_EQ(cold_start.error().fault, Fault::signal_error);
    EXPECT_NE(cold_start.error().detail.find("power-on"), std::string::npos);
}

TEST(W1Slave, RefusesAShortedWireAlthoughItsCrcIsRight) {
    EXPECT_EQ(parse_w1_slave("00 00 00 00 00 00 00 00 00 : crc=00 YES\n"
                             "00 00 00 00 00 00 00 00 00 t=0\n")
                  .error()
                  .fault,
              Fault::signal_error);
}

TEST(W1Slave, RefusesWhatTheKernelCallsWrong) {
    std::string no = warm;
    no.replace(no.find("YES"), 3, "NO");
    EXPECT_EQ(parse_w1_slave(no).error().fault, Fault::checksum);
}

TEST(W1Slave, RefusesEveryDamagedByteOfTheScratchpadAndTheTemperature) {
    const auto first_line = warm.find('\n');
    for (std::size_t at = 0; at < warm.size(); ++at) {
        const bool copy = at > first_line && at < warm.find("t="); // not looked at: a copy
        const bool crc_told = at >= warm.find("crc=") && at < warm.find(" YES");
        if (copy || crc_told || at + 1 == warm.size()) continue;
        std::string damaged = warm;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        EXPECT_FALSE(parse_w1_slave(damaged)) << damaged;
    }
    for (std::size_t size = 0; size + 1 < warm.size(); ++size)
        EXPECT_FALSE(parse_w1_slave(warm.substr(0, size))) << size;
}

TEST(W1Temperature, ReadsMillidegreesAndRefusesTheKnownWrongOnes) {
    EXPECT_EQ(parse_w1_temperature("23125\n").value(), 23.125);
    EXPECT_EQ(parse_w1_temperature("-500\n").value(), -0.5);
    EXPECT_EQ(parse_w1_temperature("").error().fault, Fault::bad_frame); // converting
    EXPECT_EQ(parse_w1_temperature("23.1\n").error().fault, Fault::bad_frame);
    for (const char* text : {"85000\n", "127937\n", "-55001\n", "125001\n"})
        EXPECT_EQ(parse_w1_temperature(text).error().fault, Fault::signal_error) << text;
}

class Thermometers : public ::testing::Test {
protected:
    void show(const std::string& sensor, const std::string& text) {
        std::filesystem::create_directories(folder_.path() + "/" + sensor);
        std::ofstream{folder_.path() + "/" + sensor + "/w1_slave"} << text;
    }
    void start(const std::string& sensors) {
        instrument_ = testing::instrument("ds18b20", "sysfs = \"" + folder_.path() +
                                                         "\"\nsensors = " + sensors +
                                                         "\npoll_period = \"100 ms\"\n");
        sink.name_channels(instrument_->channels());
        boost::asio::co_spawn(loop, run(), boost::asio::detached);
    }
    Task<void> run() {
        const InstrumentContext context{&scheduler_, &links_, &sink};
        const auto result = co_await instrument_->run(context);
        ended = result ? Fault::none : result.error().fault;
    }

    std::vector<std::string> notes_told() {
        std::vector<std::string> notes;
        for (const std::string& line : sink.lines)
            if (line.starts_with("note ")) notes.push_back(line);
        return notes;
    }

    boost::asio::io_context loop;
    testing::SampleRecorder sink{{}, false};
    std::optional<Fault> ended;

private:
    AsioScheduler scheduler_{loop};
    RealLinkOpener links_{scheduler_};
    testing::ScratchFolder folder_;
    std::unique_ptr<Instrument> instrument_;
};

TEST_F(Thermometers, HandUpEachSensorByItsPlaceInTheList) {
    show("28-0000075b3c2a", warm);
    show("28-0000075b3c2b", "50 05 4b 46 7f ff 0c 10 1c : crc=1c YES\n"
                            "50 05 4b 46 7f ff 0c 10 1c t=85000\n");
    start("[\"28-0000075b3c2a\", \"28-0000075b3c2b\"]");
    ASSERT_TRUE(testing::loop_until(loop, [&] { return sink.samples.size() >= 2; }));
    EXPECT_EQ(sink.lines[0], "identity Maxim | DS18B20 | 28-0000075b3c2a 28-0000075b3c2b | ");
    EXPECT_EQ(sink.lines[1], "contact 1 23.125");
    EXPECT_EQ(sink.lines[2], "contact 2 absent");
}

TEST_F(Thermometers, TellWhatIsWrongWithAllOfThemInOneNoteARound) {
    const std::string power_on = "50 05 4b 46 7f ff 0c 10 1c : crc=1c YES\n"
                                 "50 05 4b 46 7f ff 0c 10 1c t=85000\n";
    show("28-0000075b3c2a", power_on);
    show("28-0000075b3c2b", power_on);
    start("[\"28-0000075b3c2a\", \"28-0000075b3c2b\", \"28-0000075b3c2c\"]");
    ASSERT_TRUE(testing::loop_until(loop, [&] { return sink.samples.size() >= 9; }));
    const auto notes = notes_told();
    ASSERT_GE(notes.size(), 2U);
    EXPECT_EQ(notes[0], notes[1]); // whoever listens tells it once
    for (const char* part :
         {"contact 1: 85 degC", "contact 2: 85 degC", "no sensor 28-0000075b3c2c"})
        EXPECT_NE(notes[0].find(part), std::string::npos) << notes[0];
}

/// As the kernel shows a scratchpad whose checksum it found wrong five times: an empty file.
TEST_F(Thermometers, TellWhatCannotBeReadOnlyWhenItLasts) {
    show("28-0000075b3c2a", warm);
    show("28-0000075b3c2b", "");
    start("[\"28-0000075b3c2a\", \"28-0000075b3c2b\"]");
    ASSERT_TRUE(testing::loop_until(loop, [&] { return sink.samples.size() >= 2; }));
    EXPECT_TRUE(notes_told().empty());
    ASSERT_TRUE(testing::loop_until(loop, [&] { return !notes_told().empty(); }));
    EXPECT_GE(sink.samples.size(), 3U);
    EXPECT_NE(notes_told()[0].find("contact 2 was read wrongly 3 times in a row"),
              std::string::npos)
        << notes_told()[0];
    for (const Sample& sample : sink.samples)
        EXPECT_EQ(sample.channel, 0);
}

TEST_F(Thermometers, EndWhenNoneIsThereAndGoOnWhenOneIs) {
    start("[\"28-0000075b3c2a\"]");
    ASSERT_TRUE(testing::loop_until(loop, [&] { return ended.has_value(); }));
    EXPECT_EQ(*ended, Fault::link_closed);
    EXPECT_EQ(sink.samples.at(0).quality(), Quality::absent);
}

Task<void> read_files(LinkOpener& links,
                      LinkSettings folder,
                      MonotonicTime latest,
                      std::vector<std::string>& told) {
    const auto link = co_await links.open(folder, latest);
    const std::vector<std::string> names{"there", "empty", "nowhere"};
    for (const std::string& name : names) {
        const auto letters = std::as_bytes(std::span{name});
        std::vector<std::byte> bytes{letters.begin(), letters.end()};
        co_await (*link)->write_all(std::move(bytes), latest);
        const auto text = co_await (*link)->read_some(latest);
        told.push_back(text ? std::to_string(text->bytes.size())
                            : std::string{fault_name(text.error().fault)});
    }
    told.emplace_back("end");
}

TEST(FilesOfTheKernel, StandOnATapeWithTheirNamesAndWhatIsNotThere) {
    const testing::ScratchFolder folder;
    std::ofstream{folder.path() + "/there"} << "ab";
    std::ofstream{folder.path() + "/empty"} << "";
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    RealLinkOpener real{scheduler};
    std::ostringstream lines;
    RecordingOpener recorder{scheduler, real, lines};
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::files;
    settings.path = folder.path();
    std::vector<std::string> told;
    boost::asio::co_spawn(
        loop, read_files(recorder, settings, scheduler.now() + std::chrono::seconds{10}, told),
        boost::asio::detached);
    ASSERT_TRUE(testing::loop_until(loop, [&] { return told.size() == 4; }));
    EXPECT_EQ(told, (std::vector<std::string>{"2", "0", "not_found", "end"}));
    EXPECT_EQ(recorder.wire(), "files");
    const auto tape = parse_tape("origin = simulator\n" + lines.str());
    ASSERT_TRUE(tape) << lines.str();
    std::string directions;
    for (const TapeEntry& entry : tape->entries)
        directions += static_cast<char>(entry.direction);
    EXPECT_EQ(directions, "><><>x");
    EXPECT_EQ(tape->entries.at(0).bytes.size(), 5U); // "there"
}

TEST(Ds18b20, RefusesNamesThatTheKernelDoesNotGive) {
    for (const char* sensors :
         {"[]", "[\"10-0000075b3c2a\"]", "[\"28-75b3c2a\"]", "[\"28-0000075B3C2A\"]",
          "[\"28-0000075b3c2a\", \"28-0000075b3c2a\"]"})
        EXPECT_EQ(testing::make_instrument("ds18b20", "sensors = " + std::string{sensors} + "\n")
                      .refusals.size(),
                  1U)
            << sensors;
}

} // namespace
} // namespace axiscal::w1_text_test
