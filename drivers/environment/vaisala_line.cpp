#include "drivers/environment/vaisala_line.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace axiscal {
namespace {

struct UnitRow {
    std::string_view unit;
    double scale, offset; ///< stored = sent * scale + offset
};
constexpr std::array pressure_units{UnitRow{"hPa", 100, 0}, UnitRow{"mbar", 100, 0},
                                    UnitRow{"kPa", 1000, 0}, UnitRow{"Pa", 1, 0}};
constexpr std::array temperature_units{UnitRow{"'C", 1, 0}, UnitRow{"'F", 5.0 / 9, -160.0 / 9}};
constexpr std::array humidity_units{UnitRow{"%RH", 1, 0}};

struct Range {
    double lowest, highest;
};

std::string_view without_blanks(std::string_view text) {
    const auto begin = text.find_first_not_of(' ');
    return begin == std::string_view::npos ? std::string_view{} : text.substr(begin);
}

/// The word up to the next blank; `text` goes on behind it.
std::string_view next_word(std::string_view& text) {
    text = without_blanks(text);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    return word;
}

template <class Units>
std::optional<double>
field(std::string_view text, std::string_view label, const Units& units, Range possible) {
    const auto place = text.find(label);
    if (place == std::string_view::npos) return std::nullopt;
    text.remove_prefix(place + label.size());
    const std::string_view number = next_word(text), unit = next_word(text);
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    const bool whole = error == std::errc{} && end == number.data() + number.size();
    if (!whole || !std::isfinite(value)) return std::nullopt; // "****" of a faulty sensor
    for (const UnitRow& row : units) {
        if (row.unit != unit) continue;
        const double stored = value * row.scale + row.offset;
        const bool in_range = stored >= possible.lowest && stored <= possible.highest;
        return in_range ? std::optional{stored} : std::nullopt;
    }
    return std::nullopt;
}

unsigned checksum_of(std::string_view body, VaisalaChecksum kind) {
    unsigned sum = 0;
    for (const char letter : body) {
        const unsigned byte = static_cast<unsigned char>(letter);
        sum = kind == VaisalaChecksum::csx ? sum ^ byte : (sum + byte) & 0xFFFFu;
    }
    return sum;
}

} // namespace

Result<std::string_view> verify_vaisala_line(std::string_view line, VaisalaChecksum kind) {
    if (kind == VaisalaChecksum::none) return line;
    const std::size_t digits = kind == VaisalaChecksum::csx ? 2 : 4;
    if (line.size() <= digits) return fail(Fault::bad_frame, "a line too short for a checksum");
    const std::string_view body = line.substr(0, line.size() - digits);
    unsigned stated = 0;
    const char* const begin = line.data() + body.size();
    const auto [end, error] = std::from_chars(begin, begin + digits, stated, 16);
    if (error != std::errc{} || end != begin + digits)
        return fail(Fault::bad_frame, "a line that does not end with a checksum");
    if (checksum_of(body, kind) != stated) return fail(Fault::checksum, "a damaged line");
    return body;
}

Result<VaisalaReading> parse_vaisala_line(std::string_view verified) {
    if (!verified.starts_with("P=")) return fail(Fault::bad_frame, "no reading of a Vaisala");
    VaisalaReading reading;
    reading.pressure_Pa = field(verified, "P=", pressure_units, {30e3, 120e3});
    reading.temperature_degC = field(verified, " T=", temperature_units, {-60, 150});
    reading.humidity_percent = field(verified, " RH=", humidity_units, {0, 100});
    return reading;
}

} // namespace axiscal
