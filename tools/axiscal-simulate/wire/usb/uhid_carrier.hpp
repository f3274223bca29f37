#pragma once
// A HID device without any USB: the kernel's /dev/uhid, by which a program is the transport. Needs
// the module uhid and root. Of a model with several HID interfaces it is the last one.

#include "wire/usb/hid_reports.hpp"
#include "wire/usb/usb_carrier.hpp"

namespace axiscal::simulate {

class UhidCarrier final : public UsbCarrier {
public:
    using UsbCarrier::UsbCarrier;
    ~UhidCarrier() override { unplug(); }
    UhidCarrier(const UhidCarrier&) = delete;
    UhidCarrier& operator=(const UhidCarrier&) = delete;

    /// @errors bad_request for a model that is no HID device; io.
    Result<void> plug() override;
    void unplug() override { stop_pump(); }

private:
    void listen(const HidInterface& interface, int channel);
    void serve(const HidInterface& interface, int channel, const std::stop_token& stop);
};

} // namespace axiscal::simulate
