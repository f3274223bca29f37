#include "wire/modbus_slave.hpp"

#include <iterator>

namespace axiscal::simulate {

namespace {

enum Exception : std::uint8_t { illegal_function = 1, illegal_address = 2, illegal_value = 3 };

Bytes refuse(std::uint8_t function, Exception code) {
    return {static_cast<std::uint8_t>(function | 0x80U), code};
}

int word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes[at] * 256 + bytes[at + 1];
}

void put_word(Bytes& bytes, unsigned value) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes.push_back(static_cast<std::uint8_t>(value));
}

template <class Value> bool holds(const std::map<int, Value>& space, int first, int count) {
    for (int address = first; address < first + count; ++address)
        if (!space.contains(address)) return false;
    return true;
}

Bytes read_words(const std::map<int, std::uint16_t>& space, std::span<const std::uint8_t> request) {
    const int first = word(request, 1), count = word(request, 3);
    if (count < 1 || count > 125) return refuse(request[0], illegal_value);
    if (!holds(space, first, count)) return refuse(request[0], illegal_address);
    Bytes answer{request[0], static_cast<std::uint8_t>(2 * count)};
    for (int address = first; address < first + count; ++address)
        put_word(answer, space.at(address));
    return answer;
}

Bytes read_bits(const std::map<int, bool>& space, std::span<const std::uint8_t> request) {
    const int first = word(request, 1), count = word(request, 3);
    if (count < 1 || count > 2000) return refuse(request[0], illegal_value);
    if (!holds(space, first, count)) return refuse(request[0], illegal_address);
    Bytes answer{request[0], static_cast<std::uint8_t>((count + 7) / 8)};
    answer.resize(2 + static_cast<std::size_t>(answer[1]));
    for (int i = 0; i < count; ++i)
        if (space.at(first + i)) {
            std::uint8_t& byte = answer[2 + static_cast<std::size_t>(i / 8)];
            byte = static_cast<std::uint8_t>(byte | (1U << (i % 8)));
        }
    return answer;
}

Bytes write_one(RegisterBank& bank, std::span<const std::uint8_t> request) {
    const int address = word(request, 1);
    if (request[0] == 6) {
        if (!bank.holding.contains(address)) return refuse(request[0], illegal_address);
        bank.holding[address] = static_cast<std::uint16_t>(word(request, 3));
    } else {
        if (!bank.coils.contains(address)) return refuse(request[0], illegal_address);
        if (word(request, 3) != 0xFF00 && word(request, 3) != 0)
            return refuse(request[0], illegal_value);
        bank.coils[address] = request[3] != 0;
    }
    return {request.begin(), request.begin() + 5};
}

Bytes write_many(RegisterBank& bank, std::span<const std::uint8_t> request) {
    const int first = word(request, 1), count = word(request, 3);
    const bool words = request[0] == 16;
    const int bytes = words ? 2 * count : (count + 7) / 8;
    const bool right = request.size() >= 6 && count >= 1 && request[5] == bytes &&
                       request.size() == 6 + static_cast<std::size_t>(bytes);
    if (!right) return refuse(request[0], illegal_value);
    if (words ? !holds(bank.holding, first, count) : !holds(bank.coils, first, count))
        return refuse(request[0], illegal_address);
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(words ? 6 + 2 * i : 6 + i / 8);
        if (words)
            bank.holding[first + i] = static_cast<std::uint16_t>(word(request, at));
        else
            bank.coils[first + i] = ((request[at] >> (i % 8)) & 1) != 0;
    }
    return {request.begin(), request.begin() + 5};
}

} // namespace

std::uint16_t crc16_modbus(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xA001U : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

Bytes answer_pdu(RegisterBank& bank, std::span<const std::uint8_t> request) {
    if (request.empty()) return {};
    if (!bank.functions.contains(request[0])) return refuse(request[0], illegal_function);
    if (request.size() < 5) return refuse(request[0], illegal_value);
    switch (request[0]) {
    case 1: return read_bits(bank.coils, request);
    case 2: return read_bits(bank.discretes, request);
    case 3: return read_words(bank.holding, request);
    case 4: return read_words(bank.input, request);
    case 5:
    case 6: return write_one(bank, request);
    case 15:
    case 16: return write_many(bank, request);
    default: return refuse(request[0], illegal_function);
    }
}

std::optional<std::size_t> rtu_request_length(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 2) return std::nullopt;
    if (bytes[1] >= 1 && bytes[1] <= 6) return 8;
    if (bytes[1] != 15 && bytes[1] != 16) return 0;
    if (bytes.size() < 7) return std::nullopt;
    return 9 + static_cast<std::size_t>(bytes[6]);
}

Bytes rtu_frame(int unit, std::span<const std::uint8_t> pdu) {
    Bytes frame{static_cast<std::uint8_t>(unit)};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    const std::uint16_t crc = crc16_modbus(frame);
    frame.push_back(static_cast<std::uint8_t>(crc)); // low byte first
    frame.push_back(static_cast<std::uint8_t>(crc >> 8));
    return frame;
}

bool rtu_crc_right(std::span<const std::uint8_t> frame) {
    if (frame.size() < 4) return false;
    const std::uint16_t crc = crc16_modbus(frame.first(frame.size() - 2));
    return frame[frame.size() - 2] == (crc & 0xFF) && frame.back() == crc >> 8;
}

Bytes tcp_frame(std::uint16_t transaction, int unit, std::span<const std::uint8_t> pdu) {
    Bytes frame;
    put_word(frame, transaction);
    put_word(frame, 0);
    put_word(frame, static_cast<unsigned>(pdu.size() + 1));
    frame.push_back(static_cast<std::uint8_t>(unit));
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    return frame;
}

} // namespace axiscal::simulate
