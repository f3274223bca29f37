#include "wire/usb/u6_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axiscal::simulate {
namespace {

using ByteView = std::span<const std::uint8_t>;

std::uint8_t folded(unsigned sum) {
    sum = (sum >> 8) + (sum & 0xFFU);
    return static_cast<std::uint8_t>((sum >> 8) + (sum & 0xFFU));
}

unsigned total(ByteView bytes) {
    unsigned sum = 0;
    for (const std::uint8_t byte : bytes)
        sum += byte;
    return sum;
}

std::uint8_t low(std::uint64_t number, int byte = 0) {
    return static_cast<std::uint8_t>(number >> (8 * byte) & 0xFFU);
}

/// Checksums of an extended frame, whose other bytes stand already.
Bytes closed(Bytes frame) {
    const unsigned sum = total(ByteView{frame}.subspan(6));
    frame[4] = low(sum);
    frame[5] = low(sum, 1);
    frame[0] = folded(total(ByteView{frame}.subspan(1, 5)));
    return frame;
}

bool sound(ByteView frame) {
    if (frame.size() < 2) return false;
    if (frame.size() == 2) return frame[0] == folded(frame[1]);
    return frame.size() >= 8 && closed(Bytes(frame.begin(), frame.end()))[0] == frame[0] &&
           low(total(frame.subspan(6))) == frame[4] && low(total(frame.subspan(6)), 1) == frame[5];
}

Bytes reply_frame(int words, int command) {
    Bytes frame(6 + 2 * static_cast<std::size_t>(words));
    frame[1] = 0xF8;
    frame[2] = low(static_cast<unsigned>(words));
    frame[3] = low(static_cast<unsigned>(command));
    return frame;
}

/// u6.c: 32 bits of fraction, then the whole number.
void put_fixed_point(Bytes& frame, std::size_t at, double value) {
    const double whole = std::floor(value);
    const auto fraction = static_cast<std::uint64_t>(std::round((value - whole) * 4294967296.0));
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
    for (int byte = 0; byte < 4; ++byte) {
        frame[at + static_cast<std::size_t>(byte)] = low(fraction, byte);
        frame[at + 4 + static_cast<std::size_t>(byte)] = low(bits, byte);
    }
}

} // namespace

U6Device::U6Device(std::uint32_t serial, World world)
    : serial_{serial}
    , world_{std::move(world)} {
    descriptors_.vendor = 0x0CD5;
    descriptors_.product = 0x0006;
    descriptors_.its_class = 0xFF;
    descriptors_.maker = "LabJack Corporation";
    descriptors_.name = "LabJack U6"; // and no serial number: ConfigU6 tells it
    UsbInterface interface;
    interface.endpoints = {{0x01}, {0x82}, {0x83}};
    descriptors_.interfaces.push_back(std::move(interface));
}

/// u6.c, U6_CALIBRATION_INFO_DEFAULT; slopes 0.1 % and 0.05 % off, centre by 11.5 counts.
double U6Device::constant(int index) {
    if (index >= 16) return 0;
    const double gain = std::pow(10.0, -(index % 8) / 2);
    if (index < 8) return index % 2 == 0 ? 3.1580578e-4 * 1.001 * gain : -10.5869565 * gain;
    return index % 2 == 0 ? -3.158058e-4 * 1.0005 * gain : 33534.5;
}

void U6Device::plugged() {
    replies_.clear();
    streaming_ = false;
}

UsbAnswer U6Device::control(const UsbSetup&, std::span<const std::uint8_t>) {
    return UsbAnswer::stall();
}

/// ConfigU6 that writes nothing: 38 bytes.
void U6Device::answer_config() {
    Bytes frame = reply_frame(16, 0x08);
    frame[9] = 43; // firmware 1.43
    frame[10] = 1;
    for (int byte = 0; byte < 4; ++byte)
        frame[15 + static_cast<std::size_t>(byte)] = low(serial_, byte);
    frame[19] = 6; // product
    frame[21] = 1; // local id
    frame[37] = 4; // U6
    replies_.push_back(closed(std::move(frame)));
}

void U6Device::answer_memory(ByteView command) {
    const int block = command[7];
    Bytes frame = reply_frame(17, 0x2D);
    for (int i = 0; i < 4; ++i)
        put_fixed_point(frame, 8 + 8 * static_cast<std::size_t>(i), constant(4 * block + i));
    replies_.push_back(closed(std::move(frame)));
}

/// StreamConfig: one channel, 4 MHz.
void U6Device::configure(ByteView command) {
    Bytes frame = reply_frame(1, 0x11);
    const bool one_channel = command.size() == 16 && command[6] == 1;
    if (streaming_)
        frame[6] = 48; // STREAM_IS_ACTIVE
    else if (!one_channel || command[8] < 1 || command[8] > 25)
        frame[6] = 50; // STREAM_CONFIG_INVALID
    else {
        per_packet_ = command[8];
        period_s_ = (command[12] + 256 * command[13]) / 4e6;
        gain_index_ = command[15] >> 4 & 3;
    }
    replies_.push_back(closed(std::move(frame)));
}

