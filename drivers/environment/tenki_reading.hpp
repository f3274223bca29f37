#pragma once
// Replies and raw readings of Dracal USBTenki sensors. Pure. Sections: see
// environment_dracal_usbtenki.cpp.

#include "analysis/record/run_record.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

/// What stands between the echo of the command and the checksum [reply].
/// @errors Fault::refused for the single byte 00; bad_frame for a reply that is too short or echoes
/// another command; checksum where the XOR of all bytes is not zero.
Result<std::vector<std::byte>> decode_tenki_reply(std::span<const std::byte> reply, int command);

/// C1..C6 of an MS5611, as its two calibration replies hold them.
struct Ms5611Calibration {
    std::uint32_t c1 = 0, c2 = 0, c3 = 0, c4 = 0, c5 = 0, c6 = 0;
};
/// @errors Fault::bad_frame unless there are 12 bytes that are not all equal (erased memory).
Result<Ms5611Calibration> decode_ms5611_calibration(std::span<const std::byte> bytes);

/// Calibration of the stick, as far as its chips have any.
struct TenkiCalibration {
    std::optional<Ms5611Calibration> ms5611;
    double pt100_current_A = 1e-3; ///< current source of the PT100 interface
};

/// What a chip measures; empty for chips that no channel here has.
struct TenkiMeasure {
    ChannelKind kind;
    bool probe = false; ///< a resistance thermometer on a cable
    int rank = 0;       ///< of several chips of one kind the lowest rank is the one in the air
};
std::optional<TenkiMeasure> tenki_measure(int chip);

/// A raw reading in stored units (degC, Pa, %); empty when it is impossible (broken or missing
/// sensor), has the wrong length, or its calibration is missing.
std::optional<double>
tenki_value(int chip, std::span<const std::byte> raw, const TenkiCalibration& calibration);

/// Temperature of a platinum resistance by IEC 60751, degC; empty outside -200 .. 850 degC.
/// @param r0_ohm  resistance at 0 degC: 100 or 1000.
std::optional<double> platinum_temperature(double resistance_ohm, double r0_ohm);

} // namespace axiscal
