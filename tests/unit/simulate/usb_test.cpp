// Simulated USB devices against the letter of their documents: USB/IP's messages, chapter 9 of USB
// 2.0, FTDI's packets. A socket pair stands for the kernel's virtual controller.
#include "wire/pty.hpp"
#include "wire/usb/ftdi_uart.hpp"
#include "wire/usb/urb_server.hpp"
#include "wire/usb/usb_descriptors.hpp"
#include "wire/usb/usb_kinds.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace axiscal::simulate::usb_test {
namespace {

/// Example of usbip_protocol.rst: a SUBMIT of 8 bytes from endpoint 1, sequence 0x0d05, device
/// 0x1000f.
const UsbipHeader submit_of_the_document{
    0, 0, 0, 1,    0,    0,    0x0d, 0x05, 0, 1, 0, 0x0f, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0,
    0, 0, 0, 0x40, 0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0,    0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0};

UsbDescriptors small_device() {
    UsbDescriptors device;
    device.vendor = 0x1209;
    device.product = 0x0001;
    device.maker = "rig";
    device.name = "echo";
    device.interfaces = {{0xFF, 0, 0, {}, {{0x81, UsbTransfer::bulk, 64, 0}, {0x02}}}};
    return device;
}

/// Gives back what it is told, after a while: the first question is always held.
class Echo final : public UsbDevice {
public:
    [[nodiscard]] const UsbDescriptors& descriptors() const override { return device_; }
    void plugged() override { kept_.clear(); }
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t>) override {
        return setup.request == 1 ? UsbAnswer::done({'f', 'w', '1'}) : UsbAnswer::stall();
    }
    UsbAnswer out(std::uint8_t, std::span<const std::uint8_t> data) override {
        kept_.assign(data.begin(), data.end());
        return UsbAnswer::done();
    }
    UsbAnswer in(std::uint8_t, std::size_t) override {
        return kept_.empty() ? UsbAnswer::hold() : UsbAnswer::done(std::exchange(kept_, {}));
    }

private:
    UsbDescriptors device_ = small_device();
    Bytes kept_;
};

/// The kernel's side of one plugging-in.
class Host {
public:
    Host() {
        std::array<int, 2> ends{-1, -1};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
        socket_ = ends[0];
        pump_ = std::jthread{[this, far = ends[1]](std::stop_token stop) {
            UrbServer{device_, faults}.serve(far, stop);
            ::close(far);
        }};
    }
    ~Host() { ::close(socket_); }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    void submit(std::uint8_t sequence,
                bool in,
                std::uint8_t endpoint,
                Bytes out,
                std::uint8_t most,
                const Bytes& setup = Bytes(8, 0)) const {
        Bytes message(usbip_header_size, 0);
        message[3] = 1;
        message[7] = sequence;
        message[15] = in ? 1 : 0;
        message[19] = endpoint;
        message[27] = in ? most : static_cast<std::uint8_t>(out.size());
        std::copy(setup.begin(), setup.end(), message.begin() + 40);
        message.insert(message.end(), out.begin(), out.end());
        EXPECT_EQ(::send(socket_, message.data(), message.size(), 0),
                  static_cast<ssize_t>(message.size()));
    }
    void take_back(std::uint8_t sequence, std::uint8_t victim) const {
        Bytes message(usbip_header_size, 0);
        message[3] = 2;
        message[7] = sequence;
        message[23] = victim;
        EXPECT_EQ(::send(socket_, message.data(), message.size(), 0),
                  static_cast<ssize_t>(message.size()));
    }
    struct Reply {
        int command = 0, sequence = 0, status = 0;
        Bytes bytes;
    };
    /// Waits for the next reply; only an IN transfer's has bytes.
    [[nodiscard]] Reply reply(bool in) const {
        UsbipHeader header{};
        EXPECT_EQ(::recv(socket_, header.data(), header.size(), MSG_WAITALL), 48);
        const auto word = [&](std::size_t at) {
            return static_cast<int>(std::uint32_t{header[at]} << 24 |
                                    std::uint32_t{header[at + 1]} << 16 |
                                    std::uint32_t{header[at + 2]} << 8 | header[at + 3]);
        };
        Reply reply{word(0), word(4), word(20), {}};
        reply.bytes.resize(in ? static_cast<std::size_t>(word(24)) : 0);
        const auto size = static_cast<ssize_t>(reply.bytes.size());
        if (size == 0) return reply;
        EXPECT_EQ(::recv(socket_, reply.bytes.data(), reply.bytes.size(), MSG_WAITALL), size);
        return reply;
    }
    UsbFaults faults;

private:
    Echo device_;
    int socket_ = -1;
    std::jthread pump_;
};

