#pragma once
// Answers vhci_hcd's transfers for one device: standard requests itself, the rest by the device,
// spoiled by the fault that is set. Transfers that the device holds wait until they are done or
// taken back. One thread.

#include "wire/usb/usb_faults.hpp"
#include "wire/usb/usbip_message.hpp"

#include <list>
#include <set>
#include <stop_token>

namespace axiscal::simulate {

class UrbServer {
public:
    UrbServer(UsbDevice& device, const UsbFaults& faults)
        : device_{device}
        , faults_{faults} {}
    /// From plugging-in to unplugging: until the peer closes `socket`, or stopped. A message that
    /// is neither SUBMIT nor UNLINK ends it, too.
    void serve(int socket, const std::stop_token& stop);

private:
    struct Transfer {
        UrbSubmit urb;
        Bytes data; ///< OUT
    };
    bool take_one(int socket);
    [[nodiscard]] UsbAnswer ask(const Transfer& transfer);
    [[nodiscard]] UsbAnswer standard(const UsbSetup& setup, UsbAnswer answer) const;
    bool finish(int socket, const Transfer& transfer, const UsbAnswer& answer);
    bool unlink(int socket, const UrbUnlink& unlink);
    bool ask_held_again(int socket);

    UsbDevice& device_;
    const UsbFaults& faults_;
    std::list<Transfer> held_; ///< oldest first; a held one blocks the later of its endpoint
    bool finished_some_ = false;
};

} // namespace axiscal::simulate
