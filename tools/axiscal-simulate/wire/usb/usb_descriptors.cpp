#include "wire/usb/usb_descriptors.hpp"

namespace axiscal::simulate {

namespace {

enum : std::uint8_t { type_device = 1, type_configuration = 2, type_string = 3 };
enum : std::uint8_t { index_maker = 1, index_name = 2, index_serial = 3 };

void append16(Bytes& bytes, std::uint16_t value) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

void append(Bytes& bytes, const UsbInterface& interface, std::uint8_t number) {
    const auto endpoints = static_cast<std::uint8_t>(interface.endpoints.size());
    const Bytes head{9,
                     4,
                     number,
                     interface.alternate,
                     endpoints,
                     interface.its_class,
                     interface.subclass,
                     interface.protocol,
                     0};
    bytes.insert(bytes.end(), head.begin(), head.end());
    bytes.insert(bytes.end(), interface.class_descriptors.begin(),
                 interface.class_descriptors.end());
    for (const UsbEndpoint& endpoint : interface.endpoints) {
        const Bytes own{7, 5, endpoint.address, static_cast<std::uint8_t>(endpoint.transfer)};
        bytes.insert(bytes.end(), own.begin(), own.end());
        append16(bytes, endpoint.largest_packet);
        bytes.push_back(endpoint.interval);
    }
}

UsbAnswer string_answer(const UsbDescriptors& device, std::uint8_t index) {
    constexpr std::uint8_t us_english_low = 9, us_english_high = 4;
    if (index == 0) return UsbAnswer::done({4, type_string, us_english_low, us_english_high});
    const std::string& text = index == index_maker  ? device.maker
                              : index == index_name ? device.name
                                                    : device.serial;
    if (index > index_serial || text.empty()) return UsbAnswer::stall();
    return UsbAnswer::done(string_descriptor(text));
}

std::uint8_t string_index(const std::string& text, std::uint8_t index) {
    return text.empty() ? std::uint8_t{0} : index;
}

} // namespace

Bytes device_descriptor(const UsbDescriptors& device) {
    Bytes bytes{18, type_device, 0, 2, device.its_class, device.subclass, device.protocol, 64};
    append16(bytes, device.vendor);
    append16(bytes, device.product);
    append16(bytes, device.release);
    bytes.push_back(string_index(device.maker, index_maker));
    bytes.push_back(string_index(device.name, index_name));
    bytes.push_back(string_index(device.serial, index_serial));
    bytes.push_back(1); // one configuration
    return bytes;
}

Bytes configuration_descriptor(const UsbDescriptors& device) {
    Bytes inside;
    std::uint8_t count = 0;
    for (const UsbInterface& interface : device.interfaces) {
        if (interface.alternate == 0) ++count;
        append(inside, interface, static_cast<std::uint8_t>(count - 1));
    }
    constexpr std::size_t head_size = 9;
    constexpr std::uint8_t bus_powered = 0x80, hundred_ma = 50;
    Bytes bytes{head_size, type_configuration};
    append16(bytes, static_cast<std::uint16_t>(head_size + inside.size()));
    const Bytes rest{count, 1, 0, bus_powered, hundred_ma};
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    bytes.insert(bytes.end(), inside.begin(), inside.end());
    return bytes;
}

Bytes string_descriptor(const std::string& ascii) {
    constexpr std::size_t longest = 126; // the length is one byte
    const std::string text = ascii.substr(0, longest);
    Bytes bytes{static_cast<std::uint8_t>(2 + 2 * text.size()), type_string};
    for (const char c : text)
        append16(bytes, static_cast<std::uint8_t>(c));
    return bytes;
}

std::optional<UsbAnswer> standard_answer(const UsbDescriptors& device, const UsbSetup& setup) {
    enum : std::uint8_t {
        get_status = 0,
        clear_feature = 1,
        set_feature = 3,
        get_descriptor = 6,
        set_configuration = 9,
        set_interface = 11
    };
    const bool standard = (setup.request_type & 0x60) == 0;
    if (!standard) return std::nullopt;
    if (setup.request_type == 0x80 && setup.request == get_descriptor) {
        const auto index = static_cast<std::uint8_t>(setup.value & 0xFF);
        switch (setup.value >> 8) {
        case type_device: return UsbAnswer::done(device_descriptor(device));
        case type_configuration: return UsbAnswer::done(configuration_descriptor(device));
        case type_string: return string_answer(device, index);
        default: return UsbAnswer::stall(); // no other speeds, no BOS
        }
    }
    switch (setup.request) {
    case get_status: return UsbAnswer::done({0, 0});
    case clear_feature:
    case set_feature:
    case set_configuration:
    case set_interface: return UsbAnswer::done();
    default: return std::nullopt; // descriptors of a class, asked of an interface
    }
}

} // namespace axiscal::simulate