void U6Device::start_or_stop(bool start) {
    Bytes reply{0, static_cast<std::uint8_t>(start ? 0xA9 : 0xB1), 0, 0};
    if (streaming_ == start) reply[2] = start ? 48 : 52; // active already, or not running
    reply[0] = folded(total(ByteView{reply}.subspan(1)));
    replies_.push_back(std::move(reply));
    streaming_ = start;
    overflowed_ = host_waits_ = false;
    started_s_ = world_.now_s();
    next_scan_ = packets_ = 0;
}

UsbAnswer U6Device::out(std::uint8_t endpoint, ByteView data) {
    if (endpoint != 1) return UsbAnswer::stall();
    if (!sound(data))
        replies_.push_back({0xB8, 0xB8}); // bad checksum
    else if (data.size() == 2 && (data[1] == 0xA8 || data[1] == 0xB0))
        start_or_stop(data[1] == 0xA8);
    else if (data.size() == 26 && data[3] == 0x08)
        answer_config();
    else if (data.size() == 8 && data[3] == 0x2D)
        answer_memory(data);
    else if (data.size() >= 14 && data[3] == 0x11)
        configure(data);
    return UsbAnswer::done();
}

std::uint16_t U6Device::count_at(std::uint64_t scan) const {
    const double volts = world_.volts(started_s_ + static_cast<double>(scan) * period_s_);
    const double centre = constant(2 * gain_index_ + 9);
    const double count = volts >= 0 ? centre + volts / constant(2 * gain_index_)
                                    : centre - volts / constant(2 * gain_index_ + 8);
    return static_cast<std::uint16_t>(std::clamp(std::round(count), 0.0, 65535.0));
}

Bytes U6Device::packet(std::uint8_t error, std::uint64_t lost) {
    const auto count = static_cast<std::size_t>(per_packet_);
    Bytes frame(14 + 2 * count);
    frame[1] = 0xF9;
    frame[2] = low(4 + count);
    frame[3] = 0xC0;
    frame[6] = low(lost);
    frame[7] = low(lost, 1);
    frame[10] = low(packets_);
    frame[11] = error;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t value = count_at(next_scan_ + i);
        frame[12 + 2 * i] = low(value);
        frame[13 + 2 * i] = low(value, 1);
    }
    next_scan_ += count;
    ++packets_;
    return closed(std::move(frame));
}

UsbAnswer U6Device::report_loss(std::uint64_t taken) {
    const auto count = static_cast<std::uint64_t>(per_packet_);
    overflowed_ = false;
    const std::uint64_t lost = std::min<std::uint64_t>(taken - count - next_scan_, 65535);
    next_scan_ += lost;
    if (stood_still_) skipped_ += lost;
    return UsbAnswer::done(packet(60, lost));
}

/// A full buffer takes nothing new until it has been sent; then the report of what is missing.
UsbAnswer U6Device::stream() {
    if (!streaming_) return UsbAnswer::hold();
    const auto count = static_cast<std::uint64_t>(per_packet_);
    const auto taken = static_cast<std::uint64_t>((world_.now_s() - started_s_) / period_s_ + 1e-6);
    if (!overflowed_ && taken > next_scan_ + buffer) {
        overflowed_ = true;
        stood_still_ = host_waits_;
        buffered_until_ = next_scan_ + buffer;
    }
    if (overflowed_ && next_scan_ + count <= buffered_until_) return UsbAnswer::done(packet(59, 0));
    if (taken < next_scan_ + count) return UsbAnswer::hold();
    return overflowed_ ? report_loss(taken) : UsbAnswer::done(packet(0, 0));
}

UsbAnswer U6Device::in(std::uint8_t endpoint, std::size_t) {
    if (endpoint == 3) {
        UsbAnswer answer = stream();
        while (answer.how == UsbAnswer::How::done && packets_ > swallow_from_ &&
               packets_ <= swallow_from_ + swallow_count_)
            answer = stream();
        host_waits_ = answer.how == UsbAnswer::How::hold;
        return answer;
    }
    if (endpoint != 2) return UsbAnswer::stall();
    if (replies_.empty()) return UsbAnswer::hold();
    Bytes reply = std::move(replies_.front());
    replies_.pop_front();
    return UsbAnswer::done(std::move(reply));
}

void U6Device::swallow(std::uint64_t packet, std::uint64_t count) {
    swallow_from_ = packet;
    swallow_count_ = count;
}

} // namespace axiscal::simulate