TEST(UsbipMessage, ReadsTheSubmitOfTheDocument) {
    const UrbRequest request = decode_urb(submit_of_the_document);
    const auto* submit = std::get_if<UrbSubmit>(&request);
    ASSERT_NE(submit, nullptr);
    EXPECT_EQ(submit->sequence, 0x0d05U);
    EXPECT_TRUE(submit->in);
    EXPECT_EQ(submit->endpoint, 1);
    EXPECT_EQ(submit->length, 64U);
}

TEST(UsbipMessage, RefusesWhatIsNeitherSubmitNorUnlink) {
    UsbipHeader header = submit_of_the_document;
    header[3] = 3;
    EXPECT_TRUE(std::holds_alternative<std::monostate>(decode_urb(header)));
}

TEST(UsbDescriptors, StandAsChapterNineSays) {
    const Bytes device{18, 1, 0, 2, 0, 0, 0, 64, 0x09, 0x12, 1, 0, 0, 1, 1, 2, 0, 1};
    EXPECT_EQ(device_descriptor(small_device()), device);
    const Bytes configuration{9, 2, 32, 0, 1,    1, 0,  0x80, 50, 9, 4, 0,    0, 2,  0xFF, 0,
                              0, 0, 7,  5, 0x81, 2, 64, 0,    0,  7, 5, 0x02, 2, 64, 0,    0};
    EXPECT_EQ(configuration_descriptor(small_device()), configuration);
    EXPECT_EQ(string_descriptor("AB"), (Bytes{6, 3, 'A', 0, 'B', 0}));
}

TEST(UsbDescriptors, ADeviceWithoutSerialNumberHasNoSuchString) {
    const auto answer = standard_answer(small_device(), {0x80, 6, 0x0303, 0x0409, 255});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->how, UsbAnswer::How::stall);
}

TEST(UrbServer, AnswersStandardRequestsForTheDevice) {
    const Host host;
    host.submit(1, true, 0, {}, 18, {0x80, 6, 0, 1, 0, 0, 18, 0});
    const auto reply = host.reply(true);
    EXPECT_EQ(reply.command, 3);
    EXPECT_EQ(reply.sequence, 1);
    EXPECT_EQ(reply.bytes, device_descriptor(small_device()));
}

TEST(UrbServer, HoldsAReadUntilTheDeviceHasSomethingAndKeepsOrder) {
    const Host host;
    host.submit(1, true, 1, {}, 64);
    host.submit(2, false, 2, {'h', 'i'}, 0);
    EXPECT_EQ(host.reply(false).sequence, 2);
    const auto read = host.reply(true);
    EXPECT_EQ(read.sequence, 1);
    EXPECT_EQ(read.bytes, (Bytes{'h', 'i'}));
}

TEST(UrbServer, GivesBackAHeldReadThatTheHostWantsBack) {
    const Host host;
    host.submit(1, true, 1, {}, 64);
    host.take_back(2, 1);
    const auto reply = host.reply(false);
    EXPECT_EQ(reply.command, 4);
    EXPECT_EQ(reply.status, -ECONNRESET);
    host.take_back(3, 1); // twice: it is gone
    EXPECT_EQ(host.reply(false).status, 0);
}

TEST(UrbServer, AMuteDeviceAnswersStandardRequestsOnly) {
    Host host;
    host.faults.set(UsbFault::mute, 0);
    host.submit(1, false, 2, {'x'}, 0);
    host.submit(2, true, 0, {}, 2, {0x80, 0, 0, 0, 0, 0, 2, 0});
    EXPECT_EQ(host.reply(true).sequence, 2);
    host.faults.set(UsbFault::none, 0);
    EXPECT_EQ(host.reply(false).sequence, 1);
}

TEST(UrbServer, SpoilsWhatTheDeviceSays) {
    Host host;
    const Bytes ask{0xC0, 1, 0, 0, 0, 0, 8, 0};
    host.faults.set(UsbFault::cut, 1);
    host.submit(1, true, 0, {}, 8, ask);
    EXPECT_EQ(host.reply(true).bytes, (Bytes{'f'}));
    host.faults.set(UsbFault::corrupt, 0x80);
    host.submit(2, true, 0, {}, 8, ask);
    EXPECT_EQ(host.reply(true).bytes, (Bytes{'f', 'w' ^ 0x80, '1'}));
    host.faults.set(UsbFault::garble, 0x80);
    host.submit(3, true, 0, {}, 8, ask);
    EXPECT_EQ(host.reply(true).bytes, (Bytes{'f' ^ 0x80, 'w' ^ 0x80, '1' ^ 0x80}));
    host.faults.set(UsbFault::stall, 0);
    host.submit(4, true, 0, {}, 8, ask);
    EXPECT_EQ(host.reply(true).status, -EPIPE);
}

