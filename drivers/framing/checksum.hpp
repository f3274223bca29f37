#pragma once
// Checksums of the instruments' frames. Pure.

#include <cstdint>
#include <string_view>

namespace axiscal {

/// CRC-16/XMODEM: polynomial 0x1021, initial value 0, not reflected. Check value of "123456789":
/// 0x31C3.
std::uint16_t crc16_xmodem(std::string_view bytes);

} // namespace axiscal
