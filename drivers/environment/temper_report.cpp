#include "drivers/environment/temper_report.hpp"

#include "drivers/framing/byte_order.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

namespace axiscal {
namespace {

/// [families] by what a firmware's name begins with.
constexpr std::array families{
    TemperFamily{"TEMPerF1.2", 256, 2},
    TemperFamily{"TEMPerF1.4", 256, 2},
    TemperFamily{"TEMPer1F1.", 256, 2},
    TemperFamily{"TEMPer2_M12_V1.3", 256, 2, 4},
    TemperFamily{"TEMPerGold_V3.1", 100, 2},
    TemperFamily{"TEMPerGold_V3.3", 100, 2},
    TemperFamily{"TEMPerGold_V3.4", 100, 2},
    TemperFamily{"TEMPerGold_V3.5", 100, 2},
    TemperFamily{"TEMPerX_V3.1", 100, 2, 10, 4, 12},
    TemperFamily{"TEMPerX_V3.3", 100, 2, 10, 4, 12},
    TemperFamily{"TEMPer2_V3.7", 100, 2, 10},
    TemperFamily{"TEMPer2_V3.9", 100, 2, 10},
    TemperFamily{"TEMPer2_V4.1", 100, 2, 10},
    TemperFamily{"TEMPerHUM_V3.9", 100, 2, 10, 4},
    TemperFamily{"TEMPer1F_V3.9", 100, -1, 2}, // the probe stands where others have the stick
    TemperFamily{"TEMPer1F_V4.1", 100, -1, 2},
    TemperFamily{"TEMPer1F_H1V1.5F", 0, 2, -1, 4},
};

constexpr std::uint32_t sensor_absent = 0x4E20;

bool printable(std::byte byte) {
    const int letter = std::to_integer<int>(byte);
    return letter >= 0x20 && letter < 0x7F;
}

std::optional<std::uint32_t> word_at(std::span<const std::byte> reply, int offset) {
    if (offset < 0 || static_cast<std::size_t>(offset) + 2 > reply.size()) return std::nullopt;
    const std::uint32_t word = big16(reply, static_cast<std::size_t>(offset));
    if (word == sensor_absent) return std::nullopt;
    return word;
}

std::optional<double> within(double value, double low, double high) {
    if (!(value >= low && value <= high)) return std::nullopt;
    return value;
}

/// The sensors' own range; an SHT20's raw counts have two bits of status below [families].
std::optional<double>
temperature(std::span<const std::byte> reply, int offset, const TemperFamily& family) {
    const auto word = word_at(reply, offset);
    if (!word) return std::nullopt;
    const double value = family.divisor > 0 ? signed16(*word) / family.divisor
                                            : -46.85 + 175.72 * (*word << 2) / 65'536;
    return within(value, -55, 125);
}

std::optional<double>
humidity(std::span<const std::byte> reply, int offset, const TemperFamily& family) {
    const auto word = word_at(reply, offset);
    if (!word) return std::nullopt;
    const double value =
        family.divisor > 0 ? signed16(*word) / family.divisor : -6 + 125.0 * (*word << 4) / 65'536;
    return within(value, 0, 100);
}

constexpr std::size_t report_length = 8;

/// Which report of its answer this is; empty for a head that no value has, as of text.
std::optional<std::size_t> place_of(std::span<const std::byte> report, bool sends_two) {
    if (byte_at(report, 0) != 0x80) return std::nullopt;
    if (!sends_two) return 0;
    switch (byte_at(report, 1)) {
    case 0x40:
    case 0x80: return 0; // of the stick
    case 0x01: return 1; // of the probe
    default: return std::nullopt;
    }
}

/// The reports by their heads; one that did not come says that its sensors are absent.
struct Ordered {
    std::array<std::byte, 2 * report_length> bytes{};
    int bad_reports = 0;
};

Ordered in_order(std::span<const std::byte> reply, bool sends_two) {
    Ordered out;
    for (std::size_t at = 0; at < out.bytes.size(); at += 2) {
        out.bytes[at] = static_cast<std::byte>(sensor_absent >> 8U);
        out.bytes[at + 1] = static_cast<std::byte>(sensor_absent & 0xFFU);
    }
    std::array<bool, 2> came{};
    for (; reply.size() >= report_length; reply = reply.subspan(report_length)) {
        const auto report = reply.first(report_length);
        const auto place = place_of(report, sends_two);
        if (!place || came[*place]) {
            ++out.bad_reports;
            continue;
        }
        came[*place] = true;
        std::ranges::copy(report,
                          out.bytes.begin() + static_cast<std::ptrdiff_t>(*place * report_length));
    }
    return out;
}

} // namespace

std::string temper_firmware(std::span<const std::byte> reply) {
    std::string name;
    for (const std::byte byte : reply) {
        if (!printable(byte)) break;
        name += static_cast<char>(byte);
    }
    name.erase(std::find_if(name.rbegin(), name.rend(), [](char c) { return c != ' '; }).base(),
               name.end());
    return name;
}

Result<TemperFamily> temper_family(std::string_view firmware) {
    const auto found = std::ranges::find_if(families, [&](const TemperFamily& family) {
        return firmware.starts_with(family.firmware);
    });
    if (found != families.end()) return *found;
    std::string hex;
    for (const char letter : firmware) {
        char digits[4];
        std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned char>(letter));
        hex += digits;
    }
    return fail(Fault::unknown_instrument, "a TEMPer whose firmware \"" + std::string{firmware} +
                                               "\" (" + hex +
                                               ") is not known here: its values would be guessed");
}

TemperReading decode_temper_reading(std::span<const std::byte> reply, const TemperFamily& family) {
    const bool sends_two = std::max(family.probe_temperature, family.probe_humidity) >=
                           static_cast<int>(report_length);
    const Ordered ordered = in_order(reply, sends_two);
    const std::span<const std::byte> bytes{ordered.bytes};
    return {temperature(bytes, family.stick_temperature, family),
            temperature(bytes, family.probe_temperature, family),
            humidity(bytes, family.stick_humidity, family),
            humidity(bytes, family.probe_humidity, family), ordered.bad_reports};
}

} // namespace axiscal
