// Dracal VCP air sensors (VCP-PTH450-CAL, VCP-PTH200 ...): pressure, temperature, humidity.
//
// Document: Dracal Technologies' public sample program for VCP instruments ("sample-c-vcp"),
// state of 2025, with the protocol in its comments. "[lines]" cites its list of line kinds,
// "[commands]" its list of commands. Nothing here was seen on a real device yet.
//
// [lines]    D,<product>,<serial>,<message>,<value>,<unit>,...,*<crc>     a reading
//            I,<product>,<serial>,<message>,*<crc>                        an acknowledgement
//            I,Product ID,Serial Number,Message,<name>,<unit>,...,*<crc>  the answer to INFO
//            crc: CRC-16/XMODEM over all before the '*', 4 hex digits of either case.
// [commands] INFO; POLL <ms>; each ended by CR LF.

#include "drivers/environment/environment_dracal_vcp.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/environment/dracal_line.hpp"
#include "drivers/framing/line_framer.hpp"
#include "drivers/wire/link_settings.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr std::size_t longest_line = 512;
constexpr Duration link_patience = std::chrono::seconds{2};
/// A sensor that was plugged in again has forgotten its poll interval: it is told again after
/// three missed readings, and given up after five such times.
constexpr int missed_readings = 3, tries = 5;

enum DracalChannel : int { air_temperature, air_pressure, air_humidity };

std::optional<int> channel_of(ChannelKind kind) {
    switch (kind) {
    case ChannelKind::temperature: return air_temperature;
    case ChannelKind::pressure: return air_pressure;
    case ChannelKind::humidity: return air_humidity;
    default: return std::nullopt;
    }
}

std::vector<std::byte> command(const std::string& text) {
    const std::string line = text + "\r\n";
    const auto bytes = std::as_bytes(std::span{line});
    return {bytes.begin(), bytes.end()};
}

class DracalVcp final : public Instrument {
public:
    DracalVcp(LinkSettings link, Duration poll_period)
        : link_settings_{std::move(link)}
        , poll_period_{poll_period}
        , channels_{{"air temperature", ChannelKind::temperature, Medium::air},
                    {"air pressure", ChannelKind::pressure, Medium::air},
                    {"air humidity", ChannelKind::humidity, Medium::air}} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<void>> ask(ByteLink& link, InstrumentContext context);
    void take_line(std::string_view line, MonotonicTime read_at, SampleSink& sink);
    void take_reading(const DracalLine& line, MonotonicTime at, SampleSink& sink);
    void identify(const DracalLine& line, SampleSink& sink);

    LinkSettings link_settings_;
    Duration poll_period_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    std::string known_serial_;
    MonotonicTime heard_at_{};
};

/// The link is owned by the awaiting frame.
Task<Result<void>> DracalVcp::ask(ByteLink& link, InstrumentContext context) {
    const auto period = std::chrono::duration_cast<std::chrono::milliseconds>(poll_period_);
    const MonotonicTime deadline = context.scheduler->now() + link_patience;
    auto info = command("INFO");
    auto poll = command("POLL " + std::to_string(period.count()));
    auto written = co_await link.write_all(std::move(info), deadline);
    if (written) written = co_await link.write_all(std::move(poll), deadline);
    co_return written;
}

void DracalVcp::identify(const DracalLine& line, SampleSink& sink) {
    const bool table = line.product == "Product ID"; // the INFO table names columns only
    if (table || line.serial.empty() || line.serial == known_serial_) return;
    known_serial_ = line.serial;
    sink.identify(Identity{"Dracal Technologies", line.product, line.serial, ""});
}

/// Each channel gets the first pair of its kind; what the line does not hold is absent.
void DracalVcp::take_reading(const DracalLine& line, MonotonicTime at, SampleSink& sink) {
    std::array<std::optional<double>, 3> values;
    std::array<bool, 3> seen{};
    for (const DracalPair& pair : line.pairs) {
        const auto reading = stored_reading(pair);
        const auto channel = reading ? channel_of(reading->kind) : std::nullopt;
        if (!channel || seen[static_cast<std::size_t>(*channel)]) continue;
        seen[static_cast<std::size_t>(*channel)] = true;
        values[static_cast<std::size_t>(*channel)] = reading->value;
    }
    // It sends by itself once a period, and does not tell when within it the chips were read.
    const PlacedTime placed = placed_at_end(at, poll_period_);
    for (int channel = 0; channel < 3; ++channel) {
        ++counters_.samples;
        sink.take(sample_at(channel, placed, values[static_cast<std::size_t>(channel)]));
    }
}

void DracalVcp::take_line(std::string_view text, MonotonicTime read_at, SampleSink& sink) {
    if (text.empty()) return;
    const auto body = verify_dracal_line(text);
    if (!body) {
        ++(body.error().fault == Fault::checksum ? counters_.checksum_errors
                                                 : counters_.bad_frames);
        return;
    }
    const auto line = parse_dracal_line(*body);
    if (!line) {
        ++counters_.bad_frames;
        return;
    }
    ++counters_.frames;
    identify(*line, sink);
    if (line->kind != 'D') return;
    heard_at_ = read_at;
    if (!line->message.empty())
        sink.note(Fault::signal_error, line->product + " says: " + line->message);
    take_reading(*line, read_at, sink);
}

Task<Result<void>> DracalVcp::run(InstrumentContext context) {
    auto opened =
        co_await context.links->open(link_settings_, context.scheduler->now() + link_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    known_serial_.clear();
    LineFramer framer{longest_line};
    const Duration silence = poll_period_ * missed_readings;
    for (int asked = 0; asked < tries; ++asked) {
        if (asked > 0) ++counters_.timeouts;
        const auto answered = co_await ask(*link, context);
        if (!answered) co_return answered;
        heard_at_ = context.scheduler->now();
        const MonotonicTime asked_at = heard_at_;
        while (context.scheduler->now() - heard_at_ < silence) {
            const auto arrived = co_await link->read_some(heard_at_ + silence);
            if (!arrived && arrived.error().fault == Fault::link_timeout) break;
            if (!arrived) co_return tl::unexpected<Error>(arrived.error());
            const auto oversized = framer.feed(arrived->bytes, [&](std::string_view line) {
                take_line(line, arrived->read_at, *context.sink);
            });
            counters_.bad_frames += oversized;
        }
        if (heard_at_ > asked_at) asked = 0;
    }
    co_return fail(Fault::link_timeout, "no reading from " + link_settings_.describe());
}

const std::array dracal_vcp_ids{UsbId{0x289B, 0}};

} // namespace

const Appearance dracal_vcp_appearance{Wire::serial, dracal_vcp_ids, false, "air", ""};

std::unique_ptr<Instrument> make_dracal_vcp(const InstrumentConfig& /*config*/, Settings& options) {
    LinkSettings defaults;
    defaults.baud = 9600;
    const LinkSettings link = read_link(options, defaults);
    const Duration poll_period =
        options.duration("poll_period", std::chrono::milliseconds{100}, std::chrono::seconds{60},
                         std::chrono::milliseconds{500});
    return std::make_unique<DracalVcp>(link, poll_period);
}

} // namespace axiscal
