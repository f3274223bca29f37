#pragma once
// What goes wrong between a device and its host, whatever the device. Thread-safe.

#include "wire/usb/usb_device.hpp"

#include <atomic>

namespace axiscal::simulate {

/// mute: NAK for ever on all but standard requests (the application hangs, its USB core lives).
/// stall: every such transfer ends with STALL. cut: IN transfers lose all beyond `number` bytes.
/// corrupt: one byte in the middle of each IN transfer is XORed with `number`; garble: each byte.
/// descriptors: the configuration is cut short, told at the next plugging-in.
enum class UsbFault : std::uint8_t { none, mute, stall, cut, corrupt, garble, descriptors };

class UsbFaults {
public:
    void set(UsbFault fault, int number) {
        number_ = number;
        fault_ = fault;
    }
    /// From words: "mute", "cut" 3. @errors bad_request for a word that is no fault, a cut below 0,
    /// a mask outside 1..255.
    Result<void> set(const std::string& word, int number);
    [[nodiscard]] UsbFault fault() const { return fault_; }
    /// What the host gets for the device's own answer to an IN transfer.
    [[nodiscard]] UsbAnswer spoil(UsbAnswer answer) const;

private:
    std::atomic<UsbFault> fault_{UsbFault::none};
    std::atomic<int> number_{0};
};

} // namespace axiscal::simulate
