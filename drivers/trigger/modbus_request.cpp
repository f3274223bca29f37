#include "drivers/trigger/modbus_request.hpp"

namespace axiscal {
namespace {

using namespace modbus_function;
using Parsed = tl::expected<ModbusRequest, ModbusException>;

// Largest counts of one request, as the protocol gives them per function.
constexpr int most_bits_read = 2000, most_words_read = 125, most_bits_written = 1968,
              most_words_written = 123, most_words_written_by_23 = 121;
constexpr int coil_on = 0xFF00;

Parsed wrong_value() {
    return tl::unexpected(ModbusException::illegal_value);
}

int word_at(std::span<const std::uint8_t> pdu, std::size_t place) {
    return pdu[place] << 8 | pdu[place + 1];
}

Parsed parse_read(std::span<const std::uint8_t> pdu, int most) {
    if (pdu.size() != 5) return wrong_value();
    ModbusRequest request{pdu[0], word_at(pdu, 1), word_at(pdu, 3), 0, {}};
    if (request.read_count < 1 || request.read_count > most) return wrong_value();
    return request;
}

Parsed parse_single_write(std::span<const std::uint8_t> pdu) {
    if (pdu.size() != 5) return wrong_value();
    int value = word_at(pdu, 3);
    if (pdu[0] == write_coil) {
        if (value != 0 && value != coil_on) return wrong_value();
        value = value == coil_on ? 1 : 0;
    }
    return ModbusRequest{pdu[0], 0, 0, word_at(pdu, 1), {static_cast<std::uint16_t>(value)}};
}

Parsed parse_coils_write(std::span<const std::uint8_t> pdu) {
    if (pdu.size() < 7) return wrong_value();
    const int count = word_at(pdu, 3);
    const auto bytes = static_cast<std::size_t>((count + 7) / 8);
    if (count < 1 || count > most_bits_written || pdu[5] != bytes || pdu.size() != 6 + bytes)
        return wrong_value();
    ModbusRequest request{pdu[0], 0, 0, word_at(pdu, 1), {}};
    for (std::size_t bit = 0; bit < static_cast<std::size_t>(count); ++bit)
        request.values.push_back((pdu[6 + bit / 8] >> (bit % 8)) & 1);
    return request;
}

/// `place`: where the written block's address, count, byte count and words begin.
Parsed parse_words(std::span<const std::uint8_t> pdu, std::size_t place, int most) {
    if (pdu.size() < place + 7) return wrong_value();
    const int count = word_at(pdu, place + 2);
    const std::size_t bytes = 2 * static_cast<std::size_t>(count);
    if (count < 1 || count > most || pdu[place + 4] != bytes || pdu.size() != place + 5 + bytes)
        return wrong_value();
    ModbusRequest request{pdu[0], 0, 0, word_at(pdu, place), {}};
    for (std::size_t at = place + 5; at < pdu.size(); at += 2)
        request.values.push_back(static_cast<std::uint16_t>(word_at(pdu, at)));
    return request;
}

Parsed parse_read_write(std::span<const std::uint8_t> pdu) {
    auto request = parse_words(pdu, 5, most_words_written_by_23);
    if (!request) return request;
    request->read_address = word_at(pdu, 1);
    request->read_count = word_at(pdu, 3);
    if (request->read_count < 1 || request->read_count > most_words_read) return wrong_value();
    return request;
}

} // namespace

bool ModbusRequest::writes_coils() const {
    return function == write_coil || function == write_coils;
}

Parsed parse_modbus_request(std::span<const std::uint8_t> pdu) {
    if (pdu.empty()) return wrong_value();
    switch (pdu[0]) {
    case read_coils:
    case read_discrete_inputs: return parse_read(pdu, most_bits_read);
    case read_holding:
    case read_input: return parse_read(pdu, most_words_read);
    case write_coil:
    case write_register: return parse_single_write(pdu);
    case write_coils: return parse_coils_write(pdu);
    case write_registers: return parse_words(pdu, 1, most_words_written);
    case read_write_registers: return parse_read_write(pdu);
    default: return tl::unexpected(ModbusException::illegal_function);
    }
}

} // namespace axiscal
