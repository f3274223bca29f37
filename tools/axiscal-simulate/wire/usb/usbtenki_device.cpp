#include "wire/usb/usbtenki_device.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal::simulate {
namespace {

constexpr std::array<std::uint8_t, 4> chips{0x15, 0x16, 0x20, 0x19}; // P, its T, SHT31 T, SHT31 RH
constexpr double two_to_21 = 2097152, two_to_23 = 8388608, two_to_31 = 2147483648;

std::uint32_t rounded_count(double value, double highest) {
    return static_cast<std::uint32_t>(std::clamp(std::round(value), 0.0, highest));
}

/// Hundredths of a degree from D2 - C5 2^8, by the data sheet, second order below 20 degC.
double hundredths(double dt, const Ms5611Words& c) {
    const double first = 2000 + dt * c[5] / two_to_23;
    return first < 2000 ? first - dt * dt / two_to_31 : first;
}

Bytes big_word(std::uint32_t word) {
    return {static_cast<std::uint8_t>(word >> 8), static_cast<std::uint8_t>(word & 0xFF)};
}

void append_little24(Bytes& bytes, std::uint32_t number) {
    for (int shift = 0; shift < 24; shift += 8)
        bytes.push_back(static_cast<std::uint8_t>(number >> shift & 0xFF));
}

/// Echo of the command, content, XOR of all before.
UsbAnswer reply(std::uint8_t command, const Bytes& content) {
    Bytes bytes{command};
    bytes.insert(bytes.end(), content.begin(), content.end());
    std::uint8_t sum = 0;
    for (const std::uint8_t byte : bytes)
        sum = static_cast<std::uint8_t>(sum ^ byte);
    bytes.push_back(sum);
    return UsbAnswer::done(std::move(bytes));
}

} // namespace

Ms5611Counts ms5611_counts(double pressure_Pa, double temperature_degC, const Ms5611Words& c) {
    // Rises steadily from -40 to 85 degC: halving finds it.
    double low = -2e6, high = 3e6;
    for (int step = 0; step < 80; ++step) {
        const double middle = 0.5 * (low + high);
        (hundredths(middle, c) < 100 * temperature_degC ? low : high) = middle;
    }
    const double dt = std::round(0.5 * (low + high));
    const double first = 2000 + dt * c[5] / two_to_23;
    double offset = c[1] * 65536.0 + c[3] * dt / 128,
           sensitivity = c[0] * 32768.0 + c[2] * dt / 256;
    if (first < 2000) {
        const double cold = first < -1500 ? first + 1500 : 0;
        offset -= 2.5 * (first - 2000) * (first - 2000) + 7 * cold * cold;
        sensitivity -= 1.25 * (first - 2000) * (first - 2000) + 5.5 * cold * cold;
    }
    const double d1 = (pressure_Pa * 32768 + offset) * two_to_21 / sensitivity;
    return {rounded_count(d1, 0xFFFFFF), rounded_count(dt + c[4] * 256.0, 0xFFFFFF)};
}

UsbTenkiDevice::UsbTenkiDevice(std::string serial, std::function<TrueAir()> air)
    : air_{std::move(air)} {
    descriptors_.vendor = 0x1781;
    descriptors_.product = 0x0A98;
    descriptors_.its_class = 0xFF;
    descriptors_.maker = "raphnet.net";
    descriptors_.name = "USBTenki";
    descriptors_.serial = std::move(serial);
    descriptors_.interfaces.emplace_back();
}

Bytes UsbTenkiDevice::raw(int channel) const {
    const TrueAir air = air_();
    const double temperature_degC = air.temperature.in_celsius();
    const auto counts = ms5611_counts(air.pressure.in(pascal), temperature_degC, ms5611_example);
    Bytes bytes;
    switch (channel) {
    case 0: append_little24(bytes, counts.d1); [[fallthrough]];
    case 1: append_little24(bytes, counts.d2); return bytes;
    case 2: return big_word(rounded_count((temperature_degC + 45) / 175 * 65535, 65535));
    default: return big_word(rounded_count(air.humidity.si() * 65535, 65535));
    }
}

Bytes UsbTenkiDevice::calibration(int index) const {
    Bytes bytes;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint16_t word = ms5611_example[3 * static_cast<std::size_t>(index) + i];
        bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
        bytes.push_back(static_cast<std::uint8_t>(word >> 8));
    }
    return bytes;
}

UsbAnswer UsbTenkiDevice::control(const UsbSetup& setup, std::span<const std::uint8_t>) {
    if (setup.request_type != 0xC0) return UsbAnswer::stall();
    const int argument = setup.value;
    const bool channel = argument < static_cast<int>(chips.size());
    switch (setup.request) {
    case 0x02: return reply(0x02, {static_cast<std::uint8_t>(chips.size())});
    case 0x01:
        if (!channel) return UsbAnswer::done();
        return reply(0x01, {chips[static_cast<std::size_t>(argument)]});
    case 0x10: return channel ? reply(0x10, raw(argument)) : UsbAnswer::done();
    case 0x11: return argument < 2 ? reply(0x11, calibration(argument)) : UsbAnswer::done();
    default: return UsbAnswer::done({0x00});
    }
}

} // namespace axiscal::simulate
