#include "wire/usb/temper_device.hpp"

#include <array>
#include <cmath>

namespace axiscal::simulate {
namespace {

// HID 1.11: usage page, usage, collection, fields.
constexpr std::array<std::uint8_t, 23> keyboard_reports{
    0x05, 0x01, 0x09, 0x06, 0xA1, 0x01, 0x05, 0x07, 0x19, 0x00, 0x29, 0x65,
    0x15, 0x00, 0x25, 0x65, 0x75, 0x08, 0x95, 0x08, 0x81, 0x00, 0xC0};
/// Vendor page; 8 bytes in, 8 bytes out, no numbers.
constexpr std::array<std::uint8_t, 25> vendor_reports{
    0x06, 0x00, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x09, 0x01, 0x15, 0x00, 0x26, 0xFF,
    0x00, 0x75, 0x08, 0x95, 0x08, 0x81, 0x02, 0x09, 0x01, 0x91, 0x02, 0xC0};

UsbInterface hid_interface(std::uint8_t protocol, std::size_t report_bytes, std::uint8_t endpoint) {
    UsbInterface interface;
    interface.its_class = 3;
    interface.subclass = protocol; // 1: boot interface, keyboard
    interface.protocol = protocol;
    interface.class_descriptors = {
        9, 0x21, 0x11, 0x01, 0, 1, 0x22, static_cast<std::uint8_t>(report_bytes), 0};
    interface.endpoints = {{endpoint, UsbTransfer::interrupt, 8, 10}};
    return interface;
}

template <std::size_t size> Bytes bytes_of(const std::array<std::uint8_t, size>& bytes) {
    return {bytes.begin(), bytes.end()};
}

void put(Bytes& report, std::size_t at, int value) {
    report[at] = static_cast<std::uint8_t>(value >> 8 & 0xFF);
    report[at + 1] = static_cast<std::uint8_t>(value & 0xFF);
}

constexpr int absent = 20000;

} // namespace

TemperDevice::TemperDevice(std::string firmware, std::function<TemperShown()> shown)
    : firmware_{std::move(firmware)}
    , shown_{std::move(shown)} {
    descriptors_.vendor = 0x413D;
    descriptors_.product = 0x2107; // no strings at all, as the real ones
    descriptors_.interfaces = {hid_interface(1, keyboard_reports.size(), 0x81),
                               hid_interface(0, vendor_reports.size(), 0x82)};
}

UsbAnswer TemperDevice::control(const UsbSetup& setup, std::span<const std::uint8_t> data) {
    if (setup.request_type == 0x81 && setup.request == 6 && setup.value >> 8 == 0x22)
        return UsbAnswer::done(setup.index == 0 ? bytes_of(keyboard_reports)
                                                : bytes_of(vendor_reports));
    if (setup.request_type != 0x21) return UsbAnswer::stall();
    if (setup.request == 0x09 && setup.value >> 8 == 2 && setup.index == 1) take_report(data);
    return UsbAnswer::done(); // SET_IDLE, SET_PROTOCOL, the keyboard's lamps
}

void TemperDevice::take_report(std::span<const std::uint8_t> report) {
    if (report.size() != 8 || report[0] != 0x01) return;
    if (report[1] == 0x86 && report[2] == 0xFF) tell_firmware();
    if (report[1] == 0x80 && report[2] == 0x33) tell_values();
}

void TemperDevice::tell_firmware() {
    std::string name = firmware_;
    name.resize(16, ' ');
    reports_.emplace_back(name.begin(), name.begin() + 8);
    reports_.emplace_back(name.begin() + 8, name.end());
}

void TemperDevice::tell_values() {
    const TemperShown shown = shown_();
    const bool old = firmware_.starts_with("TEMPerF");
    const double divisor = old ? 256 : 100;
    Bytes first{0x80, 0x40, 0, 0, 0, 0, 0, 0}, second{0x80, 0x01, 0, 0, 0, 0, 0, 0};
    put(first, 2, static_cast<int>(std::lround(shown.stick_degC * divisor)));
    const bool humid = firmware_.starts_with("TEMPerX");
    put(first, 4, humid ? static_cast<int>(std::lround(shown.humidity_percent * divisor)) : absent);
    put(second, 2,
        shown.probe_connected ? static_cast<int>(std::lround(shown.probe_degC * divisor)) : absent);
    put(second, 4, absent);
    reports_.push_back(std::move(first));
    if (!old) reports_.push_back(std::move(second));
}

UsbAnswer TemperDevice::in(std::uint8_t endpoint, std::size_t) {
    if (endpoint != 2 || reports_.empty()) return UsbAnswer::hold();
    Bytes report = std::move(reports_.front());
    reports_.pop_front();
    return UsbAnswer::done(std::move(report));
}

} // namespace axiscal::simulate
