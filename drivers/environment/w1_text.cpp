#include "drivers/environment/w1_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace axiscal {
namespace {

constexpr long power_on_milli_degC = 85000, failed_milli_degC = 127937;
constexpr long lowest_milli_degC = -55000, highest_milli_degC = 125000;

using Scratchpad = std::array<std::uint8_t, 9>;

/// Maxim application note 27: polynomial x^8 + x^5 + x^4 + 1, reflected, initial value 0.
std::uint8_t crc8_maxim(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1u) != 0 ? (crc >> 1) ^ 0x8Cu : crc >> 1;
    }
    return static_cast<std::uint8_t>(crc);
}

std::optional<Scratchpad> scratchpad_of(std::string_view line) {
    Scratchpad bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (line.size() < 3 * i + 3 || line[3 * i + 2] != ' ') return std::nullopt;
        const char* const begin = line.data() + 3 * i;
        const auto [end, error] = std::from_chars(begin, begin + 2, bytes[i], 16);
        if (error != std::errc{} || end != begin + 2) return std::nullopt;
    }
    return bytes;
}

std::optional<long> whole_number(std::string_view text) {
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    return whole ? std::optional{value} : std::nullopt;
}

Result<double> judged(long milli_degC) {
    if (milli_degC == power_on_milli_degC)
        return fail(Fault::signal_error, "85 degC is what the sensor shows after power-on: its "
                                         "supply broke, or no conversion took place");
    if (milli_degC == failed_milli_degC)
        return fail(Fault::signal_error, "the sensor reports that its conversion failed");
    if (milli_degC < lowest_milli_degC || milli_degC > highest_milli_degC)
        return fail(Fault::signal_error, "a temperature that the sensor cannot have");
    return static_cast<double>(milli_degC) / 1000;
}

/// Two bytes, low first, in sixteenths of a degree; the kernel drops what is below a millidegree.
bool agree(const Scratchpad& bytes, long milli_degC) {
    const auto raw =
        static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8));
    return std::abs(raw * 62.5 - static_cast<double>(milli_degC)) < 1;
}

} // namespace

Result<double> parse_w1_slave(std::string_view text) {
    const auto end = text.find('\n');
    const std::string_view first = text.substr(0, end);
    const std::string_view second = end == std::string_view::npos
                                        ? ""
                                        : text.substr(end + 1, text.find('\n', end + 1) - end - 1);
    const auto bytes = scratchpad_of(first), again = scratchpad_of(second);
    const bool yes = first.ends_with(" YES"), no = first.ends_with(" NO");
    if (!bytes || !again || yes == no || first.find(": crc=") == std::string_view::npos)
        return fail(Fault::bad_frame, "no text of w1_slave");
    if (no || crc8_maxim(std::span{*bytes}.first(8)) != bytes->back())
        return fail(Fault::checksum, "the scratchpad was read wrongly");
    if (std::ranges::all_of(*bytes, [](std::uint8_t byte) { return byte == 0; }))
        return fail(Fault::signal_error, "all bytes are zero: the wire is shorted");
    const auto place = second.find("t=");
    const auto milli_degC =
        place == std::string_view::npos ? std::nullopt : whole_number(second.substr(place + 2));
    if (!milli_degC) return fail(Fault::bad_frame, "no temperature in w1_slave");
    return judged(*milli_degC).and_then([&](double value) -> Result<double> {
        if (agree(*bytes, *milli_degC)) return value;
        return fail(Fault::bad_frame, "t= is not what the scratchpad holds: another family?");
    });
}

Result<double> parse_w1_temperature(std::string_view text) {
    if (text.ends_with('\n')) text.remove_suffix(1);
    const auto milli_degC = whole_number(text);
    if (!milli_degC) return fail(Fault::bad_frame, "no temperature yet");
    return judged(*milli_degC);
}

} // namespace axiscal
