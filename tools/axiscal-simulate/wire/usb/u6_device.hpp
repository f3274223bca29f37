#pragma once
// A LabJack U6 as its maker's C examples expect it (exodriver, examples/U6): commands on endpoint
// 1, replies on 2, the stream on 3. One analog input is streamed. All of it on one thread.

#include "wire/usb/usb_device.hpp"

#include <atomic>
#include <deque>
#include <functional>

namespace axiscal::simulate {

class U6Device final : public UsbDevice {
public:
    struct World {
        std::function<double()> now_s;       ///< never goes back
        std::function<double(double)> volts; ///< at the input, at this time
    };
    U6Device(std::uint32_t serial, World world);

    [[nodiscard]] const UsbDescriptors& descriptors() const override { return descriptors_; }
    void plugged() override;
    UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
    UsbAnswer out(std::uint8_t endpoint, std::span<const std::uint8_t> data) override;
    UsbAnswer in(std::uint8_t endpoint, std::size_t most) override;
    /// Samples that its buffer lost although a transfer for them was there all the time: this
    /// computer stood still. What it lost because nobody asked for it is not among them.
    [[nodiscard]] std::uint64_t skipped() const override { return skipped_; }

    /// Stream packet number `packet` (from 0) and those after it, `count` in all, never leave the
    /// device.
    void swallow(std::uint64_t packet, std::uint64_t count);

    /// Constant `index` (0 .. 39) of the calibration memory: the nominal one, and a little off as
    /// those of a real device are.
    static double constant(int index);
    /// Samples that fit into the U6's own buffer.
    static constexpr std::uint64_t buffer = 984;

private:
    void answer_config();
    void answer_memory(std::span<const std::uint8_t> command);
    void configure(std::span<const std::uint8_t> command);
    void start_or_stop(bool start);
    [[nodiscard]] std::uint16_t count_at(std::uint64_t scan) const;
    UsbAnswer stream();
    UsbAnswer report_loss(std::uint64_t taken);
    [[nodiscard]] Bytes packet(std::uint8_t error, std::uint64_t lost);

    UsbDescriptors descriptors_;
    std::uint32_t serial_;
    World world_;
    std::deque<Bytes> replies_;
    bool streaming_ = false, overflowed_ = false;
    bool host_waits_ = false;  ///< for the stream, since the last look at it
    bool stood_still_ = false; ///< when the buffer ran over
    double started_s_ = 0, period_s_ = 1e-3;
    int gain_index_ = 0, per_packet_ = 25;
    std::uint64_t next_scan_ = 0, packets_ = 0, buffered_until_ = 0;
    std::uint64_t swallow_from_ = 0, swallow_count_ = 0;
    std::atomic<std::uint64_t> skipped_{0};
};

} // namespace axiscal::simulate
