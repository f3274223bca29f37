// PCsensor TEMPerX232 (USB numbers 1a86:5523): temperature and humidity of the stick and of a probe
// in its jack, as text on a serial line. The other sticks are HID devices: environment_temper.cpp.
//
// Document: what the stick itself answers to "Help" (firmware TEMPerX232_V2.0, SHENZHEN RDing
// Tech), printed with the answers to its other commands in urwen/temper (2018 and later).
// "[ReadTemp]",
// "[ReadCalib]", "[Version]" cite its list of commands. Nothing here was seen on a real device yet.
//
// [COM]       9600 baud, 8 bits, no parity, 1 stop bit; a command has no end of line.
// [Version]   TEMPerX232_V2.0
// [ReadTemp]  Temp-Inner:30.53 [C],39.92 [%RH]<
//             "temp_value = sensor_value + calibration". Of the line of a probe the open drivers
//             know its beginning, Temp-Outer:, and no more: the same form is expected.
// [ReadCalib] Inner-Calib:0.0 [C],0.0 [%RH] and Outer-Calib:0.0 [C],0.0 [%RH]
// Lines end with CR LF (another open driver, of the same stick); whether the one of Version does is
// not told, so that a second of silence ends it as well.

#include "drivers/environment/environment_temper_serial.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/late_answers.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/environment/temper_line.hpp"
#include "drivers/framing/line_framer.hpp"
#include "drivers/wire/link_settings.hpp"

#include <array>
#include <cstdio>

namespace axiscal {
namespace {

constexpr std::size_t longest_line = 96;    ///< a reading has 34 characters
constexpr std::size_t longest_answer = 512; ///< to one command
constexpr Duration link_patience = std::chrono::seconds{2};
constexpr Duration reply_patience = std::chrono::seconds{1};
constexpr int tries = 3;        ///< of its name: bytes of an earlier talk may come first
constexpr int silent_polls = 3; ///< then the line is opened anew

enum TemperChannel : int { probe_temperature, stick_temperature, probe_humidity, stick_humidity };

std::vector<std::byte> command(std::string_view text) {
    const auto bytes = std::as_bytes(std::span{text});
    return {bytes.begin(), bytes.end()};
}

class TemperSerial final : public Instrument {
public:
    TemperSerial(LinkSettings link, Duration poll_period)
        : link_settings_{std::move(link)}
        , poll_period_{poll_period}
        , channels_{{"probe temperature", ChannelKind::temperature, Medium::none},
                    {"stick temperature", ChannelKind::temperature, Medium::none},
                    {"probe humidity", ChannelKind::humidity, Medium::none},
                    {"stick humidity", ChannelKind::humidity, Medium::none}} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<std::string>>
    ask(ByteLink& link, Scheduler& scheduler, std::string_view what, int lines);
    Task<Result<void>> identify(ByteLink& link, InstrumentContext context);
    Task<Result<void>> ask_calibration(ByteLink& link, InstrumentContext context);
    Task<Result<void>>
    hear_until(ByteLink& link, InstrumentContext context, LineFramer& framer, MonotonicTime end);
    Task<Result<void>> poll(ByteLink& link, InstrumentContext context, LineFramer& framer);
    void close_request(std::string_view text, MonotonicTime read_at);
    void take_line(std::string_view text, MonotonicTime read_at, SampleSink& sink);
    void hand_up(int channel, const PlacedTime& at, std::optional<double> value, SampleSink& sink);

