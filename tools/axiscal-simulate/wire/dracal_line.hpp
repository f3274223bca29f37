#pragma once
// Lines of a Dracal VCP stick: `*` and four hex digits of CRC-16/XMODEM close each line; the CRC
// covers everything before the `*`, the trailing comma too. Pure.

#include <cstdint>
#include <string>
#include <string_view>

namespace axiscal::simulate {

/// CRC-16/XMODEM: polynomial 0x1021, start 0, not reflected.
std::uint16_t crc16_xmodem(std::string_view bytes);
/// body + "*" + crc, without line end.
std::string dracal_closed(std::string_view body);

struct DracalStick {
    std::string product = "VCP-PTH450-CAL", serial = "E24638";
    int fraction_digits = 2;
    int poll_ms = 1000;
    /// A data line: pressure in whole Pa, temperature and humidity with fraction_digits.
    [[nodiscard]] std::string
    data_line(double pressure_Pa, double temperature_degC, double humidity_percent) const;
    [[nodiscard]] std::string info_line() const;
    /// Takes one command (INFO, POLL ms, FRAC digits); returns the answer, or a notice.
    std::string answer(std::string_view command);
};

} // namespace axiscal::simulate
