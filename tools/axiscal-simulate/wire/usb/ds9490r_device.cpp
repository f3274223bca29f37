// Source: Dallas DS2490 data sheet, revision 120401 (vendor requests, communication commands, state
// registers), its application note 117 (descriptors), DS9490R data sheet (the adapter's own chip,
// family 81), and the requests that drivers/w1/masters/ds2490.c of Linux 6.1 makes.
#include "wire/usb/ds9490r_device.hpp"

#include <algorithm>

namespace axiscal::simulate {

namespace {

enum ChipRequest : std::uint8_t {
    control_command = 0,
    communication_command = 1,
    mode_command = 2
};
enum ControlCommand : std::uint16_t {
    reset_device = 0,
    flush_communication = 7,
    flush_to_host = 8,
    flush_from_host = 9
};
/// Communication commands by their bits 1, 2, 4 to 7; the others are options.
enum Communication : std::uint16_t {
    set_duration = 0x12,
    bit_io = 0x20,
    pulse = 0x30,
    one_wire_reset = 0x42,
    byte_io = 0x52,
    block_io = 0x74,
    search_access = 0xF4
};
constexpr std::uint16_t command_bits = 0x00F6, with_reset = 0x0100, data_bit = 0x0008;
constexpr std::uint8_t search_rom = 0xF0;
constexpr std::uint8_t own_family = 0x81;
constexpr std::uint64_t own_serial = 0x344670;
constexpr std::size_t fifo_size = 128;
enum Endpoint : std::uint8_t { state_registers = 1, data_to_cable = 2, data_from_cable = 3 };

/// Four settings: interrupt polled each 10 or 1 ms, bulk packets of 16 or 64 bytes.
std::vector<UsbInterface> interfaces() {
    constexpr std::uint8_t settings = 4;
    std::vector<UsbInterface> all;
    all.reserve(settings);
    for (std::uint8_t alternate = 0; alternate < settings; ++alternate) {
        const std::uint16_t packet = alternate % 2 == 0 ? 16 : 64;
        const std::uint8_t polled_ms = alternate < 2 ? 10 : 1;
        UsbInterface one;
        one.alternate = alternate;
        one.endpoints = {{0x80 | state_registers, UsbTransfer::interrupt, 32, polled_ms},
                         {data_to_cable, UsbTransfer::bulk, packet, 0},
                         {0x80 | data_from_cable, UsbTransfer::bulk, packet, 0}};
        all.push_back(std::move(one));
    }
    return all;
}

} // namespace

Ds9490rDevice::Ds9490rDevice(std::unique_ptr<OneWireBus> bus)
    : bus_{std::move(bus)}
    , own_rom_{one_wire_rom(own_family, own_serial)} {
    descriptors_.vendor = 0x04FA;
    descriptors_.product = 0x2490;
    descriptors_.release = 0x0002;
    descriptors_.its_class = 0xFF; // and no strings
    descriptors_.interfaces = interfaces();
}

void Ds9490rDevice::restart() {
    from_host_.clear();
    to_host_.clear();
}

bool Ds9490rDevice::command(std::uint16_t value, std::uint16_t) {
    if (value == reset_device) restart();
    if (value == flush_to_host) to_host_.clear();
    if (value == flush_from_host) from_host_.clear();
    return value <= 0x000A;
}

/// Bytes from the host go out, what the cable shows meanwhile comes back.
/// @return false when the host sent fewer than it announced: the chip would wait for the rest.
bool Ds9490rDevice::touch_block(std::size_t length) {
    if (from_host_.size() < length || to_host_.size() + length > fifo_size) return false;
    for (std::size_t i = 0; i < length; ++i) {
        to_host_.push_back(bus_->byte(from_host_.front()));
        from_host_.pop_front();
    }
    return true;
}

/// All ROM codes from the beginning on, the adapter's own last (its lowest bit is 1); where to
/// begin are eight bytes of the host.
void Ds9490rDevice::search(std::uint8_t rom_command) {
    from_host_.clear();
    if (rom_command != search_rom) return; // nobody is alarmed
    auto found = bus_->search();
    if (!bus_->shorted()) found.push_back(own_rom_);
    for (const OneWireRom& rom : found)
        if (to_host_.size() + rom.size() <= fifo_size)
            to_host_.insert(to_host_.end(), rom.begin(), rom.end());
}

bool Ds9490rDevice::communicate(std::uint16_t value, std::uint16_t index) {
    if ((value & with_reset) != 0) bus_->reset();
    switch (value & command_bits) {
    case set_duration:
    case pulse: return true;
    case one_wire_reset: bus_->reset(); return true;
    case bit_io: to_host_.push_back(bus_->bit((value & data_bit) != 0) ? 1 : 0); return true;
    case byte_io:
        to_host_.push_back(bus_->byte(static_cast<std::uint8_t>(index & 0xFF)));
        return true;
    case block_io: return touch_block(index);
    case search_access: search(static_cast<std::uint8_t>(index & 0xFF)); return true;
    default: return false;
    }
}

UsbAnswer Ds9490rDevice::control(const UsbSetup& setup, std::span<const std::uint8_t>) {
    constexpr std::uint8_t vendor_to_device = 0x40;
    if (setup.request_type != vendor_to_device) return UsbAnswer::stall();
    bool done = setup.request == mode_command; // pull-up, slew rate, speed: any will do
    if (setup.request == control_command) done = command(setup.value, setup.index);
    if (setup.request == communication_command) done = communicate(setup.value, setup.index);
    return done ? UsbAnswer::done() : UsbAnswer::stall();
}

UsbAnswer Ds9490rDevice::out(std::uint8_t endpoint, std::span<const std::uint8_t> data) {
    if (endpoint != data_to_cable || from_host_.size() + data.size() > fifo_size)
        return UsbAnswer::stall();
    from_host_.insert(from_host_.end(), data.begin(), data.end());
    return UsbAnswer::done();
}

/// Pull-up allowed, regular speed, durations and slew rate as after power-on; idle, for each
/// command is done when its request is answered; the last command, what waits in the buffers.
Bytes Ds9490rDevice::state_packet() const {
    constexpr std::uint8_t idle = 0x20;
    Bytes state{0x01, 0x00, 0x20, 0x40, 0x05, 0x04, 0x04, 0x00, idle, 0x00, 0x00, 0x00};
    state.push_back(static_cast<std::uint8_t>(from_host_.size()));
    state.push_back(static_cast<std::uint8_t>(to_host_.size()));
    state.resize(16);
    return state;
}

UsbAnswer Ds9490rDevice::in(std::uint8_t endpoint, std::size_t most) {
    if (endpoint == state_registers) return UsbAnswer::done(state_packet());
    if (endpoint != data_from_cable || to_host_.empty()) return UsbAnswer::hold();
    // Whoever reads less than there is loses it all.
    if (most < to_host_.size()) return to_host_.clear(), UsbAnswer::stall();
    Bytes bytes{to_host_.begin(), to_host_.end()};
    to_host_.clear();
    return UsbAnswer::done(std::move(bytes));
}

} // namespace axiscal::simulate
