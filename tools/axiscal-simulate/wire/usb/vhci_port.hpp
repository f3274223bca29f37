#pragma once
// A socket of the kernel's virtual USB controller (vhci_hcd), and the device that is plugged into
// it. Needs the module vhci_hcd and root.

#include "wire/usb/usb_carrier.hpp"

namespace axiscal::simulate {

class VhciPort final : public UsbCarrier {
public:
    /// port: 0 to 7, the high- and full-speed sockets of the first controller.
    VhciPort(int port, std::string name, std::unique_ptr<UsbDevice> device);
    ~VhciPort() override { unplug(); }
    VhciPort(const VhciPort&) = delete;
    VhciPort& operator=(const VhciPort&) = delete;

    /// Waits up to 5 s for a socket that is still being emptied. @errors io, naming the module that
    /// is missing; busy where another device sits there.
    Result<void> plug() override;
    void unplug() override;

private:
    int port_;
};

} // namespace axiscal::simulate
