#include "drivers/environment/tenki_reading.hpp"

#include "drivers/framing/byte_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axiscal {
namespace {

using Raw = std::span<const std::byte>;

// [chips] numbers as usbtenki_cmds.h has them.
enum Chip : int {
    pt100_rtd = 0x12,
    ms5611_pressure = 0x15,
    ms5611_temperature = 0x16,
    sht31_humidity = 0x19,
    sht35_humidity = 0x1A,
    sht35_temperature = 0x1B,
    sht31_temperature = 0x20,
    rtd300_pt100_3_wire = 0x34,
    rtd300_pt100_2_wire = 0x35,
    rtd300_pt1000_3_wire = 0x36,
    internal_temperature = 0xB0,
    internal_humidity = 0xB1,
    external_temperature = 0xB2,
    external_humidity = 0xB3,
};

/// The MS5611's own temperature is that of the stick, warmer than the air: it comes last.
struct ChipRow {
    int chip = 0;
    TenkiMeasure measure;
};
constexpr std::array chip_rows{
    ChipRow{external_temperature, {ChannelKind::temperature, false, 0}},
    ChipRow{sht35_temperature, {ChannelKind::temperature, false, 1}},
    ChipRow{sht31_temperature, {ChannelKind::temperature, false, 2}},
    ChipRow{internal_temperature, {ChannelKind::temperature, false, 3}},
    ChipRow{ms5611_temperature, {ChannelKind::temperature, false, 4}},
    ChipRow{ms5611_pressure, {ChannelKind::pressure, false, 0}},
    ChipRow{external_humidity, {ChannelKind::humidity, false, 0}},
    ChipRow{sht35_humidity, {ChannelKind::humidity, false, 1}},
    ChipRow{sht31_humidity, {ChannelKind::humidity, false, 2}},
    ChipRow{internal_humidity, {ChannelKind::humidity, false, 3}},
    ChipRow{rtd300_pt100_3_wire, {ChannelKind::temperature, true, 0}},
    ChipRow{rtd300_pt100_2_wire, {ChannelKind::temperature, true, 0}},
    ChipRow{rtd300_pt1000_3_wire, {ChannelKind::temperature, true, 0}},
    ChipRow{pt100_rtd, {ChannelKind::temperature, true, 0}},
};

struct Ms5611Result {
    std::int64_t hundredths_degC = 0, pascals = 0;
};

/// MS5611-01BA03 data sheet, "Pressure and temperature calculation", with its integer arithmetic:
/// hundredths of a degree and whole pascals, truncated. 64 bits throughout: dT squared needs them.
Ms5611Result ms5611(std::uint32_t d1, std::uint32_t d2, const Ms5611Calibration& c) {
    const std::int64_t dt = std::int64_t{d2} - std::int64_t{c.c5} * 256;
    std::int64_t temperature = 2000 + dt * std::int64_t{c.c6} / 8'388'608;
    std::int64_t offset = std::int64_t{c.c2} * 65'536 + std::int64_t{c.c4} * dt / 128;
    std::int64_t sensitivity = std::int64_t{c.c1} * 32'768 + std::int64_t{c.c3} * dt / 256;
    if (temperature < 2000) {
        const std::int64_t below_20 = temperature - 2000, below_minus_15 = temperature + 1500;
        std::int64_t offset_2 = 5 * below_20 * below_20 / 2;
        std::int64_t sensitivity_2 = 5 * below_20 * below_20 / 4;
        if (temperature < -1500) {
            offset_2 += 7 * below_minus_15 * below_minus_15;
            sensitivity_2 += 11 * below_minus_15 * below_minus_15 / 2;
        }
        temperature -= dt * dt / 2'147'483'648;
        offset -= offset_2;
        sensitivity -= sensitivity_2;
    }
    return {temperature, (std::int64_t{d1} * sensitivity / 2'097'152 - offset) / 32'768};
}

std::optional<double> ms5611_value(int chip, Raw raw, const TenkiCalibration& calibration) {
    const bool pressure = chip == ms5611_pressure;
    if (!calibration.ms5611 || raw.size() != (pressure ? 6U : 3U)) return std::nullopt;
    const std::uint32_t d1 = pressure ? little24(raw, 0) : 0;
    const std::uint32_t d2 = little24(raw, pressure ? 3 : 0);
    // 0 is what the chip gives when it was not ready.
    if (d2 == 0 || (pressure && d1 == 0)) return std::nullopt;
    const Ms5611Result result = ms5611(d1, d2, *calibration.ms5611);
    if (pressure) return static_cast<double>(result.pascals);
    return static_cast<double>(result.hundredths_degC) / 100;
}

std::optional<double> sht3x_value(Raw raw, double offset, double span) {
    if (raw.size() != 2) return std::nullopt;
    return offset + span * big16(raw, 0) / 65'535;
}

/// [rtd300] gain is 2^(high half of byte 5); 2-wire: the source's current by its low half.
std::optional<double> rtd300_value(int chip, Raw raw) {
    constexpr std::array source_microamperes{0, 10, 50, 100, 250, 500, 750, 1000, 1500, 2000};
    if (raw.size() != 8) return std::nullopt;
    const double gain = std::ldexp(1.0, static_cast<int>(byte_at(raw, 5) >> 4));
    const double part = big24(raw, 0) / 8'388'608.0 / gain;
    if (chip == rtd300_pt100_2_wire) {
        const std::size_t row = byte_at(raw, 5) & 15U;
        if (row == 0 || row >= source_microamperes.size()) return std::nullopt;
        return platinum_temperature(part * 2.5 / (source_microamperes[row] * 1e-6), 100);
    }
    const double reference_ohm = big16(raw, 3) + signed16(big16(raw, 6)) / 8192.0;
    return platinum_temperature(part * reference_ohm, chip == rtd300_pt1000_3_wire ? 1000 : 100);
}

/// A signed number of 18 bits in three bytes, high byte first.
double signed18(Raw raw, std::size_t at) {
    const int bits = static_cast<int>(big24(raw, at) & 0x3FFFFU);
    return bits >= 0x20000 ? bits - 0x40000 : bits;
}

/// [pt100] the whole loop at gain 2, one lead at gain 8; the leads are taken off twice.
std::optional<double> pt100_value(Raw raw, const TenkiCalibration& calibration) {
    constexpr double step_volts = 15.625e-6;
    if (raw.size() != 6) return std::nullopt;
    const double loop_volts = signed18(raw, 0) * step_volts / 2,
                 lead_volts = signed18(raw, 3) * step_volts / 8;
    return platinum_temperature((loop_volts - 2 * lead_volts) / calibration.pt100_current_A, 100);
}

std::optional<double> converted(int chip, Raw raw, const TenkiCalibration& calibration) {
    switch (chip) {
    case ms5611_pressure:
    case ms5611_temperature: return ms5611_value(chip, raw, calibration);
    case sht31_temperature:
    case sht35_temperature:
    case internal_temperature:
    case external_temperature: return sht3x_value(raw, -45, 175);
    case sht31_humidity:
    case sht35_humidity:
    case internal_humidity:
    case external_humidity: return sht3x_value(raw, 0, 100);
    case rtd300_pt100_3_wire:
    case rtd300_pt100_2_wire:
    case rtd300_pt1000_3_wire: return rtd300_value(chip, raw);
    case pt100_rtd: return pt100_value(raw, calibration);
    default: return std::nullopt;
    }
}

/// Ranges of the sensors' data sheets; a probe's is that of platinum.
bool possible(const TenkiMeasure& measure, double value) {
    if (measure.probe) return true;
    switch (measure.kind) {
    case ChannelKind::pressure: return value >= 30'000 && value <= 120'000;
    // The ends of the scale are what a broken line to the chip reads.
    case ChannelKind::humidity: return value > 0 && value < 100;
    default: return value > -40 && value < 125;
    }
}

} // namespace

Result<std::vector<std::byte>> decode_tenki_reply(std::span<const std::byte> reply, int command) {
    if (reply.size() == 1 && reply[0] == std::byte{0})
        return fail(Fault::refused, "the sensor reports an error");
    if (reply.size() < 2) return fail(Fault::bad_frame, "a reply without content");
    std::byte sum{};
    for (const std::byte byte : reply)
        sum ^= byte;
    if (sum != std::byte{0}) return fail(Fault::checksum, "a reply whose checksum is wrong");
    if (byte_at(reply, 0) != static_cast<std::uint32_t>(command))
        return fail(Fault::bad_frame, "a reply to another command");
    return std::vector<std::byte>(reply.begin() + 1, reply.end() - 1);
}

Result<Ms5611Calibration> decode_ms5611_calibration(std::span<const std::byte> bytes) {
    const bool erased = std::ranges::all_of(bytes, [&](std::byte b) { return b == bytes[0]; });
    if (bytes.size() != 12 || erased)
        return fail(Fault::bad_frame, "no calibration of the pressure sensor");
    return Ms5611Calibration{little16(bytes, 0), little16(bytes, 2), little16(bytes, 4),
                             little16(bytes, 6), little16(bytes, 8), little16(bytes, 10)};
}

std::optional<TenkiMeasure> tenki_measure(int chip) {
    const auto found = std::ranges::find(chip_rows, chip, &ChipRow::chip);
    if (found == chip_rows.end()) return std::nullopt;
    return found->measure;
}

std::optional<double>
tenki_value(int chip, std::span<const std::byte> raw, const TenkiCalibration& calibration) {
    const auto measure = tenki_measure(chip);
    const auto value = converted(chip, raw, calibration);
    if (!measure || !value || !possible(*measure, *value)) return std::nullopt;
    return value;
}

/// R(t) = R0 (1 + A t + B t^2 + C (t - 100) t^3), C for t < 0 only (IEC 60751:2008, clause 4.2).
std::optional<double> platinum_temperature(double resistance_ohm, double r0_ohm) {
    constexpr double a = 3.9083e-3, b = -5.775e-7, c = -4.183e-12;
    const double ratio = resistance_ohm / r0_ohm;
    // 18.52 ohm at -200 degC, 390.48 ohm at 850 degC for 100 ohm, rounded outwards.
    if (!(ratio > 0.185 && ratio < 3.9049)) return std::nullopt;
    double t = (-a + std::sqrt(a * a - 4 * b * (1 - ratio))) / (2 * b);
    // Below zero the parabola is off by 2.4 K at most: Newton doubles the digits each time.
    for (int step = 0; t < 0 && step < 6; ++step) {
        const double there = 1 + t * (a + t * (b + t * c * (t - 100)));
        const double slope = a + t * (2 * b + t * c * (4 * t - 300));
        t -= (there - ratio) / slope;
    }
    return t;
}

} // namespace axiscal
