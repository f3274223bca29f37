// Source: USB Class Definitions for Communication Devices 1.2 and its PSTN subclass 1.2 (requests
// of table 13, functional descriptors of clause 5.3); the Teensy's and Dracal's numbers: their udev
// rules.
#include "wire/usb/cdc_acm.hpp"

#include "wire/usb/tty_behind.hpp"

#include <atomic>

namespace axiscal::simulate {

namespace {

enum : std::uint8_t {
    set_line_coding = 0x20,
    get_line_coding = 0x21,
    set_control_line_state = 0x22,
    send_break = 0x23
};
constexpr std::uint8_t data_endpoint = 1;

UsbDescriptors acm_descriptors(const UsbWish& wish) {
    constexpr std::uint8_t communication = 2, abstract_control = 2, at_commands = 1, data = 10;
    // Header 1.10; abstract control: line coding and state; union of 0 and 1; no call management.
    const Bytes functions{5, 0x24, 0, 0x10, 1, 4, 0x24, 2, 2, 5, 0x24, 6, 0, 1, 5, 0x24, 1, 0, 1};
    UsbDescriptors device;
    device.speed = UsbSpeed::high;
    device.vendor = wish.hexadecimal("vendor", 0x16C0);
    device.product = wish.hexadecimal("product", 0x0483);
    device.its_class = communication;
    device.maker = wish.text("maker", "Teensyduino");
    device.name = wish.text("name", "USB Serial");
    device.serial = wish.text("serial", "1234560");
    device.interfaces = {
        {communication,
         abstract_control,
         at_commands,
         functions,
         {{0x82, UsbTransfer::interrupt, 16, 9}}},
        {data, 0, 0, {}, {{0x81, UsbTransfer::bulk, 512, 0}, {0x01, UsbTransfer::bulk, 512, 0}}}};
    return device;
}

class CdcAcm final : public UsbDevice {
public:
    CdcAcm(const UsbWish& wish, TtyBehind behind)
        : descriptors_{acm_descriptors(wish)}
        , behind_{std::move(behind)} {}
    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    void plugged() override { behind_.flush(); }
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
    UsbAnswer out(std::uint8_t endpoint, std::span<const std::uint8_t> data) override;
    UsbAnswer in(std::uint8_t endpoint, std::size_t most) override;
    [[nodiscard]] int wake_descriptor() const override { return behind_.descriptor(); }
    [[nodiscard]] std::string state() const override {
        return "baud " + std::to_string(baud_) + " lines " + std::to_string(lines_);
    }

private:
    UsbDescriptors descriptors_;
    TtyBehind behind_;
    Bytes coding_{0x80, 0x25, 0, 0, 0, 0, 8}; ///< 9600 8N1
    std::atomic<unsigned> baud_{9600}, lines_{0};
};

UsbAnswer CdcAcm::control(const UsbSetup& setup, std::span<const std::uint8_t> data) {
    switch (setup.request) {
    case set_line_coding:
        if (data.size() != coding_.size()) return UsbAnswer::stall();
        coding_.assign(data.begin(), data.end());
        baud_ = coding_[0] | std::uint32_t{coding_[1]} << 8U | std::uint32_t{coding_[2]} << 16U;
        return UsbAnswer::done();
    case get_line_coding: return UsbAnswer::done(coding_);
    case set_control_line_state: lines_ = setup.value; return UsbAnswer::done();
    case send_break: return UsbAnswer::done();
    default: return UsbAnswer::stall();
    }
}

UsbAnswer CdcAcm::out(std::uint8_t, std::span<const std::uint8_t> data) {
    behind_.write(data);
    return UsbAnswer::done();
}

UsbAnswer CdcAcm::in(std::uint8_t endpoint, std::size_t most) {
    if (endpoint != data_endpoint) return UsbAnswer::hold(); // notifications: there are none
    Bytes bytes = behind_.read(most);
    return bytes.empty() ? UsbAnswer::hold() : UsbAnswer::done(std::move(bytes));
}

} // namespace

Result<std::unique_ptr<UsbDevice>> make_cdc_acm(const UsbWish& wish, const UsbWorld&) {
    AXISCAL_TRY(TtyBehind behind, TtyBehind::open(wish.text("behind", "")));
    return std::make_unique<CdcAcm>(wish, std::move(behind));
}

} // namespace axiscal::simulate
