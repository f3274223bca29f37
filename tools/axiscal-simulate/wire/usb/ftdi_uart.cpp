// Source: the vendor's AN232B-04 "Data Throughput, Latency and Handshaking" 1.1 (latency timer, 62
// bytes and two status bytes a packet) and the request numbers of the Linux kernel's
// drivers/usb/serial/ftdi_sio.h.
#include "wire/usb/ftdi_uart.hpp"

#include "wire/usb/tty_behind.hpp"

#include <algorithm>
#include <atomic>
#include <optional>

namespace axiscal::simulate {

namespace {

using Steady = std::chrono::steady_clock;

enum : std::uint8_t {
    set_modem_lines = 1,
    get_modem_status = 5,
    set_latency_timer = 9,
    get_latency_timer = 10
};
/// Of set_modem_lines: the levels; above them, in the high byte, which of them are meant.
constexpr int dtr_bit = 1, rts_bit = 2;
constexpr std::size_t packet = 64, status_size = 2;

UsbDescriptors ftdi_descriptors(const UsbWish& wish) {
    UsbDescriptors device;
    device.speed = UsbSpeed::full;
    device.vendor = 0x0403;
    device.product = 0x6001;
    device.release = 0x0600; // FT232R
    device.maker = "FTDI";
    device.name = wish.text("name", "FT232R USB UART");
    device.serial = wish.text("serial", "A600AXIS");
    device.interfaces = {
        {0xFF,
         0xFF,
         0xFF,
         {},
         {{0x81, UsbTransfer::bulk, packet, 0}, {0x02, UsbTransfer::bulk, packet, 0}}}};
    return device;
}

class FtdiUart final : public UsbDevice {
public:
    FtdiUart(const UsbWish& wish, TtyBehind behind)
        : descriptors_{ftdi_descriptors(wish)}
        , behind_{std::move(behind)} {}
    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    void plugged() override;
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
    UsbAnswer out(std::uint8_t endpoint, std::span<const std::uint8_t> data) override;
    UsbAnswer in(std::uint8_t endpoint, std::size_t most) override;
    [[nodiscard]] int wake_descriptor() const override { return behind_.descriptor(); }
    [[nodiscard]] std::chrono::milliseconds pace() const override {
        return std::chrono::milliseconds{1};
    }
    [[nodiscard]] std::string state() const override;

private:
    [[nodiscard]] std::int64_t ends_of_the_timer() const {
        return (Steady::now() - plugged_at_) / std::chrono::milliseconds{latency_ms_};
    }

    UsbDescriptors descriptors_;
    TtyBehind behind_;
    std::atomic<int> latency_ms_{16};
    std::atomic<int> modem_lines_{0};
    Steady::time_point plugged_at_;
    std::optional<std::int64_t> waiting_since_; ///< ends of the timer when bytes were first there
};

std::string FtdiUart::state() const {
    const auto level = [this](int bit) { return (modem_lines_ & bit) != 0 ? "high" : "low"; };
    return "latency timer " + std::to_string(latency_ms_) + " ms, DTR " + level(dtr_bit) +
           ", RTS " + level(rts_bit);
}

void FtdiUart::plugged() {
    behind_.flush();
    latency_ms_ = 16;
    modem_lines_ = 0;
    plugged_at_ = Steady::now();
    waiting_since_.reset();
}

UsbAnswer FtdiUart::control(const UsbSetup& setup, std::span<const std::uint8_t>) {
    if (!setup.to_host()) {
        if (setup.request == set_latency_timer) latency_ms_ = std::max(1, setup.value & 0xFF);
        if (setup.request == set_modem_lines) {
            const int meant = setup.value >> 8;
            modem_lines_ = (modem_lines_ & ~meant) | (setup.value & meant);
        }
        return UsbAnswer::done(); // baud rate, data format, flow control: any will do
    }
    if (setup.request == get_latency_timer)
        return UsbAnswer::done({static_cast<std::uint8_t>(latency_ms_)});
    if (setup.request == get_modem_status) return UsbAnswer::done({0x01, 0x60});
    return UsbAnswer::stall(); // no EEPROM
}

UsbAnswer FtdiUart::out(std::uint8_t, std::span<const std::uint8_t> data) {
    behind_.write(data);
    return UsbAnswer::done();
}

/// The timer runs all the time; at its first end after a byte came: packets of two status bytes and
/// up to 62 of data. A chip with nothing to say sends the status alone; here the host is left in
/// peace, which no driver can tell apart.
UsbAnswer FtdiUart::in(std::uint8_t, std::size_t most) {
    if (!behind_.has_bytes()) return UsbAnswer::hold();
    const std::int64_t ends = ends_of_the_timer();
    if (ends == waiting_since_.value_or(ends)) {
        waiting_since_ = ends;
        return UsbAnswer::hold();
    }
    waiting_since_.reset();
    const std::size_t packets = std::max<std::size_t>(1, most / packet);
    const Bytes data = behind_.read(packets * (packet - status_size));
    Bytes bytes;
    bytes.reserve(packets * packet);
    for (std::size_t i = 0; i < data.size(); ++i) {
        if (i % (packet - status_size) == 0) bytes.insert(bytes.end(), {0x01, 0x60});
        bytes.push_back(data[i]);
    }
    return UsbAnswer::done(std::move(bytes));
}

} // namespace

Result<std::unique_ptr<UsbDevice>> make_ftdi_uart(const UsbWish& wish, const UsbWorld&) {
    AXISCAL_TRY(TtyBehind behind, TtyBehind::open(wish.text("behind", "")));
    return std::make_unique<FtdiUart>(wish, std::move(behind));
}

} // namespace axiscal::simulate