/// The lengths that it states stay: a host sees that bytes are missing.
TEST(UrbServer, TellsItsConfigurationWithoutTheEndOfTheLastDescriptor) {
    Host host;
    host.faults.set(UsbFault::descriptors, 0);
    host.submit(1, true, 0, {}, 9, {0x80, 6, 0, 2, 0, 0, 9, 0});
    EXPECT_EQ(host.reply(true).bytes, (Bytes{9, 2, 32, 0, 1, 1, 0, 0x80, 50}));
    host.submit(2, true, 0, {}, 32, {0x80, 6, 0, 2, 0, 0, 32, 0});
    const Bytes told = host.reply(true).bytes;
    ASSERT_EQ(told.size(), 27U);
    EXPECT_EQ((Bytes{told.end() - 2, told.end()}), (Bytes{7, 5}));
}

TEST(UsbFaults, RefusesWordsAndNumbersThatMeanNothing) {
    UsbFaults faults;
    EXPECT_FALSE(faults.set("deaf", 0));
    EXPECT_FALSE(faults.set("corrupt", 0));
    EXPECT_FALSE(faults.set("garble", 256));
    EXPECT_FALSE(faults.set("cut", -1));
    EXPECT_TRUE(faults.set("none", 0));
}

TEST(UsbWish, IsAKindAndItsSettings) {
    const auto wish = parse_usb_wish("ftdi,serial=A1,behind=x");
    ASSERT_TRUE(wish);
    EXPECT_EQ(wish->kind, "ftdi");
    EXPECT_EQ(wish->text("serial", ""), "A1");
    EXPECT_EQ(wish->hexadecimal("vendor", 0x16C0), 0x16C0);
    EXPECT_FALSE(parse_usb_wish("ftdi,serial"));
    const auto unknown = make_usb_device({"toaster", {}}, {});
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().detail.find("cdc-acm"), std::string::npos);
}

/// SIO_SET_MODEM_CTRL of drivers/usb/serial/ftdi_sio.h: levels in the low byte, which of them are
/// meant in the high one.
TEST(FtdiUart, ShowsTheModemLinesAsTheHostHasSetThem) {
    const testing::ScratchFolder folder;
    auto pty = Pty::open(folder.file("tty"));
    ASSERT_TRUE(pty);
    const auto device = make_ftdi_uart({"ftdi", {{"behind", folder.file("tty")}}}, {});
    ASSERT_TRUE(device);
    (*device)->plugged();
    EXPECT_EQ((*device)->state(), "latency timer 16 ms, DTR low, RTS low");
    (*device)->control({0x40, 1, 0x0303, 0, 0}, {}); // both high, as at each opening
    EXPECT_EQ((*device)->state(), "latency timer 16 ms, DTR high, RTS high");
    (*device)->control({0x40, 1, 0x0200, 0, 0}, {}); // RTS low, nothing said of DTR
    EXPECT_EQ((*device)->state(), "latency timer 16 ms, DTR high, RTS low");
    (*device)->plugged();
    EXPECT_EQ((*device)->state(), "latency timer 16 ms, DTR low, RTS low");
}

/// AN232B-04: two status bytes before each 62 of data; bytes wait for the latency timer.
TEST(FtdiUart, PutsItsStatusBeforeEvery62Bytes) {
    const testing::ScratchFolder folder;
    auto pty = Pty::open(folder.file("tty"));
    ASSERT_TRUE(pty);
    const auto device = make_ftdi_uart({"ftdi", {{"behind", folder.file("tty")}}}, {});
    ASSERT_TRUE(device);
    (*device)->plugged();
    (*device)->control({0x40, 9, 1, 0, 0}, {}); // latency timer 1 ms
    EXPECT_EQ((*device)->state(), "latency timer 1 ms, DTR low, RTS low");
    pty->write(std::string(70, 'x'));
    UsbAnswer answer = UsbAnswer::hold();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{10};
    while (answer.how == UsbAnswer::How::hold && std::chrono::steady_clock::now() < end)
        answer = (*device)->in(1, 512);
    Bytes wanted{1, 0x60};
    wanted.insert(wanted.end(), 62, 'x');
    wanted.insert(wanted.end(), {1, 0x60});
    wanted.insert(wanted.end(), 8, 'x');
    EXPECT_EQ(answer.bytes, wanted);
}

} // namespace
} // namespace axiscal::simulate::usb_test