    LinkSettings link_settings_;
    Duration poll_period_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    bool probe_heard_ = false; ///< in this poll
    OpenRequests requests_;
    MonotonicTime asked_at_{};             ///< the request that was answered last
    bool probe_may_follow_ = false;        ///< the last line was the stick's own
    std::optional<PlacedTime> heard_at_{}; ///< the stick's own line, in this poll
};

/// What comes until so many lines have ended, or nothing more comes in patience. The link is owned
/// by the awaiting frame.
Task<Result<std::string>>
TemperSerial::ask(ByteLink& link, Scheduler& scheduler, std::string_view what, int lines) {
    const MonotonicTime deadline = scheduler.now() + reply_patience;
    auto request = command(what);
    const auto written = co_await link.write_all(std::move(request), deadline);
    if (!written) co_return tl::unexpected<Error>(written.error());
    std::string text;
    while (lines > 0 && text.size() < longest_answer) {
        const auto arrived = co_await link.read_some(deadline);
        if (!arrived && arrived.error().fault == Fault::link_timeout) break;
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        for (const std::byte byte : arrived->bytes) {
            text += static_cast<char>(byte);
            if (text.back() == '\n') --lines;
        }
    }
    co_return text;
}

/// @errors Fault::link_timeout for silence, Fault::unknown_instrument for another name.
Task<Result<void>> TemperSerial::identify(ByteLink& link, InstrumentContext context) {
    std::string heard;
    for (int tried = 0; tried < tries; ++tried) {
        const auto answer = co_await ask(link, *context.scheduler, "Version", 1);
        if (!answer) co_return tl::unexpected<Error>(answer.error());
        const std::string name = temper_version(*answer);
        if (!name.empty()) {
            context.sink->identify(Identity{"PCsensor", name.substr(0, name.find("_V")), "", name});
            co_return Result<void>{};
        }
        if (answer->empty()) ++counters_.timeouts;
        heard += *answer;
    }
    if (heard.empty())
        co_return fail(Fault::link_timeout,
                       "no answer from " + link_settings_.describe() +
                           ": hold the stick's button until its green light flashes");
    ++counters_.bad_frames;
    co_return fail(Fault::unknown_instrument,
                   "what answers on " + link_settings_.describe() + " gives no name of a TEMPer");
}

/// What the stick adds by itself stands in no certificate: it is told. Silence is no error.
Task<Result<void>> TemperSerial::ask_calibration(ByteLink& link, InstrumentContext context) {
    const auto answer = co_await ask(link, *context.scheduler, "ReadCalib", 2);
    if (!answer) co_return tl::unexpected<Error>(answer.error());
    LineFramer framer{longest_line};
    const auto oversized = framer.feed(command(*answer), [&](std::string_view line) {
        const auto own = parse_temper_calibration(line);
        if (!own || (own->temperature_K == 0 && own->humidity_percent == 0)) return;
        char text[128];
        std::snprintf(text, sizeof text,
                      "the stick adds %+.1f K and %+.1f %%RH of its own to its %s: "
                      "EraseFlash takes them away",
                      own->temperature_K, own->humidity_percent, own->probe ? "probe" : "sensor");
        context.sink->note(Fault::none, text);
    });
    counters_.bad_frames += oversized;
    co_return Result<void>{};
}

void TemperSerial::hand_up(int channel,
                           const PlacedTime& at,
                           std::optional<double> value,
                           SampleSink& sink) {
    ++counters_.samples;
    sink.take(sample_at(channel, at, value));
}

/// An answer begins with the stick's own line, damaged or not; the probe's belongs to the same one.
void TemperSerial::close_request(std::string_view text, MonotonicTime read_at) {
    const bool own = text.starts_with("Temp-Inner:");
    if (!own && !text.starts_with("Temp-Outer:")) return;
    const bool goes_on = std::exchange(probe_may_follow_, own) && !own;
    if (goes_on) return;
    if (const auto asked = requests_.answered(read_at)) asked_at_ = *asked;
}

void TemperSerial::take_line(std::string_view text, MonotonicTime read_at, SampleSink& sink) {
    if (text.empty()) return;
    close_request(text, read_at);
    const auto line = parse_temper_line(text);
    if (!line) {
        ++counters_.bad_frames;
        return;
    }
    ++counters_.frames;
    const PlacedTime placed = placed_between(asked_at_, read_at);
    if (line->probe)
        probe_heard_ = true;
    else
        heard_at_ = placed;
    hand_up(line->probe ? probe_temperature : stick_temperature, placed, line->temperature_degC,
            sink);
    if (line->has_humidity)
        hand_up(line->probe ? probe_humidity : stick_humidity, placed, line->humidity_percent,
                sink);
}

/// The link and the framer are owned by run()'s frame, which waits.
Task<Result<void>> TemperSerial::hear_until(ByteLink& link,
                                            InstrumentContext context,
                                            LineFramer& framer,
                                            MonotonicTime end) {
    while (context.scheduler->now() < end) {
        const auto arrived = co_await link.read_some(end);
        if (!arrived && arrived.error().fault == Fault::link_timeout) break;
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        const auto oversized = framer.feed(arrived->bytes, [&](std::string_view line) {
            take_line(line, arrived->read_at, *context.sink);
        });
        counters_.bad_frames += oversized;
    }
    co_return Result<void>{};
}

/// One request and what comes until the next is due. A probe of which there is no line is absent.
Task<Result<void>>
TemperSerial::poll(ByteLink& link, InstrumentContext context, LineFramer& framer) {
    heard_at_.reset();
    probe_heard_ = false;
    const auto hear = [&](MonotonicTime end) { return hear_until(link, context, framer, end); };
    const auto late = co_await hear_late(requests_, *context.scheduler, poll_period_, hear);
    if (!late) co_return late;
    const MonotonicTime asked = context.scheduler->now();
    requests_.asked(asked);
    const MonotonicTime next = asked + poll_period_;
    auto request = command("ReadTemp");
    const auto written = co_await link.write_all(std::move(request), next + link_patience);
    if (!written) co_return written;
    const auto heard = co_await hear_until(link, context, framer, next);
    if (!heard) co_return heard;
    if (heard_at_ && !probe_heard_)
        hand_up(probe_temperature, *heard_at_, std::nullopt, *context.sink);
    co_return Result<void>{};
}

Task<Result<void>> TemperSerial::run(InstrumentContext context) {
    auto opened =
        co_await context.links->open(link_settings_, context.scheduler->now() + link_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    const auto known = co_await identify(*link, context);
    if (!known) co_return known;
    const auto answered = co_await ask_calibration(*link, context);
    if (!answered) co_return answered;
    requests_.forget();
    probe_may_follow_ = false;
    asked_at_ = context.scheduler->now(); // no reading is older
    LineFramer framer{longest_line};
    for (int silent = 0; silent < silent_polls;) {
        const auto polled = co_await poll(*link, context, framer);
        if (!polled) co_return polled;
        const bool heard = heard_at_ || probe_heard_;
        silent = heard ? 0 : silent + 1;
        if (!heard) ++counters_.timeouts;
    }
    co_return fail(Fault::link_timeout, "no reading from " + link_settings_.describe());
}

const std::array temper_serial_ids{UsbId{0x1A86, 0x5523}};

} // namespace

const Appearance temper_serial_appearance{Wire::serial, temper_serial_ids, false, "material", ""};

std::unique_ptr<Instrument> make_temper_serial(const InstrumentConfig& /*config*/,
                                               Settings& options) {
    LinkSettings defaults;
    defaults.baud = 9600;
    const LinkSettings link = read_link(options, defaults);
    const Duration poll_period =
        options.duration("poll_period", std::chrono::milliseconds{500}, std::chrono::seconds{60},
                         std::chrono::seconds{1});
    return std::make_unique<TemperSerial>(link, poll_period);
}

} // namespace axiscal
