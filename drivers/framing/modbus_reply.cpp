#include "drivers/framing/modbus_reply.hpp"

namespace axiscal {
std::optional<std::size_t> modbus_reply_length(std::span<const std::uint8_t> header,
                                               std::uint16_t transaction,
                                               std::uint8_t unit) {
    const bool ours =
        word_at(header, 0) == transaction && word_at(header, 2) == 0 && header[6] == unit;
    const std::size_t length = word_at(header, 4);
    if (!ours || length < shortest_reply || length > longest_reply) return std::nullopt;
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
        words.push_back(static_cast<std::uint16_t>(word_at(pdu, at)));
    return words;
}

std::optional<std::vector<std::uint16_t>> bits_of_reply(std::span<const std::uint8_t> pdu,
                                                        int count) {
    const std::size_t bytes = bytes_of_answer(1, count);
    if (pdu.size() != bytes + 2 || pdu[1] != bytes) return std::nullopt;
    std::vector<std::uint16_t> bits;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        bits.push_back(static_cast<std::uint16_t>((pdu[2 + i / 8] >> (i % 8)) & 1U));
    return bits;
}

} // namespace axiscal
