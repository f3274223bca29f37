// LVDT ballbar (or any transducer with a voltage) on a LabJack U6, streamed over USB.
//
// Document: LabJack's own C support for Linux, "exodriver": liblabjackusb and examples/U6 (state of
// 2025), with the U6 low-level function reference in its comments. "[frames]" cites its checksums,
// "[stream]" examples/U6/u6Stream.c, "[calibration]" and "[fixed point]" examples/U6/u6.c. Nothing
// here was seen on a real device yet.
//
// [wire]    0CD5:0006; bulk OUT 0x01 commands, IN 0x82 replies, IN 0x83 stream. The device has no
//           serial number that the kernel knows: ConfigU6 tells it.
// [stream]  64-byte packets of 25 samples, counter of packets 0 .. 255, error 59: the buffer ran
//           over and old samples are sent, error 60: bytes 6..7 scans are missing.

#include "drivers/ballbar/ballbar_labjack_u6.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/ballbar/u6_stream.hpp"
#include "drivers/wire/link_settings.hpp"
#include "drivers/wire/usb_link.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

constexpr int command_out = 0x01, reply_in = 0x82, stream_in = 0x83;
constexpr std::size_t longest_transfer = 64;
constexpr int calibration_blocks = 4; ///< slopes and centres of all gains
constexpr int most_devices = 16;
constexpr Duration reply_patience = std::chrono::seconds{1};
constexpr Duration open_patience = std::chrono::seconds{2};
/// What an earlier session left in the endpoints comes at once, or not at all.
constexpr Duration leftover_patience = std::chrono::milliseconds{20};
constexpr int most_leftovers = 128;
constexpr Duration silence = std::chrono::seconds{2}; ///< without a whole packet
/// STALL comes at once: asking again at once would only burn the CPU.
constexpr Duration after_stall = std::chrono::milliseconds{10};
/// From the last sample of a packet to the host: conversion and one frame of USB [N].
constexpr Duration usb_frame = std::chrono::milliseconds{1};

class LabJackU6 final : public Instrument {
public:
    LabJackU6(LinkSettings link, U6StreamSetup setup, U6Scale scale)
        : link_settings_{std::move(link)}
        , serial_{std::exchange(link_settings_.usb.serial, {})}
        , setup_{setup}
        , channels_{{"ballbar", ChannelKind::displacement, Medium::none}}
        , stream_{setup, scale, usb_frame, counters_} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    /// Links are owned by the awaiting frame.
    Task<Result<std::unique_ptr<UsbLink>>> open(InstrumentContext context);
    Task<Result<U6Identity>> greet(UsbLink& link, Scheduler& scheduler);
    Task<Result<TimedBytes>> ask(UsbLink& link, Scheduler& scheduler, U6Bytes request);
    Task<Result<void>> empty(UsbLink& link, Scheduler& scheduler, int endpoint);
    [[nodiscard]] Error absence() const;
    Task<Result<U6Range>> read_range(UsbLink& link, Scheduler& scheduler);
    Task<Result<void>> start_stream(UsbLink& link, Scheduler& scheduler);
    Task<Result<void>> read_stream(UsbLink& link, InstrumentContext context);

    LinkSettings link_settings_;
    std::string serial_; ///< wanted; empty: any
    U6StreamSetup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    U6Stream stream_;
};

/// One command and its reply.
Task<Result<TimedBytes>> LabJackU6::ask(UsbLink& link, Scheduler& scheduler, U6Bytes request) {
    const MonotonicTime deadline = scheduler.now() + reply_patience;
    const auto sent = co_await link.bulk_out(command_out, std::move(request), deadline);
    if (!sent) co_return tl::unexpected<Error>(sent.error());
    auto reply = co_await link.bulk_in(reply_in, longest_transfer, deadline);
    if (!reply && reply.error().fault == Fault::link_timeout) ++counters_.timeouts;
    co_return reply;
}

