#include "wire/dracal_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace axiscal::simulate {
namespace {

/// 0 where no number stands.
int number_at(const std::string& text, std::size_t begin) {
    int number = 0;
    std::from_chars(text.data() + begin, text.data() + text.size(), number);
    return number;
}

} // namespace

std::uint16_t crc16_xmodem(std::string_view bytes) {
    unsigned crc = 0;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ 0x1021U : crc << 1;
        crc &= 0xFFFFU;
    }
    return static_cast<std::uint16_t>(crc);
}

std::string dracal_closed(std::string_view body) {
    char crc[8];
    std::snprintf(crc, sizeof crc, "*%04x", crc16_xmodem(body));
    return std::string{body} + crc;
}

std::string
DracalStick::data_line(double pressure_Pa, double temperature_degC, double humidity_percent) const {
    char values[96];
    std::snprintf(values, sizeof values, "%.0f,Pa,%.*f,C,%.*f,%%,", pressure_Pa, fraction_digits,
                  temperature_degC, fraction_digits, humidity_percent);
    return dracal_closed("D," + product + "," + serial + ",," + values);
}

std::string DracalStick::info_line() const {
    return dracal_closed("I,Product ID,Serial Number,Message,MS5611 Pressure,Pa,"
                         "SHT31 Temperature,C,SHT31 Relative Humidity,%,");
}

std::string DracalStick::answer(std::string_view command) {
    const std::string head = "I," + product + "," + serial + ",";
    const std::string text{command};
    if (text == "INFO") return info_line();
    if (text.starts_with("POLL ")) {
        poll_ms = std::clamp(number_at(text, 5), 0, 60000);
        return dracal_closed(head + "Poll interval set to " + std::to_string(poll_ms) + " ms,");
    }
    if (text.starts_with("FRAC ")) {
        fraction_digits = std::clamp(number_at(text, 5), 0, 6);
        return dracal_closed(head + "Fractional digits set to " + std::to_string(fraction_digits) +
                             ",");
    }
    return dracal_closed(head + "Unknown command,");
}

} // namespace axiscal::simulate
