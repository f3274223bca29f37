// PCsensor TEMPer sticks (TEMPer1F, TEMPer2, TEMPerGold, TEMPerX, TEMPerHUM ...) by HID reports:
// temperature of the material by a probe, of the stick itself, humidity.
//
// Document: there is none of the maker's. The requests, offsets and firmware names are those on
// which three open drivers agree: urwen/temper (2018 and later), ccwienk/temper,
// padelt/temper-python (state of 2025). "[requests]" cites their bytes, "[families]" their table of
// firmware names. Nothing here was seen on a real device yet.
//
// [requests] reports of 8 bytes without number, on the last HID interface of the stick (the first
//            is a keyboard). 01 86 ff 01 ...: firmware, 2 or 3 reports of ASCII. 01 80 33 01 ...:
//            values, one report, a second one with a probe, in either order. They begin with
//            80; the second byte is 01 of a probe's report, 40 or 80 of the stick's, and varies
//            where there is one report alone.
//            An answer has ended after 100 ms of silence, or when the second report did not come.

#include "drivers/environment/environment_temper.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/environment/temper_report.hpp"
#include "drivers/framing/byte_order.hpp"
#include "drivers/wire/link_settings.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t report_length = 8;
constexpr std::size_t longest_answer = 4 * report_length; ///< three reports are the most known
constexpr int tries = 3;         ///< of the firmware's name: old sticks swallow the first request
constexpr int silent_rounds = 3; ///< then the stick is given up and opened anew
constexpr int most_late = 64;    ///< reports that the kernel keeps
constexpr Duration reply_patience = std::chrono::seconds{1};
constexpr Duration between_reports = std::chrono::milliseconds{100};
constexpr Duration open_patience = std::chrono::seconds{2};

enum TemperChannel : int { probe_temperature, stick_temperature, probe_humidity, stick_humidity };

class Temper final : public Instrument {
public:
    Temper(LinkSettings link, Duration poll_period)
        : link_settings_{std::move(link)}
        , poll_period_{poll_period}
        , channels_{{"probe temperature", ChannelKind::temperature},
                    {"stick temperature", ChannelKind::temperature},
                    {"probe humidity", ChannelKind::humidity},
                    {"stick humidity", ChannelKind::humidity}} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    /// The link is owned by the awaiting frame.
    Task<Result<TimedBytes>>
    ask(ByteLink& link, Scheduler& scheduler, std::vector<std::byte> what, std::size_t expected);
    Task<Result<void>> forget_late_reports(ByteLink& link, Scheduler& scheduler);
    Task<Result<TemperFamily>> identify(ByteLink& link, InstrumentContext context);
    void hand_up(const TimedBytes& reply, const TemperFamily& family, SampleSink& sink);

    LinkSettings link_settings_;
    Duration poll_period_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    MonotonicTime asked_at_{}; ///< the last request
};

/// A report that came too late for its own answer must not begin the next one.
Task<Result<void>> Temper::forget_late_reports(ByteLink& link, Scheduler& scheduler) {
    for (int late = 0; late < most_late; ++late) {
        const auto report = co_await link.read_some(scheduler.now());
        if (report) continue;
        if (report.error().fault == Fault::link_timeout) break;
        co_return tl::unexpected<Error>(report.error());
    }
    co_return Result<void>{};
}

/// All reports of one answer, with the time of the first. `expected` bytes are waited for in
/// patience, more only until the stick is silent.
/// @errors Fault::link_timeout without any, bad_frame for a report of another length or too many.
Task<Result<TimedBytes>> Temper::ask(ByteLink& link,
                                     Scheduler& scheduler,
                                     std::vector<std::byte> what,
                                     std::size_t expected) {
    const MonotonicTime deadline = scheduler.now() + reply_patience;
    const auto emptied = co_await forget_late_reports(link, scheduler);
    if (!emptied) co_return tl::unexpected<Error>(emptied.error());
    asked_at_ = scheduler.now();
    const auto written = co_await link.write_all(std::move(what), deadline);
    if (!written) co_return tl::unexpected<Error>(written.error());
    auto answer = co_await link.read_some(deadline);
    bool whole = answer && answer->bytes.size() == report_length;
    while (answer) {
        const bool waits = answer->bytes.size() < expected;
        const MonotonicTime end = waits ? deadline : scheduler.now() + between_reports;
        const auto more = co_await link.read_some(end);
        if (!more && more.error().fault == Fault::link_timeout) break;
        if (!more) co_return tl::unexpected<Error>(more.error());
        whole = whole && more->bytes.size() == report_length;
        if (answer->bytes.size() < longest_answer)
            answer->bytes.insert(answer->bytes.end(), more->bytes.begin(), more->bytes.end());
        // One that floods is heard no longer than one that is silent.
        if (scheduler.now() > deadline) break;
    }
    if (!answer) {
        if (answer.error().fault == Fault::link_timeout) ++counters_.timeouts;
        co_return answer;
    }
    if (!whole || answer->bytes.size() >= longest_answer) {
        ++counters_.bad_frames;
        co_return fail(Fault::bad_frame, "an answer that is not whole reports of 8 bytes");
    }
    ++counters_.frames;
    co_return answer;
}

