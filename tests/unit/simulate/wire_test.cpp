// The wires themselves: a pty that nobody reads, and a CNC against a Modbus server.
#include "cnc/cnc_exchange.hpp"
#include "wire/serial_cable.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <fcntl.h>
#include <filesystem>
#include <modbus.h>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace axiscal::simulate::wire_test {
namespace {

struct ScratchFolder {
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "wire-XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~ScratchFolder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

TEST(Pty, NobodyReadingNeverBlocksAndIsCounted) {
    const ScratchFolder scratch;
    auto pty = Pty::open((scratch.path / "tty").string());
    ASSERT_TRUE(pty);
    const std::string record(100, 'x');
    for (int i = 0; i < 5000; ++i)
        pty->write(record);
    EXPECT_GT(pty->dropped(), 0U);
}

TEST(Pty, KeepsAsMuchForALateReaderAsItWasTold) {
    const ScratchFolder scratch;
    auto pty = Pty::open((scratch.path / "tty").string());
    ASSERT_TRUE(pty);
    pty->keep(1'000'000);
    const std::string record(100, 'x');
    for (int i = 0; i < 5000; ++i) // 500 kB: too many without
        pty->write(record);
    EXPECT_EQ(pty->dropped(), 0U);
}

TEST(Pty, KeepsEverythingForAReaderThatIsLate) {
    const ScratchFolder scratch;
    const std::string link = (scratch.path / "tty").string();
    auto pty = Pty::open(link);
    ASSERT_TRUE(pty);
    const int reader = ::open(link.c_str(), O_RDWR | O_NOCTTY);
    ASSERT_GE(reader, 0);
    std::string sent, got;
    const auto write = [&](int i) {
        const std::string record = std::to_string(1'000'000 + i) + std::string(40, ' ') + "\r\n";
        pty->write(record);
        sent += record;
    };
    for (int i = 0; i < 1000; ++i) // one second of a laser: eleven times what a pty holds
        write(i);
    for (int i = 1000; got.size() < 49'000 && i < 2000; ++i) {
        char bytes[4096];
        const ssize_t n = ::read(reader, bytes, sizeof bytes);
        got.append(bytes, static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
        write(i);
    }
    EXPECT_EQ(pty->dropped(), 0U);
    EXPECT_GE(got.size(), 49'000U);
    EXPECT_EQ(got, sent.substr(0, got.size()));
    ::close(reader);
}

TEST(Pty, CarriesBytesUnchangedBothWays) {
    const ScratchFolder scratch;
    const std::string link = (scratch.path / "tty").string();
    auto pty = Pty::open(link);
    ASSERT_TRUE(pty);
    const int reader = ::open(link.c_str(), O_RDWR | O_NOCTTY);
    ASSERT_GE(reader, 0);
    pty->write("1 2 3\r\n");
    char got[16] = {};
    EXPECT_EQ(::read(reader, got, sizeof got), 7);
    EXPECT_EQ(std::string{got}, "1 2 3\r\n");
    EXPECT_EQ(::write(reader, "INFO\r", 5), 5);
    EXPECT_EQ(pty->read(std::chrono::milliseconds{5000}), "INFO\r");
    ::close(reader);
}

TEST(Pty, ReplacesOnlySymlinks) {
    const ScratchFolder scratch;
    const auto file = scratch.path / "precious";
    ::close(::open(file.c_str(), O_CREAT | O_WRONLY, 0600));
    EXPECT_FALSE(Pty::open(file.string()));
    EXPECT_TRUE(std::filesystem::is_regular_file(file));
}

/// A daemon of the test: holds 33 words, tells when a request has come.
struct Station {
    Station() {
        for (int word = 0; word < 33; ++word)
            bank.holding[word] = 0;
        auto opened = TcpSlave::listen(0, [this](int, std::span<const std::uint8_t> pdu) {
            const std::lock_guard lock{mutex};
            Bytes answer = answer_pdu(bank, pdu);
            news.notify_all();
            return answer;
        });
        slave = std::move(*opened);
        thread = std::jthread{[this](std::stop_token stop) { slave->run(stop); }};
    }
    bool wait_for_sequence(std::uint16_t sequence) {
        std::unique_lock lock{mutex};
        return news.wait_for(lock, std::chrono::seconds{20},
                             [&] { return bank.holding[2] == sequence; });
    }
    std::mutex mutex;
    std::condition_variable news;
    RegisterBank bank;
    std::unique_ptr<TcpSlave> slave;
    std::jthread thread;
};

TEST(CncClient, WritesItsBlockAndHearsTheAcknowledge) {
    Station station;
    CncScenario scenario;
    scenario.port = station.slave->port();
    CncLines lines{scenario};
    const SimClock clock;
    CncClient client{scenario, lines, clock};
    std::jthread exchange{[&](std::stop_token stop) { client.run(stop); }};
    lines.set_analog(3, 25, 0);
    lines.set_analog(0, 4, 0);
    ASSERT_TRUE(station.wait_for_sequence(4));
    {
        const std::lock_guard lock{station.mutex};
        EXPECT_EQ(station.bank.holding[1], 2); // capture now
        EXPECT_EQ(station.bank.holding[5] * 65536 + station.bank.holding[6], 250000);
        station.bank.holding[18] = 4;
    }
    std::unique_lock lock{station.mutex};
    EXPECT_TRUE(
        station.news.wait_for(lock, std::chrono::seconds{20}, [&] { return lines.input(0); }));
}

/// Answers RTU requests at the station's end of the cable.
void serve_rtu(std::stop_token stop, const std::string& path, Station& station) {
    const int line = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    Bytes pending;
    while (!stop.stop_requested()) {
        pollfd wait{line, POLLIN, 0};
        std::uint8_t chunk[256];
        if (::poll(&wait, 1, 20) <= 0) continue;
        const ssize_t n = ::read(line, chunk, sizeof chunk);
        if (n > 0) pending.insert(pending.end(), chunk, chunk + n);
        const auto length = rtu_request_length(pending);
        if (!length || pending.size() < *length) continue;
        const std::lock_guard lock{station.mutex};
        const auto pdu = std::span{pending}.subspan(1, *length - 3);
        const Bytes reply = rtu_frame(pending[0], answer_pdu(station.bank, pdu));
        EXPECT_EQ(::write(line, reply.data(), reply.size()), std::ssize(reply));
        pending.clear();
        station.news.notify_all();
    }
    ::close(line);
}

TEST(CncClient, SpeaksRtuOverTheCable) {
    const ScratchFolder scratch;
    const std::string ours = (scratch.path / "cnc").string();
    const std::string theirs = (scratch.path / "station").string();
    auto cable = SerialCable::open(theirs, ours);
    ASSERT_TRUE(cable);
    Station station;
    CncScenario scenario;
    scenario.transport = "rtu";
    scenario.path = ours;
    CncLines lines{scenario};
    const SimClock clock;
    CncClient client{scenario, lines, clock};
    std::jthread carry{[&](std::stop_token stop) { (*cable)->run(stop); }};
    std::jthread serve{[&](std::stop_token stop) { serve_rtu(stop, theirs, station); }};
    std::jthread exchange{[&](std::stop_token stop) { client.run(stop); }};
    lines.set_analog(0, 6, 0);
    EXPECT_TRUE(station.wait_for_sequence(6));
}

TEST(CncServer, IsTheMirroredBlockForAClient) {
    CncScenario scenario;
    scenario.transport = "server";
    scenario.base_address = 0x8000;
    CncLines lines{scenario};
    lines.set_analog(1, 3, 0);
    lines.set_analog(0, 8, 0);
    auto server = CncServer::open(scenario, lines, SimClock{});
    ASSERT_TRUE(server);
    std::jthread thread{[&](std::stop_token stop) { (*server)->run(stop); }};
    modbus_t* station = modbus_new_tcp("127.0.0.1", (*server)->port());
    ASSERT_EQ(modbus_connect(station), 0);
    std::uint16_t words[9] = {};
    ASSERT_EQ(modbus_read_registers(station, 0x8001, 9, words), 9);
    EXPECT_EQ(words[1], 8); // CMD_SEQ
    EXPECT_EQ(words[2], 3); // TARGET_INDEX
    const std::uint16_t done[2] = {8, 0};
    EXPECT_EQ(modbus_write_registers(station, 0x8012, 2, done), 2);
    EXPECT_TRUE(lines.input(0));
    EXPECT_EQ(modbus_write_register(station, 0x8012, 1), -1); // no FC 6 there
    modbus_close(station);
    modbus_free(station);
}

} // namespace
} // namespace axiscal::simulate::wire_test
