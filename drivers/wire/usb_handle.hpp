#pragma once
// One device opened by libusb: blocking transfers, each bounded. Belongs to one thread.
//
// libusb is told not to discover devices: that needs a netlink socket, which the service may not
// have. The place in sysfs leads to the node, whose descriptor libusb wraps.

#include "drivers/wire/usb_link.hpp"

struct libusb_context;
struct libusb_device_handle;

namespace axiscal {

class UsbHandle {
public:
    /// @errors as `choose_usb`; Fault::io without the right to open it; busy while another
    /// program has it.
    static Result<std::shared_ptr<UsbHandle>> open(const UsbPlace& place);
    UsbHandle(UsbPlace place, UsbEntry entry)
        : place_{std::move(place)}
        , entry_{std::move(entry)} {}
    ~UsbHandle();
    UsbHandle(const UsbHandle&) = delete;
    UsbHandle& operator=(const UsbHandle&) = delete;

    Result<TimedBytes> control_in(const UsbRequest& request, MonotonicTime deadline);
    Result<void> bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline);
    Result<TimedBytes> bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline);
    [[nodiscard]] const UsbEntry& entry() const { return entry_; }

private:
    Result<void> open_node();
    [[nodiscard]] tl::unexpected<Error> failed(int code, int endpoint);
    [[nodiscard]] std::string missing_part(int code, int endpoint) const;

    UsbPlace place_;
    UsbEntry entry_;
    int node_ = -1, claimed_ = -1;
    libusb_context* context_ = nullptr;
    libusb_device_handle* handle_ = nullptr;
};

} // namespace axiscal