Task<Result<TemperFamily>> Temper::identify(ByteLink& link, InstrumentContext context) {
    std::string firmware;
    for (int tried = 0; tried < tries && firmware.size() <= report_length; ++tried) {
        auto request = bytes_of({0x01, 0x86, 0xFF, 0x01, 0, 0, 0, 0});
        const auto answer =
            co_await ask(link, *context.scheduler, std::move(request), 2 * report_length);
        if (answer)
            firmware = temper_firmware(answer->bytes);
        else if (answer.error().fault == Fault::link_closed || tried + 1 == tries)
            co_return tl::unexpected<Error>(answer.error());
    }
    const auto family = temper_family(firmware);
    if (!family) co_return tl::unexpected<Error>(family.error());
    const Identity identity{"PCsensor", firmware.substr(0, firmware.find("_V")),
                            link_settings_.usb.serial, firmware};
    context.sink->identify(identity);
    co_return *family;
}

/// Only what the firmware knows is handed up; what it knows and does not send is absent.
void Temper::hand_up(const TimedBytes& reply, const TemperFamily& family, SampleSink& sink) {
    const TemperReading reading = decode_temper_reading(reply.bytes, family);
    counters_.bad_frames += static_cast<std::uint64_t>(reading.bad_reports);
    const PlacedTime placed = placed_between(asked_at_, reply.read_at);
    const auto take = [&](int channel, int offset, const std::optional<double>& value) {
        if (offset < 0) return;
        ++counters_.samples;
        sink.take(sample_at(channel, placed, value));
    };
    take(probe_temperature, family.probe_temperature, reading.probe_temperature);
    take(stick_temperature, family.stick_temperature, reading.stick_temperature);
    take(probe_humidity, family.probe_humidity, reading.probe_humidity);
    take(stick_humidity, family.stick_humidity, reading.stick_humidity);
}

Task<Result<void>> Temper::run(InstrumentContext context) {
    Scheduler& scheduler = *context.scheduler;
    auto opened = co_await context.links->open(link_settings_, scheduler.now() + open_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    const auto family = co_await identify(*link, context);
    if (!family) co_return tl::unexpected<Error>(family.error());
    // Values beyond the first report are in a second one.
    const bool second = std::max(family->probe_temperature, family->probe_humidity) >=
                        static_cast<int>(report_length);
    const std::size_t expected = second ? 2 * report_length : report_length;
    int silent = 0;
    MonotonicTime next = scheduler.now();
    for (;;) {
        auto request = bytes_of({0x01, 0x80, 0x33, 0x01, 0, 0, 0, 0});
        const auto answer = co_await ask(*link, scheduler, std::move(request), expected);
        if (answer) hand_up(*answer, *family, *context.sink);
        silent = answer ? 0 : silent + 1;
        if (!answer && (silent == silent_rounds || answer.error().fault == Fault::link_closed))
            co_return tl::unexpected<Error>(answer.error());
        next = std::max(next + poll_period_, scheduler.now());
        co_await scheduler.sleep_until(next);
    }
}

const std::array temper_ids{UsbId{0x0C45, 0x7401}, UsbId{0x0C45, 0x7402}, UsbId{0x413D, 0x2107},
                            UsbId{0x1A86, 0xE025}, UsbId{0x3553, 0xA001}};

} // namespace

const Appearance temper_appearance{Wire::hid, temper_ids, false, "material", ""};

std::unique_ptr<Instrument> make_temper(const InstrumentConfig& /*config*/, Settings& options) {
    LinkSettings defaults;
    defaults.kind = LinkSettings::Kind::hid;
    defaults.usb.ids.assign(temper_ids.begin(), temper_ids.end());
    defaults.usb.interface = -1;
    const LinkSettings link = read_usb_link(options, defaults);
    const Duration poll_period =
        options.duration("poll_period", std::chrono::milliseconds{500}, std::chrono::seconds{60},
                         std::chrono::seconds{1});
    return std::make_unique<Temper>(link, poll_period);
}

} // namespace axiscal
