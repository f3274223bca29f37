#pragma once
// A HID device that the kernel itself puts together (libcomposite, usb_f_hid) on its other virtual
// controller, dummy_hcd: descriptors, enumeration and class requests are not ours, only reports
// are. Needs the modules dummy_hcd and usb_f_hid, configfs, and root.

#include "wire/usb/hid_reports.hpp"
#include "wire/usb/usb_carrier.hpp"

#include <filesystem>

namespace axiscal::simulate {

class GadgetCarrier final : public UsbCarrier {
public:
    GadgetCarrier(std::string name, std::unique_ptr<UsbDevice> device);
    ~GadgetCarrier() override { unplug(); }
    GadgetCarrier(const GadgetCarrier&) = delete;
    GadgetCarrier& operator=(const GadgetCarrier&) = delete;

    /// @errors bad_request for a model that is no HID device; io.
    Result<void> plug() override;
    void unplug() override;

private:
    struct End {
        HidInterface interface;
        int descriptor = -1; ///< of /dev/hidgN
        Bytes waiting;       ///< the host has not fetched the one before
    };
    Result<void> describe_gadget();
    Result<void> add_function(const HidInterface& interface);
    Result<std::vector<End>> connect(const std::vector<HidInterface>& interfaces);
    void take_down();
    void exchange(End& end, bool readable);
    void serve(std::vector<End>& ends, const std::stop_token& stop);

    std::filesystem::path tree_; ///< in configfs
};

} // namespace axiscal::simulate
