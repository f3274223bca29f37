#include "drivers/ballbar/u6_frame.hpp"

#include "drivers/framing/byte_order.hpp"

#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t extended_head = 6; ///< bytes before the data of an extended frame
constexpr int error_overflowed = 59, error_lost_scans = 60;

/// [frames] the sum of bytes, folded twice into one byte.
std::byte checksum8(Bytes bytes) {
    unsigned sum = 0;
    for (const std::byte byte : bytes)
        sum += std::to_integer<unsigned>(byte);
    sum = sum / 256 + sum % 256;
    return static_cast<std::byte>(sum / 256 + sum % 256);
}

unsigned checksum16(Bytes data) {
    unsigned sum = 0;
    for (const std::byte byte : data)
        sum += std::to_integer<unsigned>(byte);
    return sum & 0xFFFFU;
}

/// Fills length and checksums of an extended frame of whole words.
U6Bytes extended(int command, U6Bytes data) {
    const int words = static_cast<int>(data.size() / 2);
    const unsigned sum = checksum16(data);
    U6Bytes frame = bytes_of(
        {0, 0xF8, words, command, static_cast<int>(sum & 0xFFU), static_cast<int>(sum >> 8)});
    frame[0] = checksum8(Bytes{frame}.subspan(1, 5));
    frame.insert(frame.end(), data.begin(), data.end());
    return frame;
}

/// Length, head and checksums of an extended frame.
Result<void> check_extended(Bytes frame, std::size_t length, int kind, int command) {
    if (frame.size() != length) return fail(Fault::bad_frame, "a frame of the wrong length");
    if (frame[0] != checksum8(frame.subspan(1, 5)) ||
        little16(frame, 4) != checksum16(frame.subspan(extended_head)))
        return fail(Fault::checksum, "a frame whose checksum is wrong");
    const bool right = byte_at(frame, 1) == static_cast<unsigned>(kind) &&
                       byte_at(frame, 2) == (length - extended_head) / 2 &&
                       byte_at(frame, 3) == static_cast<unsigned>(command);
    if (!right) return fail(Fault::bad_frame, "a frame of another command");
    return {};
}

tl::unexpected<Error> device_error(const char* what, unsigned number) {
    return fail(Fault::refused,
                std::string{what} + " ends in the U6's error " + std::to_string(number));
}

Result<void> check_reply(Bytes reply, std::size_t length, int kind, int command, const char* what) {
    AXISCAL_CHECK(check_extended(reply, length, kind, command));
    if (const unsigned error = byte_at(reply, 6); error != 0) return device_error(what, error);
    return {};
}

/// [fixed point] 32 bits of fraction, then a signed whole number of 32 bits.
double fixed_point(Bytes bytes, std::size_t at) {
    const auto whole = static_cast<std::int32_t>(little32(bytes, at + 4));
    return whole + little32(bytes, at) / 4294967296.0;
}

} // namespace

U6Bytes u6_config_request() {
    return extended(0x08, U6Bytes(20)); // writes nothing
}

U6Bytes u6_calibration_request(int block) {
    return extended(0x2D, bytes_of({0, block}));
}

U6Bytes u6_stream_config_request(const U6StreamSetup& setup) {
    const int options = (setup.differential ? 0x80 : 0) | setup.gain_index << 4;
    const int scan_config = 0; // 4 MHz, not divided
    return extended(0x11, bytes_of({1, setup.resolution_index, setup.samples_per_packet, 0,
                                    setup.settling_factor, scan_config, setup.interval_ticks & 0xFF,
                                    setup.interval_ticks >> 8, setup.channel, options}));
}

U6Bytes u6_stream_start_request() {
    return bytes_of({0xA8, 0xA8});
}

U6Bytes u6_stream_stop_request() {
    return bytes_of({0xB0, 0xB0});
}

Result<U6Identity> decode_u6_config(Bytes reply) {
    AXISCAL_CHECK(check_reply(reply, 38, 0xF8, 0x08, "ConfigU6"));
    char firmware[16];
    std::snprintf(firmware, sizeof firmware, "%u.%02u", byte_at(reply, 10), byte_at(reply, 9));
    return U6Identity{little32(reply, 15), firmware, (byte_at(reply, 37) & 8U) != 0};
}

Result<std::array<double, 4>> decode_u6_calibration(Bytes reply) {
    AXISCAL_CHECK(check_reply(reply, 40, 0xF8, 0x2D, "ReadMem"));
    std::array<double, 4> constants{};
    for (std::size_t i = 0; i < constants.size(); ++i)
        constants[i] = fixed_point(reply, 8 + 8 * i);
    return constants;
}

Result<void> decode_u6_stream_config(Bytes reply) {
    return check_reply(reply, 8, 0xF8, 0x11, "StreamConfig");
}

/// [frames] four bytes: checksum of the other three, command + 1, error, 0.
Result<void> decode_u6_stream_start(Bytes reply) {
    if (reply.size() != 4) return fail(Fault::bad_frame, "no reply to StreamStart");
    if (reply[0] != checksum8(reply.subspan(1)))
        return fail(Fault::checksum, "a reply to StreamStart whose checksum is wrong");
    if (byte_at(reply, 1) != 0xA9) return fail(Fault::bad_frame, "a reply to another command");
    if (const unsigned error = byte_at(reply, 2); error != 0)
        return device_error("StreamStart", error);
    return {};
}

Result<U6Packet> decode_u6_packet(Bytes bytes, int samples_per_packet) {
    const auto count = static_cast<std::size_t>(samples_per_packet);
    AXISCAL_CHECK(check_extended(bytes, 14 + 2 * count, 0xF9, 0xC0));
    U6Packet packet;
    packet.counter = static_cast<int>(byte_at(bytes, 10));
    const int error = static_cast<int>(byte_at(bytes, 11));
    if (error == error_overflowed)
        packet.overflowed = true;
    else if (error == error_lost_scans)
        packet.lost_scans = little16(bytes, 6);
    else if (error != 0)
        return device_error("the stream", static_cast<unsigned>(error));
    packet.samples.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        packet.samples.push_back(static_cast<std::uint16_t>(little16(bytes, 12 + 2 * i)));
    packet.backlog = static_cast<int>(byte_at(bytes, 12 + 2 * count));
    return packet;
}

/// [calibration] slope of gain g at 2 g, negative slope at 2 g + 8, centre at 2 g + 9. Nominal:
/// 20 V over about 63 300 of 65 536 counts, divided by 10 for each step of gain.
Result<U6Range> u6_range(std::span<const double> constants, int gain_index) {
    const auto gain = static_cast<std::size_t>(gain_index);
    if (constants.size() < 16 || gain > 3) return fail(Fault::internal, "no such gain of a U6");
    const U6Range range{constants[2 * gain], constants[2 * gain + 8], constants[2 * gain + 9]};
    const double nominal_volts = 3.158e-4 / std::pow(10.0, gain_index);
    const bool plausible = std::abs(range.slope_V / nominal_volts - 1) < 0.05 &&
                           std::abs(range.negative_slope_V / nominal_volts + 1) < 0.05 &&
                           std::abs(range.centre - 33523) < 1676;
    if (!plausible)
        return fail(Fault::bad_frame, "the calibration constants in the U6's memory are none: "
                                      "have it calibrated, or choose another range");
    return range;
}

double u6_volts(std::uint16_t count, const U6Range& range) {
    if (count < range.centre) return (range.centre - count) * range.negative_slope_V;
    return (count - range.centre) * range.slope_V;
}

} // namespace axiscal
