#pragma once
// A CAN adapter of the gs_usb family (candleLight, CANable) with CANopen devices on its bus.
// Written from the host's side of the protocol, drivers/net/can/usb/gs_usb.c of Linux 6.1. All of
// it on one thread, but obey().

#include "wire/can/can_node.hpp"
#include "wire/usb/usb_device.hpp"

#include <atomic>
#include <deque>
#include <functional>
#include <memory>

namespace axiscal::simulate {

class GsUsbDevice final : public UsbDevice {
public:
    /// @param now_s  never goes back.
    GsUsbDevice(std::string serial,
                std::function<double()> now_s,
                std::vector<std::unique_ptr<CanNode>> nodes);

    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    void plugged() override;
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
    UsbAnswer out(std::uint8_t endpoint, std::span<const std::uint8_t> data) override;
    UsbAnswer in(std::uint8_t endpoint, std::size_t most) override;
    [[nodiscard]] std::chrono::milliseconds pace() const override {
        return std::chrono::milliseconds{1};
    }
    /// What each node did not send because this computer stood still: "node 127 skipped 3, ...".
    [[nodiscard]] std::string state() const override;
    /// "bus-off": the controller leaves its bus until the host starts it anew.
    Result<void> obey(const std::string& word) override;

private:
    void take_mode(std::span<const std::uint8_t> data);
    void put(std::uint32_t echo, std::uint32_t id, std::span<const std::uint8_t> data);
    void put_all(const std::vector<CanMessage>& frames);

    UsbDescriptors descriptors_;
    std::function<double()> now_s_;
    std::vector<std::unique_ptr<CanNode>> nodes_;
    std::deque<Bytes> frames_; ///< for the host
    bool started_ = false, off_ = false;
    std::atomic<bool> goes_off_{false};
};

} // namespace axiscal::simulate
