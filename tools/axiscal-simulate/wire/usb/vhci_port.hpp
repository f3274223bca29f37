#pragma once
// A socket of the kernel's virtual USB controller (vhci_hcd), and the device that is plugged into
// it. Needs the module vhci_hcd and root. One thread commands; the device lives on its own.

#include "wire/usb/urb_server.hpp"

#include <memory>
#include <thread>

namespace axiscal::simulate {

class VhciPort {
public:
    /// port: 0 to 7, the high- and full-speed sockets of the first controller.
    VhciPort(int port, std::string name, std::unique_ptr<UsbDevice> device);
    ~VhciPort() { unplug(); }
    VhciPort(const VhciPort&) = delete;
    VhciPort& operator=(const VhciPort&) = delete;

    /// Waits up to 5 s for a socket that is still being emptied. @errors io, naming the module that
    /// is missing; busy where another device sits there.
    Result<void> plug();
    void unplug();
    [[nodiscard]] bool plugged() const { return pump_.joinable(); }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::string state() const { return device_->state(); }
    Result<void> obey(const std::string& word) { return device_->obey(word); }
    UsbFaults& faults() { return faults_; }

private:
    int port_;
    std::string name_;
    std::unique_ptr<UsbDevice> device_;
    UsbFaults faults_;
    std::jthread pump_;
};

} // namespace axiscal::simulate
