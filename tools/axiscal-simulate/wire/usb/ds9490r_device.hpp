#pragma once
// A DS9490R: the chip DS2490 between USB and a 1-Wire cable. What the kernel's ds2490 uses of it:
// resets, time slots, bytes, blocks, searches; no strong pull-up (the chips on the cable have a
// supply wire), no overdrive. All of it on one thread.

#include "wire/one_wire.hpp"
#include "wire/usb/usb_device.hpp"

#include <deque>

namespace axiscal::simulate {

class Ds9490rDevice final : public UsbDevice {
public:
    explicit Ds9490rDevice(std::unique_ptr<OneWireBus> bus);

    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    void plugged() override { restart(); }
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
    UsbAnswer out(std::uint8_t endpoint, std::span<const std::uint8_t> data) override;
    UsbAnswer in(std::uint8_t endpoint, std::size_t most) override;
    /// Of the cable: OneWireBus::suffer.
    Result<void> obey(const std::string& word) override { return bus_->suffer(word); }

private:
    void restart();
    bool command(std::uint16_t value, std::uint16_t index);
    bool communicate(std::uint16_t value, std::uint16_t index);
    bool touch_block(std::size_t length);
    void search(std::uint8_t rom_command);
    [[nodiscard]] Bytes state_packet() const;

    UsbDescriptors descriptors_;
    std::unique_ptr<OneWireBus> bus_;
    OneWireRom own_rom_; ///< of the chip that numbers the adapter
    std::deque<std::uint8_t> from_host_, to_host_;
};

} // namespace axiscal::simulate