Task<Result<void>> LabJackU6::empty(UsbLink& link, Scheduler& scheduler, int endpoint) {
    for (int left = 0; left < most_leftovers; ++left) {
        const auto old =
            co_await link.bulk_in(endpoint, longest_transfer, scheduler.now() + leftover_patience);
        if (old || old.error().fault == Fault::refused) continue;
        if (old.error().fault == Fault::link_timeout) break;
        co_return tl::unexpected<Error>(old.error());
    }
    co_return Result<void>{};
}

/// Ends the stream of a session that died, throws away what it left, and asks who is there.
Task<Result<U6Identity>> LabJackU6::greet(UsbLink& link, Scheduler& scheduler) {
    auto stop = u6_stream_stop_request();
    const auto stopped =
        co_await link.bulk_out(command_out, std::move(stop), scheduler.now() + reply_patience);
    if (!stopped) co_return tl::unexpected<Error>(stopped.error());
    for (const int endpoint : {stream_in, reply_in}) {
        const auto emptied = co_await empty(link, scheduler, endpoint);
        if (!emptied) co_return tl::unexpected<Error>(emptied.error());
    }
    auto request = u6_config_request();
    const auto reply = co_await ask(link, scheduler, std::move(request));
    if (!reply) co_return tl::unexpected<Error>(reply.error());
    co_return decode_u6_config(reply->bytes);
}

/// In the same words whether it was missed while streaming or while being looked for.
Error LabJackU6::absence() const {
    const std::string which = serial_.empty() ? "" : " with serial number " + serial_;
    return {Fault::link_closed, "no LabJack U6" + which + " is plugged in", {}, {}};
}

/// The U6 with the wanted serial number: each that is plugged in is asked, except those in use.
Task<Result<std::unique_ptr<UsbLink>>> LabJackU6::open(InstrumentContext context) {
    Scheduler& scheduler = *context.scheduler;
    LinkSettings settings = link_settings_;
    Error last{Fault::link_closed,
               "no LabJack U6 with serial number " + serial_ + " is plugged in",
               {},
               {}};
    for (int nth = 0; nth < most_devices; ++nth) {
        settings.usb.nth = serial_.empty() ? -1 : nth;
        auto opened = co_await context.links->open_usb(settings, scheduler.now() + open_patience);
        if (!opened && opened.error().fault == Fault::busy && !serial_.empty()) {
            last = opened.error();
            continue;
        }
        if (!opened && opened.error().fault == Fault::link_closed) break; // no more of them
        if (!opened) co_return opened;
        const auto who = co_await greet(**opened, scheduler);
        if (!who && serial_.empty()) co_return tl::unexpected<Error>(who.error());
        if (!who) last = who.error();
        if (!who || (!serial_.empty() && serial_ != std::to_string(who->serial))) continue;
        const Identity identity{"LabJack", who->is_pro ? "U6-Pro" : "U6",
                                std::to_string(who->serial), who->firmware};
        context.sink->identify(identity);
        co_return opened;
    }
    co_return tl::unexpected<Error>(last);
}

Task<Result<U6Range>> LabJackU6::read_range(UsbLink& link, Scheduler& scheduler) {
    std::vector<double> constants;
    for (int block = 0; block < calibration_blocks; ++block) {
        auto request = u6_calibration_request(block);
        const auto reply = co_await ask(link, scheduler, std::move(request));
        if (!reply) co_return tl::unexpected<Error>(reply.error());
        const auto four = decode_u6_calibration(reply->bytes);
        if (!four) co_return tl::unexpected<Error>(four.error());
        constants.insert(constants.end(), four->begin(), four->end());
    }
    co_return u6_range(constants, setup_.gain_index);
}

Task<Result<void>> LabJackU6::start_stream(UsbLink& link, Scheduler& scheduler) {
    auto request = u6_stream_config_request(setup_);
    const auto configured = co_await ask(link, scheduler, std::move(request));
    if (!configured) co_return tl::unexpected<Error>(configured.error());
    const auto taken = decode_u6_stream_config(configured->bytes);
    if (!taken) co_return taken;
    auto start = u6_stream_start_request();
    const auto started = co_await ask(link, scheduler, std::move(start));
    if (!started) co_return tl::unexpected<Error>(started.error());
    co_return decode_u6_stream_start(started->bytes);
}

