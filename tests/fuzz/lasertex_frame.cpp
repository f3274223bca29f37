// Bytes of a Lasertex HPI-3D. A checksum is no wall against this search: each piece of 16 bytes is
// judged as it is and with its first byte and its checksum made right, the whole as a stream.

#include "drivers/laser/lasertex_frame.hpp"
#include "drivers/framing/checksum.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <cmath>

using namespace axiscal;

namespace {

using Bytes = std::vector<std::byte>;

Bytes mended(std::span<const std::byte> piece) {
    Bytes frame(piece.begin(), piece.end());
    frame.front() = std::byte{0xAA};
    frame.back() = std::byte{crc8_nrsc5(std::span{frame}.first(lasertex_frame_bytes - 1))};
    return frame;
}

bool within(const std::optional<double>& value, double low, double high) {
    return !value || (*value >= low && *value <= high);
}

struct JudgeOfMessages {
    void operator()(const LasertexDistance& distance) const {
        fuzz::require(within(distance.position_m, -1000, 1000), "no position that cannot be");
        fuzz::require(distance.signal.level >= 0 && distance.signal.level <= 255,
                      "a level is a byte");
    }
    void operator()(const LasertexVelocity& velocity) const {
        fuzz::require(within(velocity.velocity_m_per_s, -100, 100), "no velocity that cannot be");
    }
    void operator()(const LasertexMeteo& meteo) const {
        fuzz::require(meteo.sensor >= 0 && meteo.sensor <= 255, "a sensor is a byte");
        fuzz::require(within(meteo.temperature_degC, -60, 150), "no temperature that cannot be");
        fuzz::require(within(meteo.humidity_percent, 0, 100), "no humidity that cannot be");
        fuzz::require(within(meteo.pressure_Pa, 30e3, 120e3), "no pressure that cannot be");
        fuzz::require(meteo.sensor == 0 || (!meteo.humidity_percent && !meteo.pressure_Pa),
                      "a material has a temperature alone");
    }
    void operator()(const LasertexAcknowledgement& answer) const {
        const auto request = lasertex_request(answer.command);
        fuzz::require(request.size() == 8, "what is acknowledged can be ordered");
    }
};

void judge_piece(std::span<const std::byte> piece) {
    if (const auto message = decode_lasertex_frame(piece)) std::visit(JudgeOfMessages{}, *message);
}

/// The bytes of a stream that are handed up must stand in it, in order.
void judge_stream(std::span<const std::byte> bytes) {
    LasertexFramer at_once, byte_by_byte;
    const auto whole = at_once.feed(bytes, {});
    std::size_t split = 0;
    std::uint64_t damaged_split = 0;
    for (const std::byte& byte : bytes) {
        split += byte_by_byte.feed({&byte, 1}, {}).size();
        damaged_split += byte_by_byte.take_damaged();
    }
    fuzz::require(whole.size() == split, "reads that split a frame change nothing");
    fuzz::require(at_once.take_damaged() == damaged_split,
                  "reads that split damage change nothing");
    fuzz::require((whole.size() + (whole.empty() ? 0 : 1)) * lasertex_frame_bytes <= bytes.size(),
                  "each frame has another one behind it");
    for (const LasertexArrival& arrival : whole)
        if (arrival.message) std::visit(JudgeOfMessages{}, *arrival.message);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span{data, size});
    judge_stream(bytes);
    Bytes stream;
    for (std::size_t at = 0; at + lasertex_frame_bytes <= size; at += lasertex_frame_bytes) {
        const auto piece = bytes.subspan(at, lasertex_frame_bytes);
        judge_piece(piece);
        const Bytes frame = mended(piece);
        judge_piece(frame);
        stream.insert(stream.end(), frame.begin(), frame.end());
    }
    judge_stream(stream);
    return 0;
}
