// Frames of a LabJack U6. The first byte chooses what the rest is taken for. Checksums are no wall
// against this search: each frame is judged as it is and with its checksums made right.

#include "drivers/ballbar/u6_frame.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>
#include <span>

using namespace axiscal;

namespace {

constexpr std::size_t extended_head = 6;

std::byte folded_sum(std::span<const std::byte> bytes) {
    unsigned sum = 0;
    for (const std::byte byte : bytes)
        sum += std::to_integer<unsigned>(byte);
    sum = sum / 256 + sum % 256;
    return static_cast<std::byte>(sum / 256 + sum % 256);
}

/// LabJack U6 user's guide, 5.1: 16 bits over the data, 8 bits over the head behind them.
U6Bytes mended(U6Bytes frame) {
    if (frame.size() < extended_head) return frame;
    unsigned sum = 0;
    for (std::size_t i = extended_head; i < frame.size(); ++i)
        sum += std::to_integer<unsigned>(frame[i]);
    frame[4] = static_cast<std::byte>(sum & 0xFFU);
    frame[5] = static_cast<std::byte>(sum >> 8 & 0xFFU);
    frame[0] = folded_sum(std::span{frame}.subspan(1, 5));
    return frame;
}

template <class T> void told(const Result<T>& result) {
    if (!result) fuzz::require(!result.error().detail.empty(), "a refusal has a reason");
}

void judge_packet(const U6Bytes& bytes, int samples) {
    const auto packet = decode_u6_packet(bytes, samples);
    told(packet);
    if (!packet) return;
    fuzz::require(packet->samples.size() == static_cast<std::size_t>(samples),
                  "a packet has its samples");
    fuzz::require(packet->counter >= 0 && packet->counter <= 255 && packet->backlog >= 0 &&
                      packet->backlog <= 255 && packet->lost_scans <= 65535,
                  "numbers stay within their fields");
}

void judge_calibration(const U6Bytes& bytes) {
    const auto four = decode_u6_calibration(bytes);
    told(four);
    if (!four) return;
    // Slope, negative slope and centre of one frame stand where those of a gain belong.
    std::vector<double> constants(16);
    for (std::size_t gain = 0; gain < 4; ++gain) {
        constants[2 * gain] = (*four)[0];
        constants[2 * gain + 8] = (*four)[1];
        constants[2 * gain + 9] = (*four)[2];
    }
    for (int gain = 0; gain < 4; ++gain) {
        const auto range = u6_range(constants, gain);
        told(range);
        if (!range) continue;
        for (const int count : {0, 1, 33523, 65535})
            fuzz::require(std::abs(u6_volts(static_cast<std::uint16_t>(count), *range)) < 12,
                          "no voltage that cannot be");
    }
}

void judge(int kind, const U6Bytes& bytes) {
    switch (kind % 5) {
    case 0: told(decode_u6_config(bytes)); break;
    case 1: judge_calibration(bytes); break;
    case 2: told(decode_u6_stream_config(bytes)); break;
    case 3: told(decode_u6_stream_start(bytes)); break;
    default: judge_packet(bytes, 1 + kind / 5 % 25); break;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const auto rest = std::as_bytes(std::span{data, size}).subspan(1);
    const U6Bytes bytes(rest.begin(), rest.end());
    judge(data[0], bytes);
    judge(data[0], mended(bytes));
    return 0;
}
