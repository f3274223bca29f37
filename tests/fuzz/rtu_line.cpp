// Bytes on a Modbus RTU line. Pieces of the input: a byte whose low six bits are a length, then so
// many bytes; bit 6 puts a silence behind them, bit 7 their right checksum, so that this is no wall
// against the search. Every byte is a frame's or noise.

#include "drivers/framing/checksum.hpp"
#include "drivers/trigger/modbus_request.hpp"
#include "drivers/trigger/rtu_framer.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <span>

using namespace axiscal;

namespace {

constexpr std::uint8_t ours = 17;

bool has_right_checksum(const std::vector<std::uint8_t>& frame) {
    const unsigned sum = crc16_modbus(std::span{frame}.first(frame.size() - 2));
    return frame[frame.size() - 2] == (sum & 0xFFU) && frame.back() == sum >> 8U;
}

/// Bytes of the frames that can be had now.
std::size_t drain(RtuFramer& framer) {
    std::size_t taken = 0;
    while (const auto frame = framer.next()) {
        fuzz::require(frame->size() >= 4 && frame->size() <= RtuFramer::longest_frame,
                      "a frame has its bounds");
        fuzz::require(has_right_checksum(*frame), "a frame has its checksum");
        (void)parse_modbus_request(std::span{*frame}.subspan(1, frame->size() - 3));
        taken += frame->size();
    }
    return taken;
}

std::vector<std::uint8_t> piece_of(std::span<const std::uint8_t> bytes, bool with_checksum) {
    std::vector<std::uint8_t> piece(bytes.begin(), bytes.end());
    if (!with_checksum) return piece;
    const unsigned sum = crc16_modbus(piece);
    piece.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
    piece.push_back(static_cast<std::uint8_t>(sum >> 8U));
    return piece;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    RtuFramer framer{ours};
    std::size_t fed = 0, taken = 0;
    for (std::span rest{data, size}; !rest.empty();) {
        const std::uint8_t head = rest[0];
        const std::size_t length = std::min<std::size_t>(head & 63U, rest.size() - 1);
        const auto piece = piece_of(rest.subspan(1, length), (head & 128U) != 0);
        rest = rest.subspan(1 + length);
        framer.feed(piece);
        fed += piece.size();
        taken += drain(framer);
        if ((head & 64U) != 0) framer.silence();
        taken += drain(framer);
        fuzz::require(taken + framer.noise() <= fed, "no byte is used twice");
    }
    framer.silence();
    taken += drain(framer);
    fuzz::require(!framer.pending(), "a silence ends what is unfinished");
    fuzz::require(taken + framer.noise() == fed, "every byte is a frame's or noise");
    return 0;
}
