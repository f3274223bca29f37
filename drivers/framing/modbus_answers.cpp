#include "drivers/framing/modbus_answers.hpp"

#include "drivers/framing/checksum.hpp"
#include "drivers/framing/modbus_reply.hpp"

namespace axiscal {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Kind = ModbusAnswer::Kind;

constexpr std::size_t crc_bytes = 2;
constexpr std::size_t exception_frame = 5; // unit, function, code, checksum
constexpr std::size_t mbap_prefix = 6, mbap_header = 7;

void put_word(std::vector<std::uint8_t>& bytes, unsigned word) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(word));
}

std::vector<std::byte> as_bytes(const std::vector<std::uint8_t>& numbers) {
    const auto bytes = std::as_bytes(std::span{numbers});
    return {bytes.begin(), bytes.end()};
}

void put_question(std::vector<std::uint8_t>& bytes, const ModbusQuestion& question) {
    bytes.push_back(question.unit);
    bytes.push_back(question.function);
    put_word(bytes, question.address);
    put_word(bytes, static_cast<unsigned>(question.count));
}

void append(std::vector<std::uint8_t>& held, std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes)
        held.push_back(std::to_integer<std::uint8_t>(byte));
}

ModbusAnswer judged(Bytes pdu, const ModbusQuestion& question) {
    switch (kind_of_modbus_reply(pdu, question.function)) {
    case ModbusReplyKind::exception:
        return pdu.size() == 2 ? ModbusAnswer{Kind::exception, {}, pdu[1]} : ModbusAnswer{};
    case ModbusReplyKind::answer:
        if (auto words = question.function < 3 ? bits_of_reply(pdu, question.count)
                                               : registers_of_reply(pdu, question.count))
            return {Kind::words, *std::move(words)};
        return {};
    case ModbusReplyKind::other: break;
    }
    return {};
}

bool has_its_checksum(Bytes frame) {
    const unsigned sum = crc16_modbus(frame.first(frame.size() - crc_bytes));
    return frame[frame.size() - 2] == (sum & 0xFFU) && frame[frame.size() - 1] == sum >> 8U;
}

} // namespace

std::vector<std::byte> rtu_request(const ModbusQuestion& question) {
    std::vector<std::uint8_t> frame;
    put_question(frame, question);
    const unsigned sum = crc16_modbus(frame);
    frame.push_back(static_cast<std::uint8_t>(sum));
    frame.push_back(static_cast<std::uint8_t>(sum >> 8U));
    return as_bytes(frame);
}

std::vector<std::byte> tcp_request(const ModbusQuestion& question, std::uint16_t transaction) {
    std::vector<std::uint8_t> frame;
    put_word(frame, transaction);
    put_word(frame, 0);
    put_word(frame, 6); // unit, function, address, count
    put_question(frame, question);
    return as_bytes(frame);
}

void RtuAnswer::feed(std::span<const std::byte> bytes) {
    append(held_, bytes);
}

std::optional<ModbusAnswer> RtuAnswer::take() {
    while (held_.size() >= 3) {
        const unsigned function = held_[1] & ~exception_bit;
        const bool exception = (held_[1] & exception_bit) != 0;
        const bool ours = held_[0] == question_.unit;
        if (function < 1 || function > 4) return ModbusAnswer{};
        // Told at once: with another count it is not waited for.
        if (ours && !exception && held_[2] != bytes_of_answer(question_.function, question_.count))
            return ModbusAnswer{};
        const std::size_t length = exception ? exception_frame : exception_frame + held_[2];
        if (held_.size() < length) return std::nullopt;
        const Bytes frame = Bytes{held_}.first(length);
        if (!has_its_checksum(frame)) return ModbusAnswer{Kind::damaged, {}, 0};
        if (ours) // 2.5.1.1: frames lie 3.5 characters apart, so what follows makes it none
            return held_.size() > length ? ModbusAnswer{}
                                         : judged(frame.subspan(1, length - 3), question_);
        held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(length));
    }
    return std::nullopt;
}

void TcpAnswers::feed(std::span<const std::byte> bytes) {
    append(held_, bytes);
}

std::optional<ModbusAnswer> TcpAnswers::take(const ModbusQuestion& question,
                                             std::uint16_t transaction) {
    while (held_.size() >= mbap_header) {
        const std::size_t length = word_at(held_, 4);
        if (word_at(held_, 2) != 0 || length < shortest_reply || length > longest_reply)
            return ModbusAnswer{Kind::out_of_step, {}, 0};
        if (held_.size() < mbap_prefix + length) return std::nullopt;
        const auto end = held_.begin() + static_cast<std::ptrdiff_t>(mbap_prefix + length);
        const std::vector<std::uint8_t> frame(held_.begin(), end);
        held_.erase(held_.begin(), end);
        if (word_at(frame, 0) != transaction) continue; // a late one
        const Bytes pdu = Bytes{frame}.subspan(mbap_header);
        return frame[mbap_prefix] == question.unit ? judged(pdu, question) : ModbusAnswer{};
    }
    return std::nullopt;
}

} // namespace axiscal
