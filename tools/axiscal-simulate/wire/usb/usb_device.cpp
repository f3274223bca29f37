#include "wire/usb/usb_device.hpp"

namespace axiscal::simulate {

UsbAnswer UsbDevice::out(std::uint8_t, std::span<const std::uint8_t>) {
    return UsbAnswer::stall(); // no such endpoint
}

UsbAnswer UsbDevice::in(std::uint8_t, std::size_t) {
    return UsbAnswer::stall();
}

Result<void> UsbDevice::obey(const std::string& word) {
    return fail(Fault::bad_request, "a device of this kind knows no \"" + word + "\"");
}

} // namespace axiscal::simulate
