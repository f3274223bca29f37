#pragma once
// All USB devices of one simulated world, and the commands that plug and spoil them.

#include "wire/usb/usb_carrier.hpp"
#include "wire/usb/usb_kinds.hpp"

#include <nlohmann/json.hpp>

namespace axiscal::simulate {

/// One thread at a time; ended() at any.
class UsbHub {
public:
    /// Makes each device and plugs it in, in sockets `first_port`, +1, ... of vhci_hcd, or by
    /// `carrier=uhid|dummy-hcd`. A device is named by its setting `called`, else by its kind; with
    /// `plugged=no` it waits for its command.
    /// @errors of parse_usb_wish, make_usb_device and UsbCarrier::plug; bad_request for a carrier.
    static Result<std::unique_ptr<UsbHub>>
    open(const std::vector<std::string>& wishes, const UsbWorld& world, int first_port);

    /// One line of the control channel; the answer is one JSON object: status, plug NAME,
    /// unplug NAME, tell NAME WORD, fault NAME none|mute|stall|cut N|corrupt MASK|
    /// garble MASK|descriptors, quit.
    nlohmann::json command(const std::string& line);
    [[nodiscard]] nlohmann::json status() const;
    [[nodiscard]] bool ended() const { return ended_; }

private:
    Result<void> obey(const std::string& word, std::istream& arguments);
    std::vector<std::unique_ptr<UsbCarrier>> carriers_;
    std::atomic<bool> ended_{false};
};

} // namespace axiscal::simulate
