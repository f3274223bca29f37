#pragma once
// One frame of a CAN bus. Pure data.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace axiscal {

struct CanFrame {
    std::uint32_t id = 0;   ///< 11 bits, 29 where `extended`
    bool extended = false;  ///< CANopen has none
    bool remote = false;    ///< asks for a frame and carries nothing
    std::size_t length = 0; ///< 0 .. 8
    std::array<std::byte, 8> data{};

    [[nodiscard]] std::span<const std::byte> bytes() const {
        return std::span{data}.first(std::min(length, data.size()));
    }
    /// A data frame with an 11-bit identifier.
    [[nodiscard]] bool is_plain() const { return !extended && !remote; }
    friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// At most 8 bytes; what is more is left out.
inline CanFrame plain_frame(std::uint32_t id, std::initializer_list<unsigned> numbers) {
    CanFrame frame;
    frame.id = id;
    for (const unsigned number : numbers)
        if (frame.length < frame.data.size())
            frame.data[frame.length++] = static_cast<std::byte>(number & 0xFFU);
    return frame;
}

} // namespace axiscal
