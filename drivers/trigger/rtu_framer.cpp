#include "drivers/trigger/rtu_framer.hpp"

#include "drivers/framing/checksum.hpp"
#include "drivers/trigger/modbus_request.hpp"

#include <array>

namespace axiscal {
namespace {

using namespace modbus_function;
using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t crc_bytes = 2;
constexpr std::size_t shortest_frame = 4; // address, function, checksum
constexpr std::uint8_t broadcast = 0;
constexpr unsigned exception_bit = 0x80;

/// Until the bytes that tell the length are there, and where no rule tells it, a frame may grow to
/// the longest.
constexpr std::size_t untold = RtuFramer::longest_frame;

bool is_known(std::uint8_t function) {
    return (function >= read_coils && function <= write_register) || function == write_coils ||
           function == write_registers || function == read_write_registers;
}

std::size_t request_length(Bytes frame) {
    switch (frame[1]) {
    case read_coils:
    case read_discrete_inputs:
    case read_holding:
    case read_input:
    case write_coil:
    case write_register: return 8;
    case write_coils:
    case write_registers: return frame.size() < 7 ? untold : 9U + frame[6];
    case read_write_registers: return frame.size() < 11 ? untold : 13U + frame[10];
    default: return untold;
    }
}

std::size_t answer_length(Bytes frame) {
    switch (frame[1]) {
    case read_coils:
    case read_discrete_inputs:
    case read_holding:
    case read_input:
    case read_write_registers: return 5U + frame[2];
    case write_coil:
    case write_register:
    case write_coils:
    case write_registers: return 8;
    default: return (frame[1] & exception_bit) != 0 ? 5 : untold;
    }
}

bool is_whole(Bytes bytes, std::size_t length) {
    if (length < shortest_frame || length > RtuFramer::longest_frame || length > bytes.size())
        return false;
    const unsigned sum = crc16_modbus(bytes.first(length - crc_bytes));
    return bytes[length - 2] == (sum & 0xFFU) && bytes[length - 1] == sum >> 8U;
}

bool may_grow_to(Bytes bytes, std::size_t length) {
    return length <= RtuFramer::longest_frame && length > bytes.size();
}

} // namespace

Bytes RtuFramer::rest() const {
    return Bytes{bytes_}.subspan(begin_);
}

void RtuFramer::feed(Bytes bytes) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::vector<std::uint8_t> RtuFramer::cut(std::size_t length) {
    const Bytes frame = rest().first(length);
    begin_ += length;
    in_step_ = true;
    return {frame.begin(), frame.end()};
}

std::optional<std::vector<std::uint8_t>> RtuFramer::next() {
    for (; rest().size() >= shortest_frame; ++begin_, ++noise_, in_step_ = false) {
        const Bytes bytes = rest();
        const bool request_only = bytes[0] == unit_ || bytes[0] == broadcast;
        const std::array<std::size_t, 2> forms{request_length(bytes),
                                               request_only ? 0 : answer_length(bytes)};
        for (const std::size_t length : forms)
            if (is_whole(bytes, length)) return cut(length);
        if (!silent_ && (may_grow_to(bytes, forms[0]) || may_grow_to(bytes, forms[1]))) return {};
        // What lies between silences is one frame also where we do not know its function.
        if (silent_ && in_step_ && !is_known(bytes[1]) && is_whole(bytes, bytes.size()))
            return cut(bytes.size());
    }
    if (silent_) {
        noise_ += rest().size();
        begin_ = bytes_.size();
        silent_ = false;
        in_step_ = true;
    }
    return {};
}

} // namespace axiscal
