#pragma once
// Frames of a Lasertex HPI-3D (Status Pro uLine-f1): commands out, data and acknowledgements in.
// Pure. [frame], [distance] and so on: see laser_lasertex.cpp for the document they cite.

#include "analysis/quantity/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace axiscal {

/// Of what the laser sends; a command to it has 8. [frame]
inline constexpr std::size_t lasertex_frame_bytes = 16;

/// Second and third byte of a frame. The last six go out, and come back as acknowledgement.
enum class LasertexCommand : std::uint16_t {
    meteo = 0xB00A,
    distance = 0xB015,
    velocity = 0xB016,
    distance_on = 0xB032,
    velocity_off = 0xB035,
    forget_weak_signal = 0xB03D,
    forget_overspeed = 0xB03F,
    meteo_on = 0xB079,
};

/// [signal] The laser keeps the two faults until it is told to forget them.
struct LasertexSignal {
    bool overspeed = false, weak = false;
    bool laser_ready = false;
    int level = 0; ///< 0 to 255, its unit is not known
};
struct LasertexDistance {
    double position_m = 0; ///< steps of 100 pm, raw or compensated: the frame does not tell
    LasertexSignal signal;
};
struct LasertexVelocity {
    double velocity_m_per_s = 0;
    LasertexSignal signal;
};
/// What no air and no machine has is empty.
struct LasertexMeteo {
    int sensor = 0; ///< 0: air; 1 and on: material, without humidity and pressure
    std::optional<double> temperature_degC, humidity_percent, pressure_Pa;
};
struct LasertexAcknowledgement {
    LasertexCommand command{};
};
using LasertexMessage =
    std::variant<LasertexDistance, LasertexVelocity, LasertexMeteo, LasertexAcknowledgement>;

/// The 8 bytes of a command without data.
std::vector<std::byte> lasertex_request(LasertexCommand command);

/// 16 bytes with the right first one and the right checksum, whatever they say. Of random bytes one
/// in 65536 is: alone this proves nothing.
bool is_lasertex_frame(std::span<const std::byte> frame);
/// Empty: no frame, an unknown command, or a number that cannot be.
std::optional<LasertexMessage> decode_lasertex_frame(std::span<const std::byte> frame);

struct LasertexArrival {
    std::optional<LasertexMessage> message; ///< empty: a frame that says nothing known
    MonotonicTime read_at;                  ///< when its last byte was read
    std::int64_t behind = 0;                ///< distances behind it that were read with it
};

/// Cuts bytes into frames. A frame counts only when another one stands directly behind it: an 8-bit
/// checksum would let 0.02 false positions pass in 10^8 random bytes (2^-32 each: AA, two bytes of
/// the command, checksum), and one torn frame in 256. The frame behind, whose command may be
/// unknown, costs chance another 2^-16 (AA, checksum); of the positions that are left 2.8e-4 are
/// within 1000 m. Expected in 10^8 random bytes: 1e-10 false positions, 4e-7 false readings of air
/// or material. The price: a frame is handed up when the next has come, 40 ms later, with the time
/// of its own arrival; and the frame before each disturbance is lost with it.
/// Damage that leaves 16 bytes between two whole frames (several changed in one, or two torn ones
/// that fit together) is held against the checksum alone: it passes once in 255.
class LasertexFramer {
public:
    /// The frames that these bytes confirmed, the oldest first.
    std::vector<LasertexArrival> feed(std::span<const std::byte> bytes, MonotonicTime read_at);
    /// What was dropped since asked last: one for each begun 16 bytes of a disturbance.
    std::uint64_t take_damaged();

private:
    [[nodiscard]] std::span<const std::byte> rest() const;
    [[nodiscard]] bool find_begin();
    void count_behind(std::vector<LasertexArrival>& arrivals, MonotonicTime read_at) const;
    void drop(std::size_t bytes);

    std::vector<std::byte> pending_;
    std::size_t gone_ = 0; ///< of pending_: what lies before was used or dropped
    std::optional<MonotonicTime> complete_at_; ///< of the frame that waits for the next
    std::uint64_t dropped_in_row_ = 0, damaged_ = 0;
};

} // namespace axiscal