/// Until no whole packet has come for a while. A damaged one is counted; the next one's counter
/// tells the gap.
Task<Result<void>> LabJackU6::read_stream(UsbLink& link, InstrumentContext context) {
    MonotonicTime last_whole = context.scheduler->now();
    for (;;) {
        const auto packet =
            co_await link.next_packet(stream_in, longest_transfer, last_whole + silence);
        const bool stalled = !packet && packet.error().fault == Fault::refused;
        if (!packet && !stalled) {
            if (packet.error().fault == Fault::link_timeout) ++counters_.timeouts;
            co_return tl::unexpected<Error>(packet.error());
        }
        if (stalled) co_await context.scheduler->sleep_for(after_stall);
        auto taken = packet ? stream_.take(packet->bytes, packet->read_at, *context.sink)
                            : Result<void>{tl::unexpected<Error>(packet.error())};
        if (taken)
            last_whole = packet->read_at;
        else if (context.scheduler->now() - last_whole > silence)
            co_return taken;
    }
}

Task<Result<void>> LabJackU6::run(InstrumentContext context) {
    auto opened = co_await open(context);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<UsbLink> link = *std::move(opened);
    const auto range = co_await read_range(*link, *context.scheduler);
    if (!range) co_return tl::unexpected<Error>(range.error());
    const auto started = co_await start_stream(*link, *context.scheduler);
    if (!started) co_return started;
    stream_.begin(*range);
    auto ended = co_await read_stream(*link, context);
    if (ended.error().fault == Fault::link_closed) co_return tl::unexpected<Error>(absence());
    co_return ended;
}

U6StreamSetup read_setup(Settings& options) {
    U6StreamSetup setup;
    setup.channel = static_cast<int>(options.integer("input", 0, 13, 0));
    setup.differential = options.flag("differential", false);
    if (setup.differential && setup.channel % 2 != 0)
        options.refuse("input",
                       "a differential input is an even one: the next one is its other half");
    const std::vector<std::string> ranges{"10 V", "1 V", "0.1 V", "0.01 V"};
    const std::string range = options.choice("range", ranges, "10 V");
    const auto row = std::ranges::find(ranges, range) - ranges.begin();
    setup.gain_index = row < 4 ? static_cast<int>(row) : 0;
    setup.resolution_index = static_cast<int>(options.integer("resolution_index", 1, 8, 1));
    setup.settling_factor = static_cast<int>(options.integer("settling_factor", 0, 9, 0));
    using namespace std::chrono_literals;
    const Duration period = options.duration("sample_period", 200us, 16ms, 1ms);
    setup.interval_ticks = static_cast<int>(period / 250ns);
    return setup;
}

/// 10 V stand for `scale_length`, unless `scale_voltage` says otherwise.
U6Scale read_scale(Settings& options) {
    const Length length = options.length("scale_length", mm(0.001), mm(1000));
    const double voltage = options.number("scale_voltage", -10, 10, 10);
    if (std::abs(voltage) < 0.001)
        options.refuse("scale_voltage", "the voltage at scale_length, in volts: not 0");
    U6Scale scale;
    scale.metres_per_volt = length.si() / voltage;
    scale.usable_V = options.number("usable_voltage", 0.001, 11, 10);
    return scale;
}

const std::array u6_ids{UsbId{0x0CD5, 0x0006}};

} // namespace

const Appearance labjack_u6_appearance{
    Wire::usb,
    u6_ids,
    false,
    "ballbar",
    "scale_length = \"1 mm\"          # the length at +10 V, from the transducer's calibration\n",
    true};

std::unique_ptr<Instrument> make_labjack_u6(const InstrumentConfig& /*config*/, Settings& options) {
    LinkSettings defaults;
    defaults.kind = LinkSettings::Kind::usb;
    defaults.usb.ids.assign(u6_ids.begin(), u6_ids.end());
    const LinkSettings link = read_usb_link(options, defaults);
    const U6StreamSetup setup = read_setup(options);
    const U6Scale scale = read_scale(options);
    return std::make_unique<LabJackU6>(link, setup, scale);
}

} // namespace axiscal
