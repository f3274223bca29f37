#pragma once
// A PCsensor TEMPer stick as open drivers know it (urwen/temper, padelt/temper-python): two HID
// interfaces, a keyboard and one of 8-byte reports. All of it on one thread.

#include "wire/usb/usb_device.hpp"

#include <deque>
#include <functional>

namespace axiscal::simulate {

struct TemperShown {
    double stick_degC = 20, probe_degC = 20, humidity_percent = 50;
    bool probe_connected = true;
};

class TemperDevice final : public UsbDevice {
public:
    /// @param firmware  "TEMPerX_V3.3", "TEMPer2_V3.7" (hundredths, probe in a second report) or
    ///                  "TEMPerF1.4" (1/256, no probe): decides the layout.
    TemperDevice(std::string firmware, std::function<TemperShown()> shown);

    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    void plugged() override { reports_.clear(); }
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
    UsbAnswer in(std::uint8_t endpoint, std::size_t most) override;

private:
    void take_report(std::span<const std::uint8_t> report);
    void tell_firmware();
    void tell_values();

    UsbDescriptors descriptors_;
    std::string firmware_;
    std::function<TemperShown()> shown_;
    std::deque<Bytes> reports_; ///< for interface 1
};

} // namespace axiscal::simulate
