#include "drivers/framing/checksum.hpp"

namespace axiscal {

std::uint16_t crc16_xmodem(std::string_view bytes) {
    unsigned crc = 0;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 0x8000u) != 0 ? (crc << 1) ^ 0x1021u : crc << 1;
    }
    return static_cast<std::uint16_t>(crc & 0xFFFFu);
}

std::uint16_t crc16_modbus(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0xFFFFu;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1u) != 0 ? (crc >> 1) ^ 0xA001u : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

std::uint8_t crc8_nrsc5(std::span<const std::byte> bytes) {
    unsigned crc = 0xFFu;
    for (const std::byte byte : bytes) {
        crc ^= std::to_integer<unsigned>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 0x80u) != 0 ? (crc << 1) ^ 0x131u : crc << 1;
    }
    return static_cast<std::uint8_t>(crc);
}

} // namespace axiscal
