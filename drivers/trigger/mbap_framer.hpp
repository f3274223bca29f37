#pragma once
// Frames of Modbus TCP: transaction, protocol 0, length, then unit and PDU (Modbus Messaging on
// TCP/IP V1.0b, section 3.1.3). Pure.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

inline constexpr std::size_t mbap_prefix = 6; ///< transaction, protocol and length
inline constexpr std::size_t mbap_header = 7; ///< ... and unit

/// Collects bytes as they come and hands out whole frames. Never holds more than it was fed.
class MbapFramer {
public:
    void feed(std::span<const std::uint8_t> bytes);
    /// The next whole frame, header included; empty when bytes are missing or broken().
    std::optional<std::vector<std::uint8_t>> next();
    /// What came is not Modbus (protocol not 0, length not 2..254, function 0 or above 127):
    /// there is no way back into step.
    [[nodiscard]] bool broken() const { return broken_; }
    /// A frame has begun and is not complete.
    [[nodiscard]] bool in_frame() const { return !held_.empty(); }

private:
    std::vector<std::uint8_t> held_;
    bool broken_ = false;
};

} // namespace axiscal
