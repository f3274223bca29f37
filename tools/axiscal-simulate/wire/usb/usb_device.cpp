#include "wire/usb/usb_device.hpp"

namespace axiscal::simulate {

UsbAnswer UsbDevice::out(std::uint8_t, std::span<const std::uint8_t>) {
    return UsbAnswer::stall(); // no such endpoint
}

UsbAnswer UsbDevice::in(std::uint8_t, std::size_t) {
    return UsbAnswer::stall();
}

} // namespace axiscal::simulate
