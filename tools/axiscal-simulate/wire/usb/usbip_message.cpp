#include "wire/usb/usbip_message.hpp"

namespace axiscal::simulate {

namespace {

enum : std::uint32_t { cmd_submit = 1, cmd_unlink = 2, ret_submit = 3, ret_unlink = 4 };

std::uint32_t word(const UsbipHeader& header, std::size_t index) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | header[4 * index + i];
    return value;
}

void put_word(Bytes& bytes, std::size_t index, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i)
        bytes[4 * index + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

std::uint16_t little16(const UsbipHeader& header, std::size_t at) {
    return static_cast<std::uint16_t>(header[at] | header[at + 1] << 8);
}

Bytes reply(std::uint32_t command, std::uint32_t sequence, std::int32_t status) {
    Bytes bytes(usbip_header_size, 0);
    put_word(bytes, 0, command);
    put_word(bytes, 1, sequence);
    put_word(bytes, 5, static_cast<std::uint32_t>(status));
    return bytes;
}

} // namespace

UrbRequest decode_urb(const UsbipHeader& header) {
    const std::uint32_t command = word(header, 0), sequence = word(header, 1);
    if (command == cmd_unlink) return UrbUnlink{sequence, word(header, 5)};
    if (command != cmd_submit) return {};
    constexpr std::size_t setup = 40; // little-endian, as on the USB wire
    UrbSubmit submit;
    submit.sequence = sequence;
    submit.in = word(header, 3) == 1;
    submit.endpoint = static_cast<std::uint8_t>(word(header, 4));
    submit.length = word(header, 6);
    submit.setup = {header[setup], header[setup + 1], little16(header, setup + 2),
                    little16(header, setup + 4), little16(header, setup + 6)};
    return submit;
}

Bytes encode_return(std::uint32_t sequence,
                    std::int32_t status,
                    std::uint32_t actual,
                    std::span<const std::uint8_t> in_bytes) {
    Bytes bytes = reply(ret_submit, sequence, status);
    put_word(bytes, 6, actual);
    bytes.insert(bytes.end(), in_bytes.begin(), in_bytes.end());
    return bytes;
}

Bytes encode_unlinked(std::uint32_t sequence, std::int32_t status) {
    return reply(ret_unlink, sequence, status);
}

} // namespace axiscal::simulate
