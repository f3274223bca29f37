#pragma once
// What a Modbus server answers to a request of ours. Pure. Modbus Messaging on TCP/IP V1.0b,
// section 3.1.3 (header); Modbus application protocol V1.1b3, sections 6.1 to 6.4 (bits and
// registers read) and 7 (exceptions).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

/// What a header may say of an answer: unit, function and one byte; the longest PDU has 253.
inline constexpr std::size_t shortest_reply = 3, longest_reply = 254;
inline constexpr unsigned exception_bit = 0x80; ///< of the function

/// The high byte first. @pre two bytes from `at` on
inline std::size_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::size_t>(bytes[at]) << 8U | bytes[at + 1];
}

/// How many bytes follow the header, the unit in it not counted: 2 to 253. Empty for what is no
/// header, or not that of this transaction's answer by this unit.
/// @pre `header` has seven bytes
std::optional<std::size_t> modbus_reply_length(std::span<const std::uint8_t> header,
                                               std::uint16_t transaction,
                                               std::uint8_t unit);

enum class ModbusReplyKind : std::uint8_t {
    answer,
    exception, ///< the second byte is its code
    other,     ///< to another request, or too short
};
ModbusReplyKind kind_of_modbus_reply(std::span<const std::uint8_t> pdu, std::uint8_t function);

/// The words of an answer to function 3 or 4, which asked for `count` of them; empty when it holds
/// another number.
std::optional<std::vector<std::uint16_t>> registers_of_reply(std::span<const std::uint8_t> pdu,
                                                             int count);

/// The bits of an answer to function 1 or 2, each as 0 or 1; the first is the lowest of its byte.
std::optional<std::vector<std::uint16_t>> bits_of_reply(std::span<const std::uint8_t> pdu,
                                                        int count);

/// How many bytes of data answer a request by `function` for `count` bits (1, 2) or registers.
inline std::size_t bytes_of_answer(unsigned function, int count) {
    const auto number = static_cast<std::size_t>(count);
    return function < 3 ? (number + 7) / 8 : 2 * number;
}

} // namespace axiscal
