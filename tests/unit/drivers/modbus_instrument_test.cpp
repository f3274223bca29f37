// The Modbus driver against libmodbus as a server (TCP) and against literal bytes (RTU on a pty).
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/recording/tape_link.hpp"
#include "drivers/wire/serial_link.hpp"
#include "tests/support/loop_until.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/pty_pair.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/watched_opener.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/socket.h>
#include <thread>

namespace axiscal::modbus_instrument_test {
namespace {

using boost::asio::ip::tcp;

const std::string shipped = test::source_dir() + "/config/profiles/";

std::string profile_keys(const std::string& name) {
    return "profile = \"" + shipped + name + ".toml\"\n";
}

/// The shipped XY-MD02 with more patience: a late answer is another test's.
class PatientXyMd02 {
public:
    PatientXyMd02() {
        std::ifstream file{shipped + "xy-md02.toml"};
        std::stringstream text;
        text << file.rdbuf();
        std::string profile = text.str();
        const std::string usual = "timeout = \"300 ms\"";
        profile.replace(profile.find(usual), usual.size(), "timeout = \"1 s\"");
        std::ofstream{path()} << profile;
    }
    [[nodiscard]] std::string keys(const testing::PtyPair& pty) const {
        return "profile = \"" + path() + "\"\nlink = \"serial:" + pty.path +
               "\"\npoll_period = \"20 ms\"\n";
    }

private:
    [[nodiscard]] std::string path() const { return scratch_.path() + "/xy-md02.toml"; }
    testing::ScratchFolder scratch_;
};

/// Instruments sharing one loop and one set of lines.
class Station {
public:
    struct Running {
        std::unique_ptr<Instrument> instrument;
        testing::SampleRecorder sink{MonotonicTime{}, false};
        std::optional<Fault> ended;
        std::string last_words;
    };
    Running& start(const std::string& keys, const std::string& driver = "modbus") {
        running_.push_back(std::make_unique<Running>());
        Running& one = *running_.back();
        one.instrument = testing::instrument(driver, keys);
        one.sink.name_channels(one.instrument->channels());
        boost::asio::co_spawn(loop, run(one), boost::asio::detached);
        return one;
    }
    template <class Condition> bool until(Condition condition) {
        return testing::loop_until(loop, condition);
    }

    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    testing::WatchedOpener opener{scheduler};

private:
    Task<void> run(Running& one) {
        const InstrumentContext context{&scheduler, &opener, &one.sink};
        const auto result = co_await one.instrument->run(context);
        if (!result) one.last_words = result.error().detail;
        one.ended = result ? Fault::none : result.error().fault;
    }
    std::vector<std::unique_ptr<Running>> running_;
};

/// A foreign server: libmodbus on 127.0.0.1, a port the system chose.
class TcpServer {
public:
    TcpServer()
        : map_{::modbus_mapping_new(0, 0, 0x1040, 16)}
        , context_{::modbus_new_tcp("127.0.0.1", 0)}
        , listener_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        ::bind(listener_, reinterpret_cast<sockaddr*>(&address), size);
        ::listen(listener_, 4);
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
        port = ntohs(address.sin_port);
    }
    ~TcpServer() {
        ::shutdown(listener_, SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
        ::close(listener_);
        ::modbus_mapping_free(map_);
        ::modbus_free(context_);
    }
    TcpServer(const TcpServer&) = delete;
    TcpServer& operator=(const TcpServer&) = delete;
    void hold(int address, int value) {
        map_->tab_registers[address] = static_cast<std::uint16_t>(value);
    }
    void hold_input(int address, int value) {
        map_->tab_input_registers[address] = static_cast<std::uint16_t>(value);
    }
    void serve() {
        thread_ = std::thread{[this] {
            while (::modbus_tcp_accept(context_, &listener_) >= 0) {
                std::uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
                for (int size = 0; (size = ::modbus_receive(context_, query)) >= 0;)
                    if (size > 0) ::modbus_reply(context_, query, size, map_);
                ::modbus_close(context_);
            }
        }};
    }
    [[nodiscard]] std::string keys() const {
        return "link = \"tcp:127.0.0.1:" + std::to_string(port) + "\"\n";
    }

    int port = 0;

private:
    modbus_mapping_t* map_;
    modbus_t* context_;
    int listener_;
    std::thread thread_;
};

/// Answers the requests of a tape with its replies; remembers a request that is another.
class RtuTapeServer {
public:
    explicit RtuTapeServer(const std::string& name) {
        std::ifstream file{test::source_dir() + "/tests/traces/" + name + ".tape"};
        std::stringstream text;
        text << file.rdbuf();
        tape_ = parse_tape(text.str()).value();
        thread_ = std::thread{[this] { answer(); }};
    }
    ~RtuTapeServer() { thread_.join(); }
    RtuTapeServer(const RtuTapeServer&) = delete;
    RtuTapeServer& operator=(const RtuTapeServer&) = delete;

