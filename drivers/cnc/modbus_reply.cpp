#include "drivers/cnc/modbus_reply.hpp"

namespace axiscal {
namespace {

/// Unit, function and one byte; the longest PDU has 253.
constexpr std::size_t shortest_length = 3, longest_length = 254;
constexpr unsigned exception_bit = 0x80;

std::size_t big16(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::size_t>(bytes[at]) << 8U | bytes[at + 1];
}

} // namespace

std::optional<std::size_t> modbus_reply_length(std::span<const std::uint8_t> header,
                                               std::uint16_t transaction) {
    const bool ours = big16(header, 0) == transaction && big16(header, 2) == 0;
    const std::size_t length = big16(header, 4);
    if (!ours || length < shortest_length || length > longest_length) return std::nullopt;
    return length - 1;
}

ModbusReplyKind kind_of_modbus_reply(std::span<const std::uint8_t> pdu, std::uint8_t function) {
    if (pdu.size() < 2) return ModbusReplyKind::other;
    if (pdu[0] == function) return ModbusReplyKind::answer;
    return pdu[0] == (function | exception_bit) ? ModbusReplyKind::exception
                                                : ModbusReplyKind::other;
}

std::optional<std::vector<std::uint16_t>> registers_of_reply(std::span<const std::uint8_t> pdu,
                                                             int count) {
    const auto bytes = 2 * static_cast<std::size_t>(count);
    if (pdu.size() != bytes + 2 || pdu[1] != bytes) return std::nullopt;
    std::vector<std::uint16_t> words;
    words.reserve(static_cast<std::size_t>(count));
    for (std::size_t at = 2; at < pdu.size(); at += 2)
        words.push_back(static_cast<std::uint16_t>(big16(pdu, at)));
    return words;
}

} // namespace axiscal
