#pragma once
// Commands, replies and stream packets of a LabJack U6. Pure. Sections: see
// ballbar_labjack_u6.cpp.

#include "analysis/quantity/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

using U6Bytes = std::vector<std::byte>;

/// How one channel is streamed.
struct U6StreamSetup {
    int channel = 0;           ///< positive input: AIN0 .. AIN13
    bool differential = false; ///< against the next, odd channel
    int gain_index = 0;        ///< 0: +-10 V, 1: +-1 V, 2: +-0.1 V, 3: +-0.01 V
    int resolution_index = 1;  ///< 1 .. 8; higher is finer and slower
    int settling_factor = 0;
    int interval_ticks = 4000; ///< of 4 MHz between samples
    int samples_per_packet = 25;
};

U6Bytes u6_config_request();
/// @param block  0 .. 9, four constants each.
U6Bytes u6_calibration_request(int block);
U6Bytes u6_stream_config_request(const U6StreamSetup& setup);
U6Bytes u6_stream_start_request();
U6Bytes u6_stream_stop_request();

struct U6Identity {
    std::uint32_t serial = 0;
    std::string firmware; ///< "1.43"
    bool is_pro = false;
};
/// @errors, of all replies: Fault::bad_frame for a wrong length or another command, checksum,
/// refused with the number of the device's own error.
Result<U6Identity> decode_u6_config(std::span<const std::byte> reply);
Result<std::array<double, 4>> decode_u6_calibration(std::span<const std::byte> reply);
Result<void> decode_u6_stream_config(std::span<const std::byte> reply);
Result<void> decode_u6_stream_start(std::span<const std::byte> reply);

/// One StreamData response.
struct U6Packet {
    int counter = 0;              ///< 0 .. 255, then 0 again
    bool overflowed = false;      ///< error 59: the U6's buffer ran over, older samples are sent
    std::uint32_t lost_scans = 0; ///< error 60: so many are missing before this packet
    int backlog = 0;              ///< of the U6's buffer, 0 .. 255
    std::vector<std::uint16_t> samples;
};
/// @errors Fault::bad_frame, checksum; refused with any other error number.
Result<U6Packet> decode_u6_packet(std::span<const std::byte> bytes, int samples_per_packet);

/// Calibration of one gain, from the device's own memory.
struct U6Range {
    double slope_V = 0, negative_slope_V = 0; ///< per count, above and below the centre
    double centre = 0;                        ///< count at 0 V
};
/// The constants of `gain_index` out of those of blocks 0 to 3.
/// @errors Fault::bad_frame where they are none: erased memory, or a slope that is 5 % off.
Result<U6Range> u6_range(std::span<const double> constants, int gain_index);
/// Volts of one 16-bit sample.
double u6_volts(std::uint16_t count, const U6Range& range);

} // namespace axiscal