    testing::PtyPair pty;
    std::atomic<int> wrong_requests = 0;

private:
    void answer() {
        for (const TapeEntry& entry : tape_.entries) {
            const std::string bytes{reinterpret_cast<const char*>(entry.bytes.data()),
                                    entry.bytes.size()};
            if (entry.direction == TapeEntry::Direction::in)
                pty.send(bytes);
            else if (pty.receive(bytes.size()) != bytes)
                ++wrong_requests;
        }
    }
    Tape tape_;
    std::thread thread_;
};

std::vector<std::string> expected_lines(const std::string& name) {
    std::ifstream file{test::source_dir() + "/tests/traces/" + name + ".expected"};
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
        lines.push_back(line);
    return lines;
}

class RtuTape : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(RtuTape, GivesExactlyWhatIsExpected) {
    const auto [tape, profile] = GetParam();
    const auto expected = expected_lines(tape);
    RtuTapeServer server{tape};
    Station station;
    const auto& sensor =
        station.start(profile_keys(profile) + "link = \"serial:" + server.pty.path +
                      "\"\npoll_period = \"20 ms\"\n");
    ASSERT_TRUE(station.until([&] { return sensor.sink.lines.size() >= expected.size(); }));
    const std::vector<std::string> got{sensor.sink.lines.begin(),
                                       sensor.sink.lines.begin() +
                                           static_cast<std::ptrdiff_t>(expected.size())};
    EXPECT_EQ(got, expected);
    EXPECT_EQ(server.wrong_requests, 0);
}

INSTANTIATE_TEST_SUITE_P(Instruments,
                         RtuTape,
                         ::testing::Values(std::pair{"modbus-xy-md02", "xy-md02"},
                                           std::pair{"modbus-tm-th8", "tm-th8"},
                                           std::pair{"modbus-comet-t7310", "comet-t7310"},
                                           std::pair{"modbus-m-7015", "m-7015"},
                                           std::pair{"modbus-vaisala-hmp", "vaisala-hmp"}),
                         [](const auto& which) {
                             std::string name = which.param.second;
                             std::erase(name, '-');
                             return name;
                         });

/// The same over TCP: libmodbus numbers its transactions from 1.
class TcpTapeServer {
public:
    explicit TcpTapeServer(const std::string& name) {
        std::ifstream file{test::source_dir() + "/tests/traces/" + name + ".tape"};
        std::stringstream text;
        text << file.rdbuf();
        tape_ = parse_tape(text.str()).value();
        thread_ = std::thread{[this] { answer(); }};
    }
    ~TcpTapeServer() { thread_.join(); }
    TcpTapeServer(const TcpTapeServer&) = delete;
    TcpTapeServer& operator=(const TcpTapeServer&) = delete;
    [[nodiscard]] std::string keys() const {
        return "link = \"tcp:127.0.0.1:" + std::to_string(acceptor_.local_endpoint().port()) +
               "\"\npoll_period = \"20 ms\"\n";
    }
    std::atomic<int> wrong_requests = 0;

private:
    void answer() {
        tcp::socket peer = acceptor_.accept();
        for (const TapeEntry& entry : tape_.entries) {
            boost::system::error_code ended;
            std::vector<std::byte> bytes(entry.bytes.size());
            if (entry.direction == TapeEntry::Direction::in)
                boost::asio::write(peer, boost::asio::buffer(entry.bytes), ended);
            else
                boost::asio::read(peer, boost::asio::buffer(bytes), ended);
            if (entry.direction == TapeEntry::Direction::out && bytes != entry.bytes)
                ++wrong_requests;
        }
    }
    boost::asio::io_context loop_;
    tcp::acceptor acceptor_{loop_, {boost::asio::ip::address_v4::loopback(), 0}};
    Tape tape_;
    std::thread thread_;
};

class TcpTape : public ::testing::TestWithParam<const char*> {};

TEST_P(TcpTape, GivesExactlyWhatIsExpected) {
    const std::string name = GetParam();
    const auto expected = expected_lines("modbus-" + name);
    TcpTapeServer server{"modbus-" + name};
    Station station;
    const auto& sensor = station.start(profile_keys(name) + server.keys());
    ASSERT_TRUE(station.until([&] { return sensor.sink.lines.size() >= expected.size(); }));
    const std::vector<std::string> got{sensor.sink.lines.begin(),
                                       sensor.sink.lines.begin() +
                                           static_cast<std::ptrdiff_t>(expected.size())};
    EXPECT_EQ(got, expected);
    EXPECT_EQ(server.wrong_requests, 0);
}

INSTANTIATE_TEST_SUITE_P(Instruments,
                         TcpTape,
                         ::testing::Values("vaisala-indigo",
                                           "comet-t7510",
                                           "labjack-t7-thermocouple",
                                           "labjack-t7-lvdt"),
                         [](const auto& which) {
                             std::string name = which.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(ModbusSensorTcp, ReadsACometFromAForeignServer) {
    TcpServer server;
    server.hold(0x31, 231);
    server.hold(0x32, 456);
    server.hold(0x34, 10132);
    server.hold(0x1035, 0x1694);
    server.hold(0x1036, 0x0123);
    server.serve();
    Station station;
    const auto& air = station.start(profile_keys("comet-t7510") + server.keys());
    ASSERT_TRUE(station.until([&] { return !air.sink.identities.empty(); }));
    EXPECT_EQ(air.sink.identities[0].serial, "16940123");
    ASSERT_GE(air.sink.samples.size(), 3u);
    EXPECT_NEAR(air.sink.samples[0].value().value(), 23.1, 1e-12);
    EXPECT_NEAR(air.sink.samples[1].value().value(), 45.6, 1e-12);
    EXPECT_NEAR(air.sink.samples[2].value().value(), 101320, 1e-9);
}

TEST(ModbusSensorTcp, PlacesAReadingBetweenItsRequestAndItsAnswer) {
    TcpServer server;
    server.serve();
    Station station;
    const MonotonicTime begin = station.scheduler.now();
    const auto& air = station.start(profile_keys("comet-t7510") + server.keys());
    ASSERT_TRUE(station.until([&] { return air.sink.samples.size() >= 3; }));
    const MonotonicTime end = station.scheduler.now();
    for (const Sample& sample : air.sink.samples) {
        // sqrt(3) of its u(t) is half of the time between request and answer (GUM 4.3.7).
        const Duration half = from_seconds(seconds_of(sample.time_uncertainty) * std::sqrt(3.0));
        EXPECT_GT(half, Duration{});
        EXPECT_GE(sample.at - half, begin - Duration{2});
        EXPECT_LE(sample.at + half, end + Duration{2});
    }
}

TEST(ModbusSensorTcp, TellsAnAddressOffsetThatIsWrongByTheSerialNumber) {
    TcpServer server;
    server.hold(0x1034, 0xFFFF);
    server.hold(0x1035, 0x1694);
    server.serve();
    Station station;
    const auto& air =
        station.start(profile_keys("comet-t7510") + server.keys() + "address_offset = -1\n");
    ASSERT_TRUE(station.until([&] { return !air.sink.notes.empty(); }));
    EXPECT_EQ(air.sink.notes[0], Fault::bad_configuration);
}

/// The sensor adds its register 0x0103, in tenths of a degree, to what it measures.
TEST(ModbusSensorTcp, AnOwnCorrectionOfTheSensorLeavesNoNumberAndIsTold) {
    TcpServer server;
    server.hold_input(1, 245);
    server.hold_input(2, 546);
    server.hold(0x103, -5);
    server.serve();
    Station station;
    const auto& air =
        station.start(profile_keys("xy-md02") + server.keys() + "poll_period = \"20 ms\"\n");
    ASSERT_TRUE(station.until([&] { return air.sink.samples.size() >= 6; }));
    for (const Sample& sample : air.sink.samples)
        EXPECT_EQ(sample.quality(), sample.channel == 0 ? Quality::absent : Quality::good);
    EXPECT_EQ(air.sink.notes, std::vector{Fault::bad_configuration}) << "once";
    EXPECT_FALSE(air.ended);
}

TEST(ModbusSensorTcp, ASettingThatItDoesNotShowIsToldAndTakenAsStated) {
    testing::ScratchFolder scratch;
    const std::string path = scratch.path() + "/plain.toml";
    std::ofstream{path} << "maker = \"M\"\nmodel = \"X\"\npoll_period = \"20 ms\"\n"
                           "[[setting]]\nname = \"unit\"\nfunction = 1\naddress = 7\nmust_be = 1\n"
                           "[[channel]]\nname = \"t\"\nmedium = \"air\"\nunit = \"degC\"\n"
                           "function = 4\naddress = 1\ntype = \"s16\"\n";
    TcpServer server; // without coils
    server.serve();
    Station station;
    const auto& sensor = station.start("profile = \"" + path + "\"\n" + server.keys());
    ASSERT_TRUE(station.until([&] { return sensor.sink.samples.size() >= 3; }));
    for (const Sample& sample : sensor.sink.samples)
        EXPECT_EQ(sample.quality(), Quality::good);
    EXPECT_EQ(sensor.sink.notes, std::vector{Fault::refused});
}

TEST(ModbusSensorTcp, AnExceptionMakesTheChannelAbsentAndIsToldOnce) {
    testing::ScratchFolder scratch;
    const std::string path = scratch.path() + "/two.toml";
    std::ofstream{path} << "maker = \"M\"\nmodel = \"X\"\npoll_period = \"20 ms\"\n";
    for (const int address : {1, 100}) // the server holds 16 input registers
        std::ofstream{path, std::ios::app}
            << "[[channel]]\nname = \"at " << address << "\"\nmedium = \"air\"\nunit = \"degC\"\n"
            << "function = 4\naddress = " << address << "\ntype = \"s16\"\n";
    TcpServer server;
    server.serve();
    Station station;
    const auto& sensor = station.start("profile = \"" + path + "\"\n" + server.keys());
    ASSERT_TRUE(station.until([&] { return sensor.sink.samples.size() >= 6; }));
    for (const Sample& sample : sensor.sink.samples)
        EXPECT_EQ(sample.quality(), sample.channel == 0 ? Quality::good : Quality::absent);
    EXPECT_EQ(sensor.sink.notes, std::vector{Fault::refused});
    EXPECT_FALSE(sensor.ended);
}

TEST(ModbusSensorTcp, APeerThatAcceptsAndNeverAnswersEndsInATimeoutAndBlocksNothing) {
    Station station;
    tcp::acceptor silent{station.loop, {boost::asio::ip::address_v4::loopback(), 0}};
    const std::string link =
        "link = \"tcp:127.0.0.1:" + std::to_string(silent.local_endpoint().port()) + "\"\n";
    const auto& sensor =
        station.start(profile_keys("xy-md02") + link + "poll_period = \"20 ms\"\n");
    testing::PtyPair pty;
    const auto& air =
        station.start("link = \"serial:" + pty.path + "\"\npoll_period = \"10 s\"\n", "dracal-vcp");
    ASSERT_TRUE(station.until([&] { return station.opener.answers() > 0; }));
    int seen_meanwhile = 0;
    while (!sensor.ended) {
        pty.send("D,VCP-PTH450,E18890,,101182,Pa,24.8344,C,59.8779,%,*3FB5\r\n");
        const auto wanted = air.sink.samples.size() + 3;
        ASSERT_TRUE(station.until([&] { return air.sink.samples.size() >= wanted; }));
        ++seen_meanwhile;
    }
    EXPECT_EQ(*sensor.ended, Fault::link_timeout);
    EXPECT_EQ(sensor.instrument->counters().timeouts, 3u);
    EXPECT_GT(seen_meanwhile, 3); // three time-outs of 300 ms hold no reading back
    for (const Sample& sample : sensor.sink.samples)
        EXPECT_FALSE(sample.value());
}

TEST(ModbusSensorTcp, ADeadPeerIsToldAndComesBackByItself) {
    TcpServer server; // listening, not yet serving
    Station station;
    int dead_port = 0;
    {
        tcp::acceptor gone{station.loop, {boost::asio::ip::address_v4::loopback(), 0}};
        dead_port = gone.local_endpoint().port();
    }
    const auto& dead = station.start(
        profile_keys("xy-md02") + "link = \"tcp:127.0.0.1:" + std::to_string(dead_port) + "\"\n");
    ASSERT_TRUE(station.until([&] { return dead.ended.has_value(); }));
    EXPECT_EQ(*dead.ended, Fault::link_closed);
    const auto& late =
        station.start(profile_keys("xy-md02") + server.keys() + "poll_period = \"20 ms\"\n");
    ASSERT_TRUE(station.until([&] { return late.instrument->counters().timeouts >= 1; }));
    server.serve();
    ASSERT_TRUE(station.until([&] {
        return std::ranges::any_of(late.sink.samples,
                                   [](const Sample& sample) { return sample.value().has_value(); });
    }));
}

/// What an XY-MD02 as delivered answers: no own correction, 24.5 degC and 54.6 %.
std::string xy_md02_answer(const std::string& request, bool of_values_damaged = false) {
    const std::string unit = request.substr(0, 1);
    const bool first = unit == "\x01";
    if (request[1] == 3)
        return unit + std::string("\x03\x04\0\0\0\0", 6) + (first ? "\xFA\x33" : "\xC9\x33");
    std::string checksum = first ? "\x6A\xCF" : "\x59\xCF";
    if (of_values_damaged) checksum[1] = '\xCE';
    return unit + std::string("\x04\x04\x00\xF5\x02\x22", 6) + checksum;
}

/// Two instruments on one line: requests take turns on one bus, each gets its own answer.
TEST(ModbusSensorRtu, TwoInstrumentsShareOneLine) {
    testing::PtyPair pty;
    std::atomic<bool> stop = false;
    std::thread line{[&] {
        while (!stop) {
            const std::string request = pty.receive(8, 100);
            if (request.size() == 8 && request[0] <= 2) pty.send(xy_md02_answer(request));
        }
    }};
    {
        Station station;
        const std::string keys = profile_keys("xy-md02") + "link = \"serial:" + pty.path +
                                 "\"\npoll_period = \"20 ms\"\n";
        const auto& first = station.start(keys + "unit_id = 1\n");
        const auto& second = station.start(keys + "unit_id = 2\n");
        const auto& other_rate = station.start(keys + "unit_id = 3\nbaud = 19200\n");
        EXPECT_TRUE(station.until([&] {
            return first.sink.samples.size() >= 6 && second.sink.samples.size() >= 6 &&
                   other_rate.ended;
        }));
        EXPECT_EQ(station.opener.modbus_buses()->size(), 1u);
        EXPECT_EQ(other_rate.ended, Fault::bad_configuration);
        EXPECT_EQ(first.sink.samples[0].value(), second.sink.samples[0].value());
        EXPECT_EQ(first.instrument->counters().checksum_errors, 0u);
    }
    stop = true;
    line.join();
}

/// A setting that is changed while the station reads.
TEST(ModbusSensorRtu, IsAskedBeforeEachReadingHowItIsSet) {
    const PatientXyMd02 profile;
    testing::PtyPair pty;
    std::thread line{[&] {
        for (int turn = 0; turn < 6; ++turn) {
            const std::string request = pty.receive(8);
            if (request.size() != 8) return;
            const bool corrected = turn == 2; // 0x0103 holds 5
            pty.send(corrected ? std::string("\x01\x03\x04\0\x05\0\0\xEA\x32", 9)
                               : xy_md02_answer(request));
        }
    }};
    {
        Station station;
        const auto& air = station.start(profile.keys(pty));
        EXPECT_TRUE(station.until([&] { return air.sink.samples.size() >= 6; }));
        std::vector<Quality> temperature, humidity;
        for (const Sample& sample : air.sink.samples)
            (sample.channel == 0 ? temperature : humidity).push_back(sample.quality());
        temperature.resize(3);
        humidity.resize(3);
        EXPECT_EQ(temperature, (std::vector{Quality::good, Quality::absent, Quality::good}));
        EXPECT_EQ(humidity, (std::vector{Quality::good, Quality::good, Quality::good}));
    }
    line.join();
}

TEST(ModbusSensorRtu, OneThatTellsItsValuesAndNotHowItIsSetSaysSo) {
    testing::PtyPair pty;
    std::atomic<bool> stop = false;
    std::thread line{[&] {
        while (!stop) {
            const std::string request = pty.receive(8, 100);
            if (request.size() == 8 && request[1] == 4) pty.send(xy_md02_answer(request));
        }
    }};
    {
        Station station;
        const auto& air = station.start(profile_keys("xy-md02") + "link = \"serial:" + pty.path +
                                        "\"\npoll_period = \"20 ms\"\n");
        EXPECT_TRUE(station.until([&] { return air.ended.has_value(); }));
        EXPECT_EQ(air.ended, Fault::link_timeout);
        EXPECT_NE(air.last_words.find("does not answer how it is set"), std::string::npos)
            << air.last_words;
        EXPECT_TRUE(air.sink.samples.empty());
    }
    stop = true;
    line.join();
}

/// /dev/serial/by-id holds links: two masters on one adapter would take each other's answers.
TEST(ModbusSensorRtu, TwoNamesOfOneAdapterAreOneLine) {
    testing::ScratchFolder scratch;
    testing::PtyPair pty;
    const std::string by_id = scratch.path() + "/usb-FTDI-port0";
    std::filesystem::create_symlink(pty.path, by_id);
    Station station;
    LinkSettings settings;
    settings.path = pty.path;
    ModbusBuses& buses = *station.opener.modbus_buses();
    const auto bus = buses.bus(settings);
    settings.path = by_id;
    EXPECT_EQ(buses.bus(settings).value(), bus.value());
    settings.path = scratch.path() + "/./usb-FTDI-port0";
    EXPECT_EQ(buses.bus(settings).value(), bus.value());
    settings.baud = 19200;
    EXPECT_EQ(buses.bus(settings).error().fault, Fault::bad_configuration);
}

TEST(ModbusSensorRtu, ItsLineIsHeldAlone) {
    testing::PtyPair pty;
    Station station;
    const auto& sensor =
        station.start(profile_keys("xy-md02") + "link = \"serial:" + pty.path + "\"\n");
    ASSERT_TRUE(station.until([&] { return !pty.receive(8, 0).empty(); })) << "it asks";
    EXPECT_EQ(sensor.instrument->counters().timeouts, 0U) << "and waits for an answer";
    LinkSettings settings;
    settings.path = pty.path;
    EXPECT_EQ(open_tty(settings).error().fault, Fault::link_closed);
}

std::string refusals(const std::string& keys) {
    std::string told;
    for (const Refusal& refusal : testing::make_instrument("modbus", keys).refusals)
        told += refusal.describe() + "\n";
    return told;
}

// Modbus over serial line V1.02, 2.2.
TEST(ModbusStation, AUnitOnASerialLineHas1To247) {
    const std::string serial = profile_keys("xy-md02") + "link = \"serial:/dev/ttyUSB0\"\n";
    const std::string tcp = profile_keys("xy-md02") + "link = \"tcp:gateway:502\"\n";
    for (const int unit : {0, 248, 250, 255}) {
        const std::string key = "unit_id = " + std::to_string(unit) + "\n";
        EXPECT_NE(refusals(serial + key).find("unit_id"), std::string::npos) << unit;
        EXPECT_EQ(refusals(tcp + key), "") << unit;
    }
    for (const int unit : {1, 247})
        EXPECT_EQ(refusals(serial + "unit_id = " + std::to_string(unit) + "\n"), "") << unit;
}

TEST(ModbusStation, AnOffsetDoesNotMoveARegisterOffTheWire) {
    const std::string keys =
        profile_keys("m-7015") + "link = \"serial:/dev/ttyUSB0\"\naddress_offset = "; // from 0
    EXPECT_NE(refusals(keys + "-1\n").find("address_offset"), std::string::npos);
    EXPECT_EQ(refusals(keys + "1\n"), "");
}

TEST(ModbusSensorRtu, ADamagedReplyIsCountedAndGivesNoNumber) {
    const PatientXyMd02 profile;
    testing::PtyPair pty;
    std::thread line{[&] {
        for (int turn = 0; turn < 6; ++turn) {
            const std::string request = pty.receive(8);
            if (request.size() != 8) return;
            pty.send(xy_md02_answer(request, true));
        }
    }};
    {
        Station station;
        const auto& sensor = station.start(profile.keys(pty));
        EXPECT_TRUE(station.until([&] { return sensor.ended.has_value(); }));
        EXPECT_EQ(sensor.ended, Fault::checksum) << "and not that it is silent";
        EXPECT_EQ(sensor.instrument->counters().checksum_errors, 3u);
        EXPECT_TRUE(sensor.sink.samples.empty());
    }
    line.join();
}

TEST(ModbusSensorRtu, OneDamagedReplyDoesNotMakeTheSensorAbsent) {
    const PatientXyMd02 profile;
    testing::PtyPair pty;
    std::thread line{[&] {
        for (int turn = 0; turn < 6; ++turn) {
            const std::string request = pty.receive(8);
            if (request.size() != 8) return;
            pty.send(xy_md02_answer(request, turn / 2 == 1));
        }
    }};
    {
        Station station;
        const auto& sensor = station.start(profile.keys(pty));
        EXPECT_TRUE(station.until([&] { return sensor.sink.samples.size() >= 4; }));
        EXPECT_EQ(sensor.instrument->counters().checksum_errors, 1u);
        for (const Sample& sample : sensor.sink.samples)
            EXPECT_EQ(sample.quality(), Quality::good);
    }
    line.join();
}

} // namespace
} // namespace axiscal::modbus_instrument_test
