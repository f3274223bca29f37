// Real descriptors: ptys and loopback sockets. No test waits for a span of time to pass.
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/link_opener.hpp"
#include "drivers/wire/link_settings.hpp"
#include "drivers/wire/serial_link.hpp"
#include "tests/support/loop_until.hpp"
#include "tests/support/pty_pair.hpp"
#include "tests/support/scratch_folder.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sys/ioctl.h>

namespace axiscal::link_test {
namespace {

using boost::asio::ip::tcp;

std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::vector<std::byte> bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span{text});
    return {bytes.begin(), bytes.end()};
}

template <class T> Task<void> keep(Task<T> task, std::optional<T>& result) {
    result = co_await std::move(task);
}

struct Bench {
    template <class T> T wait(Task<T> task) {
        std::optional<T> result;
        boost::asio::co_spawn(loop, keep(std::move(task), result), boost::asio::detached);
        EXPECT_TRUE(testing::loop_until(loop, [&] { return result.has_value(); }));
        return *std::move(result);
    }
    std::unique_ptr<ByteLink> open(const LinkSettings& settings) {
        auto opened = wait(opener.open(settings, soon()));
        EXPECT_TRUE(opened) << describe(opened.error());
        return *std::move(opened);
    }
    [[nodiscard]] MonotonicTime soon() const { return scheduler.now() + std::chrono::seconds{10}; }

    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    RealLinkOpener opener{scheduler};
};

LinkSettings serial(const std::string& path) {
    LinkSettings settings;
    settings.path = path;
    return settings;
}
LinkSettings tcp_at(int port) {
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::tcp;
    settings.host = "127.0.0.1";
    settings.port = port;
    return settings;
}

TEST(SerialLink, CarriesEveryByteUntouched) {
    testing::PtyPair pty;
    Bench bench;
    const auto link = bench.open(serial(pty.path));
    std::string all;
    for (int value = 0; value < 256; ++value)
        all += static_cast<char>(value);
    pty.send(all);
    std::string got;
    while (got.size() < all.size()) {
        const MonotonicTime before = bench.scheduler.now();
        const auto arrived = bench.wait(link->read_some(bench.soon()));
        ASSERT_TRUE(arrived);
        EXPECT_GE(arrived->read_at, before);
        got += text_of(arrived->bytes);
    }
    EXPECT_EQ(got, all);
    EXPECT_TRUE(bench.wait(link->write_all(bytes_of(all), bench.soon())));
    EXPECT_EQ(pty.receive(all.size()), all);
}

TEST(SerialLink, SaysTimeoutAtTheDeadlineAndStaysOpen) {
    testing::PtyPair pty;
    Bench bench;
    const auto link = bench.open(serial(pty.path));
    const auto silent = bench.wait(link->read_some(bench.scheduler.now()));
    ASSERT_FALSE(silent);
    EXPECT_EQ(silent.error().fault, Fault::link_timeout);
    pty.send("x");
    EXPECT_TRUE(bench.wait(link->read_some(bench.soon())));
}

TEST(SerialLink, SaysClosedWhenTheOtherEndIsGone) {
    testing::PtyPair pty;
    Bench bench;
    const auto link = bench.open(serial(pty.path));
    pty.unplug();
    const auto gone = bench.wait(link->read_some(bench.soon()));
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().fault, Fault::link_closed);
    EXPECT_NE(gone.error().detail.find(pty.path), std::string::npos);
    EXPECT_FALSE(bench.wait(link->write_all(bytes_of("x"), bench.soon())));
}

TEST(SerialLink, WriteEndsAtTheDeadlineWhenNobodyReads) {
    testing::PtyPair pty;
    Bench bench;
    const auto link = bench.open(serial(pty.path));
    const MonotonicTime deadline = bench.scheduler.now() + std::chrono::milliseconds{20};
    const auto stuck = bench.wait(link->write_all(bytes_of(std::string(1 << 20, 'x')), deadline));
    ASSERT_FALSE(stuck);
    EXPECT_EQ(stuck.error().fault, Fault::link_timeout);
}

TEST(SerialLink, BelongsToOneProgramAndIsFreeAfterwards) {
    testing::PtyPair pty;
    Bench bench;
    auto link = bench.open(serial(pty.path));
    const auto second = bench.wait(bench.opener.open(serial(pty.path), bench.soon()));
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().fault, Fault::link_closed);
    link.reset();
    EXPECT_NE(bench.open(serial(pty.path)), nullptr);
}

