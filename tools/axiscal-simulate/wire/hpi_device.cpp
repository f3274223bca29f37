#include "wire/hpi_device.hpp"

#include <array>
#include <cmath>

namespace axiscal::simulate {

namespace {

constexpr std::size_t hpi_command_bytes = 8, hpi_answer_data = 12;
constexpr double hpi_steps_per_mm = 1e7; // 100 pm
constexpr int hpi_distance = 0xB015, hpi_meteo = 0xB00A;

/// What a byte that is shifted through the division by x^8 + x^5 + x^4 + 1 leaves.
std::array<unsigned, 256> hpi_remainders() {
    std::array<unsigned, 256> table{};
    for (unsigned byte = 0; byte < table.size(); ++byte) {
        unsigned dividend = byte << 8;
        for (unsigned bit = 15; bit >= 8; --bit)
            if ((dividend >> bit & 1U) != 0) dividend ^= 0b1'0011'0001U << (bit - 8);
        table[byte] = dividend;
    }
    return table;
}

char hpi_checksum(const std::string& bytes) {
    static const std::array<unsigned, 256> table = hpi_remainders();
    unsigned rest = 0xFF;
    for (const char byte : bytes)
        rest = table[rest ^ static_cast<unsigned char>(byte)];
    return static_cast<char>(rest);
}

/// Two's complement, the high byte first.
std::string hpi_big_endian(long long number, int bytes) {
    std::string text;
    for (int nth = bytes - 1; nth >= 0; --nth)
        text += static_cast<char>(number >> 8 * nth & 0xFF);
    return text;
}

std::string
meteo_frame_of(int sensor, double temperature_degC, double humidity, double pressure_Pa) {
    constexpr int battery = 90, radio_link = 70; // of units that nobody tells
    return hpi_frame(hpi_meteo, hpi_big_endian(sensor, 1) +
                                    hpi_big_endian(std::llround(temperature_degC * 100), 2) +
                                    hpi_big_endian(std::llround(humidity), 1) +
                                    hpi_big_endian(battery, 1) + hpi_big_endian(radio_link, 1) +
                                    hpi_big_endian(std::llround(pressure_Pa / 10), 2) +
                                    std::string(4, '\0'));
}

} // namespace

std::string hpi_frame(int command, const std::string& data) {
    const std::string frame = '\xAA' + hpi_big_endian(command, 2) + data;
    return frame + hpi_checksum(frame);
}

/// False: a command that this one does not know.
bool HpiDevice::obey(int command) {
    switch (command) {
    case 0xB032: return distance_on_ = true;
    case 0xB033: return distance_on_ = false, true;
    case 0xB035: return true; // velocity, which it never sends
    case 0xB03C: return distance_on_ = meteo_on_ = false, true;
    case 0xB03D: return weak_ = !beam_, true;
    case 0xB03F: return true; // it counts whatever speed
    case 0xB048: return zeroed_ = false, true;
    case 0xB079: return meteo_on_ = true;
    case 0xB07A: return meteo_on_ = false, true;
    default: return false;
    }
}

std::string HpiDevice::answer(std::string& typed) {
    std::string answers;
    while (typed.size() >= hpi_command_bytes) {
        const std::string body = typed.substr(0, hpi_command_bytes - 1);
        if (body[0] != '\xAA' || hpi_checksum(body) != typed[hpi_command_bytes - 1]) {
            typed.erase(0, 1);
            continue;
        }
        typed.erase(0, hpi_command_bytes);
        const int command =
            static_cast<unsigned char>(body[1]) << 8 | static_cast<unsigned char>(body[2]);
        if (obey(command)) answers += hpi_frame(command, std::string(hpi_answer_data, '\0'));
    }
    return answers;
}

std::string HpiDevice::distance(double position_mm, double level_percent) {
    if (!zeroed_) offset_mm_ = -position_mm;
    zeroed_ = true;
    weak_ = weak_ || !beam_;
    if (beam_) shown_mm_ = position_mm + offset_mm_;
    offset_mm_ = shown_mm_ - position_mm; // counts that a lost beam cost are gone
    if (!distance_on_) return {};
    const int state = 1 | (weak_ ? 0 : 1 << 3); // the laser is ready
    const double level = beam_ ? level_percent : 2;
    return hpi_frame(hpi_distance, hpi_big_endian(std::llround(shown_mm_ * hpi_steps_per_mm), 7) +
                                       std::string(3, '\0') + hpi_big_endian(state, 1) +
                                       hpi_big_endian(std::llround(level), 1));
}

std::string HpiDevice::air(const HpiAir& air) const {
    if (!meteo_on_) return {};
    return meteo_frame_of(0, air.temperature_degC, air.humidity_percent, air.pressure_Pa);
}

std::string HpiDevice::material(int number, double temperature_degC) const {
    return meteo_on_ ? meteo_frame_of(number, temperature_degC, 0, 0) : std::string{};
}

void HpiDevice::restart() {
    distance_on_ = meteo_on_ = weak_ = zeroed_ = false;
}

} // namespace axiscal::simulate
