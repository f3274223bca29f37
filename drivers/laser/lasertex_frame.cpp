#include "drivers/laser/lasertex_frame.hpp"

#include "drivers/framing/byte_order.hpp"
#include "drivers/framing/checksum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

constexpr std::byte first_byte{0xAA};
/// Where the twelve bytes of data begin.
constexpr std::size_t data_at = 3;
constexpr double metres_per_step = 100e-12, metres_per_second_per_step = 100e-9;
/// No interferometer reaches so far, no axis moves so fast: beyond it the bytes are none of it.
constexpr double farthest_m = 1000, fastest_m_per_s = 100;
/// Air in which people work, and machines in it; beyond it a sensor is broken or absent.
constexpr double coldest_degC = -60, hottest_degC = 150, least_Pa = 30e3, most_Pa = 120e3;
constexpr std::uint32_t most_humidity_percent = 100;
constexpr double kelvin_per_step = 0.01, pascal_per_step = 10;
/// [signal]
constexpr std::uint32_t overspeed_bit = 1U << 3, laser_ready_bit = 1U << 0,
                        signal_enough_bit = 1U << 3;

/// 56 bits of two's complement, the high byte first: the sign is that of the highest byte.
std::int64_t signed56(std::span<const std::byte> data) {
    const std::uint64_t high = big24(data, 0), low = big16(data, 3) << 16 | big16(data, 5);
    return static_cast<std::int64_t>((high << 32 | low) << 8) >> 8;
}

LasertexSignal signal_of(std::span<const std::byte> data) {
    LasertexSignal signal;
    signal.overspeed = (byte_at(data, 9) & overspeed_bit) != 0;
    signal.laser_ready = (byte_at(data, 10) & laser_ready_bit) != 0;
    signal.weak = (byte_at(data, 10) & signal_enough_bit) == 0;
    signal.level = static_cast<int>(byte_at(data, 11));
    return signal;
}

std::optional<LasertexMessage> distance_of(std::span<const std::byte> data) {
    const double position_m = static_cast<double>(signed56(data)) * metres_per_step;
    if (std::abs(position_m) > farthest_m) return std::nullopt;
    return LasertexDistance{position_m, signal_of(data)};
}

std::optional<LasertexMessage> velocity_of(std::span<const std::byte> data) {
    const auto steps = static_cast<std::int32_t>(big16(data, 0) << 16 | big16(data, 2));
    const double velocity_m_per_s = steps * metres_per_second_per_step;
    if (std::abs(velocity_m_per_s) > fastest_m_per_s) return std::nullopt;
    return LasertexVelocity{velocity_m_per_s, signal_of(data)};
}

std::optional<double> within(double value, double low, double high) {
    return value >= low && value <= high ? std::optional{value} : std::nullopt;
}

/// Battery and radio link of a sensor follow the humidity; their units are not known. [meteo]
std::optional<LasertexMessage> meteo_of(std::span<const std::byte> data) {
    LasertexMeteo meteo;
    meteo.sensor = static_cast<int>(byte_at(data, 0));
    meteo.temperature_degC =
        within(signed16(big16(data, 1)) * kelvin_per_step, coldest_degC, hottest_degC);
    if (meteo.sensor != 0) return meteo;
    meteo.humidity_percent = within(byte_at(data, 3), 0, most_humidity_percent);
    meteo.pressure_Pa = within(big16(data, 6) * pascal_per_step, least_Pa, most_Pa);
    return meteo;
}

bool is_distance(const std::optional<LasertexMessage>& message) {
    return message && std::holds_alternative<LasertexDistance>(*message);
}

} // namespace

std::vector<std::byte> lasertex_request(LasertexCommand command) {
    const int number = static_cast<int>(command);
    auto frame = bytes_of({0xAA, number >> 8, number & 0xFF, 0, 0, 0, 0});
    frame.push_back(std::byte{crc8_nrsc5(frame)});
    return frame;
}

bool is_lasertex_frame(std::span<const std::byte> frame) {
    return frame.size() == lasertex_frame_bytes && frame.front() == first_byte &&
           std::byte{crc8_nrsc5(frame.first(lasertex_frame_bytes - 1))} == frame.back();
}

std::optional<LasertexMessage> decode_lasertex_frame(std::span<const std::byte> frame) {
    if (!is_lasertex_frame(frame)) return std::nullopt;
    const auto data = frame.subspan(data_at, 12);
    const auto command = static_cast<LasertexCommand>(big16(frame, 1));
    switch (command) {
    case LasertexCommand::distance: return distance_of(data);
    case LasertexCommand::velocity: return velocity_of(data);
    case LasertexCommand::meteo: return meteo_of(data);
    case LasertexCommand::distance_on:
    case LasertexCommand::velocity_off:
    case LasertexCommand::forget_weak_signal:
    case LasertexCommand::forget_overspeed:
    case LasertexCommand::meteo_on: return LasertexAcknowledgement{command};
    }
    return std::nullopt;
}

std::span<const std::byte> LasertexFramer::rest() const {
    return std::span{pending_}.subspan(gone_);
}

void LasertexFramer::drop(std::size_t bytes) {
    if (bytes == 0) return;
    const auto begun = [](std::uint64_t dropped) {
        return (dropped + lasertex_frame_bytes - 1) / lasertex_frame_bytes;
    };
    damaged_ += begun(dropped_in_row_ + bytes) - begun(dropped_in_row_);
    dropped_in_row_ += bytes;
    gone_ += bytes;
    complete_at_.reset();
}

/// Drops until a frame stands at the front. False: more bytes are needed to tell.
bool LasertexFramer::find_begin() {
    for (;;) {
        const auto bytes = rest();
        drop(static_cast<std::size_t>(std::ranges::find(bytes, first_byte) - bytes.begin()));
        if (rest().size() < lasertex_frame_bytes) return false;
        if (is_lasertex_frame(rest().first(lasertex_frame_bytes))) return true;
        drop(1);
    }
}

/// The frame that waits for its next one was read with these, too.
void LasertexFramer::count_behind(std::vector<LasertexArrival>& arrivals,
                                  MonotonicTime read_at) const {
    std::int64_t behind = 0;
    if (complete_at_ && is_distance(decode_lasertex_frame(rest().first(lasertex_frame_bytes))))
        ++behind;
    for (auto arrival = arrivals.rbegin(); arrival != arrivals.rend(); ++arrival) {
        if (arrival->read_at != read_at) return; // it waited from an earlier read
        arrival->behind = behind;
        if (is_distance(arrival->message)) ++behind;
    }
}

std::vector<LasertexArrival> LasertexFramer::feed(std::span<const std::byte> bytes,
                                                  MonotonicTime read_at) {
    std::vector<LasertexArrival> arrivals;
    pending_.insert(pending_.end(), bytes.begin(), bytes.end());
    while (find_begin()) {
        if (!complete_at_) complete_at_ = read_at;
        if (rest().size() < 2 * lasertex_frame_bytes) break;
        if (!is_lasertex_frame(rest().subspan(lasertex_frame_bytes, lasertex_frame_bytes))) {
            drop(1);
            continue;
        }
        const auto frame = rest().first(lasertex_frame_bytes);
        arrivals.push_back({decode_lasertex_frame(frame), *std::exchange(complete_at_, {}), 0});
        gone_ += lasertex_frame_bytes;
        dropped_in_row_ = 0;
    }
    count_behind(arrivals, read_at);
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(gone_));
    gone_ = 0;
    return arrivals;
}

std::uint64_t LasertexFramer::take_damaged() {
    return std::exchange(damaged_, 0);
}

} // namespace axiscal
