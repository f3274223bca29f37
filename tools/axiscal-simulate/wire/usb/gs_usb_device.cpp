#include "wire/usb/gs_usb_device.hpp"

#include <algorithm>
#include <utility>

namespace axiscal::simulate {
namespace {

enum AdapterRequest : std::uint8_t {
    host_format = 0,
    bit_timing,
    mode,
    berr,
    limits,
    configuration
};
constexpr std::uint32_t from_bus = 0xFFFFFFFF; ///< echo id of a frame that the host did not send
constexpr std::uint32_t error_flag = 0x20000000, bus_off_class = 0x40, long_id_flag = 0x80000000,
                        remote_flag = 0x40000000;
constexpr std::size_t frame_size = 20, most_waiting = 4096;

void put_little(Bytes& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::uint32_t little(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

Bytes words(std::initializer_list<std::uint32_t> values) {
    Bytes bytes;
    for (const std::uint32_t value : values)
        put_little(bytes, value);
    return bytes;
}

} // namespace

GsUsbDevice::GsUsbDevice(std::string serial,
                         std::function<double()> now_s,
                         std::vector<std::unique_ptr<CanNode>> nodes)
    : now_s_{std::move(now_s)}
    , nodes_{std::move(nodes)} {
    descriptors_.vendor = 0x1D50;
    descriptors_.product = 0x606F;
    descriptors_.maker = "bytewerk";
    descriptors_.name = "candleLight USB to CAN adapter";
    descriptors_.serial = std::move(serial);
    UsbInterface interface;
    interface.endpoints = {{0x81, UsbTransfer::bulk, 64, 0}, {0x02, UsbTransfer::bulk, 64, 0}};
    descriptors_.interfaces = {interface};
}

/// The bus has its own supply: its nodes go on when the adapter is plugged in or out.
void GsUsbDevice::plugged() {
    frames_.clear();
    started_ = off_ = false;
}

UsbAnswer GsUsbDevice::control(const UsbSetup& setup, std::span<const std::uint8_t> data) {
    if (setup.to_host()) {
        // One channel (counted from 0), software 2, hardware 1.
        if (setup.request == configuration) return UsbAnswer::done(words({0, 2, 1}));
        // Listen-only and loop-back; 48 MHz; limits of an STM32's bit timing.
        if (setup.request == limits)
            return UsbAnswer::done(words({3, 48'000'000, 1, 16, 1, 8, 4, 1, 1024, 1}));
        return UsbAnswer::stall();
    }
    if (setup.request == mode) take_mode(data);
    return setup.request <= configuration ? UsbAnswer::done() : UsbAnswer::stall();
}

void GsUsbDevice::take_mode(std::span<const std::uint8_t> data) {
    if (data.size() < 8) return;
    started_ = little(data, 0) == 1;
    off_ = false;
    frames_.clear();
}

void GsUsbDevice::put(std::uint32_t echo, std::uint32_t id, std::span<const std::uint8_t> data) {
    if (frames_.size() >= most_waiting) return;
    Bytes frame = words({echo, id});
    frame.push_back(static_cast<std::uint8_t>(data.size()));
    frame.resize(12); // channel 0, no flags
    frame.insert(frame.end(), data.begin(), data.end());
    frame.resize(frame_size);
    frames_.push_back(std::move(frame));
}

void GsUsbDevice::put_all(const std::vector<CanMessage>& frames) {
    if (!started_ || off_) return;
    for (const CanMessage& frame : frames)
        put(from_bus, frame.id, frame.data);
}

/// A frame of the host goes to the bus, is confirmed by its echo, and answered. Off the bus it is
/// neither.
UsbAnswer GsUsbDevice::out(std::uint8_t, std::span<const std::uint8_t> data) {
    if (data.size() < frame_size || !started_ || off_) return UsbAnswer::done();
    const auto size = std::min<std::size_t>(8, data[8]);
    const auto content = data.subspan(12, size);
    put(little(data, 0), little(data, 4), content);
    if ((little(data, 4) & long_id_flag) != 0) return UsbAnswer::done();
    const bool remote = (little(data, 4) & remote_flag) != 0;
    CanMessage frame{little(data, 4) & ~remote_flag, {}, remote};
    if (!remote) frame.data.assign(content.begin(), content.end());
    for (const auto& node : nodes_)
        put_all(node->take(frame, now_s_()));
    return UsbAnswer::done();
}

UsbAnswer GsUsbDevice::in(std::uint8_t, std::size_t) {
    if (goes_off_.exchange(false) && started_) {
        off_ = true;
        frames_.clear();
        put(from_bus, error_flag | bus_off_class, Bytes(8));
    }
    for (const auto& node : nodes_)
        put_all(node->advance(now_s_()));
    if (frames_.empty()) return UsbAnswer::hold();
    Bytes frame = std::move(frames_.front());
    frames_.pop_front();
    return UsbAnswer::done(std::move(frame));
}

std::string GsUsbDevice::state() const {
    std::string list;
    for (const auto& node : nodes_)
        list += (list.empty() ? "node " : ", node ") + std::to_string(node->number()) +
                " skipped " + std::to_string(node->pdos_skipped());
    return list;
}

Result<void> GsUsbDevice::obey(const std::string& word) {
    if (word != "bus-off") return fail(Fault::bad_request, "an adapter knows \"bus-off\" only");
    goes_off_ = true;
    return {};
}

} // namespace axiscal::simulate