/// socat and its like keep a pty while the station's service, which is not root, is started anew.
TEST(SerialLink, APtyIsNotExclusiveForAProgramThatWasKilled) {
    testing::PtyPair pty;
    LinkSettings settings;
    settings.path = pty.path;
    const auto tty = open_tty(settings);
    ASSERT_TRUE(tty) << describe(tty.error());
    int exclusive = -1;
    EXPECT_EQ(::ioctl(*tty, TIOCGEXCL, &exclusive), 0);
    EXPECT_EQ(exclusive, 0);
    EXPECT_EQ(open_tty(settings).error().fault, Fault::link_closed) << "held alone all the same";
    ::close(*tty);
}

TEST(SerialLink, RefusesWhatIsNoSerialLine) {
    Bench bench;
    const auto no_tty = bench.wait(bench.opener.open(serial("/dev/null"), bench.soon()));
    ASSERT_FALSE(no_tty);
    EXPECT_NE(no_tty.error().detail.find("is not a serial line"), std::string::npos);
    const auto missing = bench.wait(bench.opener.open(serial("/dev/axiscal-none"), bench.soon()));
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().fault, Fault::link_closed);
    LinkSettings odd = serial("/dev/null");
    odd.baud = 12345;
    EXPECT_EQ(bench.wait(bench.opener.open(odd, bench.soon())).error().fault,
              Fault::bad_configuration);
}

TEST(SerialLink, ReadsBackTheLatencyTimerOfTheAdapter) {
    testing::ScratchFolder scratch;
    const std::string device = scratch.path() + "/ttyUSB7";
    std::ofstream{device} << "";
    std::filesystem::create_directories(scratch.path() + "/bus/usb-serial/devices/ttyUSB7");
    std::ofstream{scratch.path() + "/bus/usb-serial/devices/ttyUSB7/latency_timer"} << "16\n";
    EXPECT_EQ(usb_latency_timer_ms(device, scratch.path()), 16);
    EXPECT_EQ(usb_latency_timer_ms("/dev/null", scratch.path()), std::nullopt);
}

TEST(TcpLink, CarriesBytesBothWaysAndSeesTheEnd) {
    Bench bench;
    tcp::acceptor acceptor{bench.loop, {boost::asio::ip::address_v4::loopback(), 0}};
    const auto link = bench.open(tcp_at(acceptor.local_endpoint().port()));
    tcp::socket peer = acceptor.accept();
    peer.send(boost::asio::buffer(std::string_view{"hello"}));
    EXPECT_EQ(text_of(bench.wait(link->read_some(bench.soon()))->bytes), "hello");
    EXPECT_TRUE(bench.wait(link->write_all(bytes_of("world"), bench.soon())));
    std::string got(5, ' ');
    peer.receive(boost::asio::buffer(got));
    EXPECT_EQ(got, "world");
    peer.close();
    EXPECT_EQ(bench.wait(link->read_some(bench.soon())).error().fault, Fault::link_closed);
}

TEST(TcpLink, SaysClosedWhereNobodyListens) {
    Bench bench;
    int port = 0;
    {
        tcp::acceptor acceptor{bench.loop, {boost::asio::ip::address_v4::loopback(), 0}};
        port = acceptor.local_endpoint().port();
    }
    const auto refused = bench.wait(bench.opener.open(tcp_at(port), bench.soon()));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::link_closed);
}

TEST(LinkText, NamesSerialLinesAndTcpPlaces) {
    const auto line = parse_link("serial:/dev/serial/by-id/usb-1").value();
    EXPECT_EQ(line.describe(), "serial /dev/serial/by-id/usb-1 115200 8N1");
    const auto place = parse_link("tcp:sensor.local:502").value();
    EXPECT_EQ(place.describe(), "tcp sensor.local:502");
    EXPECT_EQ(parse_link("tcp:[::1]:502").value().host, "::1");
    for (const char* text : {"", "serial:", "/dev/ttyS0", "tcp:host", "tcp::502", "tcp:host:0",
                             "tcp:host:70000", "tcp:host:5x", "serial:COM3", "serial:ttyUSB0"})
        EXPECT_FALSE(parse_link(text)) << text;
}

TEST(LinkText, ReadsTheLineSettingsOfASerialLink) {
    auto document = SettingsDocument::parse(
        "link = \"serial:/dev/ttyUSB0\"\nbaud = 9600\nparity = \"even\"\nstop_bits = 2\n", "t");
    Settings root = document->root();
    EXPECT_EQ(read_link(root).describe(), "serial /dev/ttyUSB0 9600 8E2");
    EXPECT_TRUE(document->finish().empty());
}

TEST(LinkText, RefusesABaudRateOnTcp) {
    auto document = SettingsDocument::parse("link = \"tcp:a:1\"\nbaud = 9600\n", "t");
    Settings root = document->root();
    read_link(root);
    EXPECT_EQ(document->finish().size(), 1u);
}

} // namespace
} // namespace axiscal::link_test
