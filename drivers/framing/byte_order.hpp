#pragma once
// Whole numbers out of bytes, low or high byte first. Pure. `at` must lie inside with all the bytes
// that are read: the caller has checked the length.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace axiscal {

inline std::uint32_t byte_at(std::span<const std::byte> bytes, std::size_t at) {
    return std::to_integer<std::uint32_t>(bytes[at]);
}
inline std::uint32_t little16(std::span<const std::byte> bytes, std::size_t at) {
    return byte_at(bytes, at) | byte_at(bytes, at + 1) << 8;
}
inline std::uint32_t little24(std::span<const std::byte> bytes, std::size_t at) {
    return little16(bytes, at) | byte_at(bytes, at + 2) << 16;
}
inline std::uint32_t little32(std::span<const std::byte> bytes, std::size_t at) {
    return little16(bytes, at) | little16(bytes, at + 2) << 16;
}
inline std::uint32_t big16(std::span<const std::byte> bytes, std::size_t at) {
    return byte_at(bytes, at) << 8 | byte_at(bytes, at + 1);
}
inline std::uint32_t big24(std::span<const std::byte> bytes, std::size_t at) {
    return big16(bytes, at) << 8 | byte_at(bytes, at + 2);
}
/// Two's complement.
inline int signed16(std::uint32_t word) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(word));
}

inline std::vector<std::byte> bytes_of(std::initializer_list<int> numbers) {
    std::vector<std::byte> bytes;
    bytes.reserve(numbers.size());
    for (const int number : numbers)
        bytes.push_back(static_cast<std::byte>(number));
    return bytes;
}

} // namespace axiscal
