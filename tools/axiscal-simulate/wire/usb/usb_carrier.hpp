#pragma once
// A simulated device and the way by which the kernel meets it: a socket of vhci_hcd, /dev/uhid, a
// gadget on dummy_hcd. One thread commands; the device lives on its own.

#include "wire/usb/usb_faults.hpp"

#include <memory>
#include <thread>

namespace axiscal::simulate {

class UsbCarrier {
public:
    UsbCarrier(std::string name, std::unique_ptr<UsbDevice> device)
        : name_{std::move(name)}
        , device_{std::move(device)} {}
    /// What derives from this unplugs in its own destructor.
    virtual ~UsbCarrier() = default;
    UsbCarrier(const UsbCarrier&) = delete;
    UsbCarrier& operator=(const UsbCarrier&) = delete;

    /// @errors io, naming the module that is missing.
    virtual Result<void> plug() = 0;
    virtual void unplug() = 0;
    [[nodiscard]] bool plugged() const { return pump_.joinable(); }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::string state() const { return device_->state(); }
    [[nodiscard]] std::uint64_t skipped() const { return device_->skipped(); }
    Result<void> obey(const std::string& word) { return device_->obey(word); }
    UsbFaults& faults() { return faults_; }

protected:
    UsbDevice& device() { return *device_; }
    void start_pump(std::jthread pump) { pump_ = std::move(pump); }
    void stop_pump() {
        pump_.request_stop();
        if (pump_.joinable()) pump_.join();
        pump_ = {};
    }

private:
    std::string name_;
    std::unique_ptr<UsbDevice> device_;
    UsbFaults faults_;
    std::jthread pump_;
};

} // namespace axiscal::simulate
