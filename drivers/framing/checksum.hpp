#pragma once
// Checksums of the instruments' frames. Pure.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace axiscal {

/// CRC-16/XMODEM: polynomial 0x1021, initial value 0, not reflected. Check value of "123456789":
/// 0x31C3.
std::uint16_t crc16_xmodem(std::string_view bytes);

/// CRC-16/MODBUS: polynomial 0x8005 reflected, initial value 0xFFFF; on the line low byte first.
/// Modbus over serial line V1.02, 6.2.2. Check value of "123456789": 0x4B37.
std::uint16_t crc16_modbus(std::span<const std::uint8_t> bytes);

/// CRC-8/NRSC-5: polynomial 0x31, initial value 0xFF, not reflected. Check value of "123456789":
/// 0xF7.
std::uint8_t crc8_nrsc5(std::span<const std::byte> bytes);

} // namespace axiscal
