// Dracal USBTenki sensors (USB-PTH450, USB-PTH200, USB-RTD300 ...): pressure, temperature,
// humidity, resistance thermometers, by vendor requests on endpoint 0.
//
// Document: the open firmware, library and command list "usbtenki" of Dracal Technologies, state of
// its last revision (2020). "[reply]" cites the frame of its commands, "[chips]" the numbers in
// common/usbtenki_cmds.h, "[rtd300]" and "[pt100]" its conversions. Nothing here was seen on a real
// device yet.
//
// [reply]    request 0xC0 (vendor, device, to the host), bRequest = command, wValue = argument,
//            wIndex = 0; reply: command, data ..., XOR of all before. 00 alone: error. Nothing: no
//            such channel. The maker's library asks again after STALL and after a time-out.
// [commands] 02 number of channels, 01 chip of a channel, 10 raw reading, 11 calibration.

#include "drivers/environment/environment_dracal_usbtenki.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/environment/tenki_reading.hpp"
#include "drivers/framing/byte_order.hpp"
#include "drivers/wire/link_settings.hpp"
#include "drivers/wire/usb_link.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace axiscal {
namespace {

enum Command : int {
    get_chip = 0x01,
    get_channel_count = 0x02,
    get_raw = 0x10,
    get_calibration = 0x11
};
constexpr int pt100_chip = 0x12, ms5611_pressure_chip = 0x15, ms5611_temperature_chip = 0x16;
constexpr int longest_reply = 64; ///< of the largest: 8 bytes of an RTD300, and two
constexpr int most_channels = 64;
constexpr int tries = 3;
constexpr Duration reply_patience = std::chrono::seconds{1}; ///< 1 to 50 ms are usual
constexpr Duration open_patience = std::chrono::seconds{2};

enum TenkiChannel : int { air_temperature, air_pressure, air_humidity, probe_temperature };
constexpr std::size_t channel_count = 4;

TenkiChannel channel_of(const TenkiMeasure& measure) {
    if (measure.probe) return probe_temperature;
    if (measure.kind == ChannelKind::pressure) return air_pressure;
    return measure.kind == ChannelKind::humidity ? air_humidity : air_temperature;
}

/// The chip that a channel is read from.
struct Source {
    int device_channel = 0, chip = 0, rank = 0;
};

class DracalUsbTenki final : public Instrument {
public:
    DracalUsbTenki(LinkSettings link, Duration poll_period)
        : link_settings_{std::move(link)}
        , poll_period_{poll_period}
        , channels_{{"air temperature", ChannelKind::temperature, Medium::air},
                    {"air pressure", ChannelKind::pressure, Medium::air},
                    {"air humidity", ChannelKind::humidity, Medium::air},
                    {"probe temperature", ChannelKind::temperature}} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    /// The link is owned by the awaiting frame.
    Task<Result<TimedBytes>>
    ask(UsbLink& link, InstrumentContext context, Command command, int argument);
    Task<Result<void>> survey(UsbLink& link, InstrumentContext context);
    Task<Result<void>> read_calibration(UsbLink& link, InstrumentContext context);
    Task<Result<int>> round(UsbLink& link, InstrumentContext context);
    void note_chip(int device_channel, int chip);
    [[nodiscard]] std::string chip_list() const;
    void count(Fault fault);

    LinkSettings link_settings_;
    Duration poll_period_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    std::vector<int> chips_; ///< by device channel
    std::array<std::optional<Source>, channel_count> sources_;
    TenkiCalibration calibration_;
    MonotonicTime asked_at_{}; ///< the last try of the last request
    bool refusal_told_ = false;
};

void DracalUsbTenki::count(Fault fault) {
    switch (fault) {
    case Fault::link_timeout: ++counters_.timeouts; break;
    case Fault::checksum: ++counters_.checksum_errors; break;
    case Fault::bad_frame: ++counters_.bad_frames; break;
    default: break;
    }
}

/// The content of one reply. @errors of the last try; a device that is gone is not asked again.
Task<Result<TimedBytes>>
DracalUsbTenki::ask(UsbLink& link, InstrumentContext context, Command command, int argument) {
    UsbRequest request;
    request.request = command;
    request.value = argument;
    request.length = longest_reply;
    Result<TimedBytes> answer = TimedBytes{};
    for (int tried = 0; tried < tries; ++tried) {
        asked_at_ = context.scheduler->now();
        answer = co_await link.control_in(request, asked_at_ + reply_patience);
        if (answer) {
            auto content = decode_tenki_reply(answer->bytes, command);
            if (content) {
                ++counters_.frames;
                answer->bytes = *std::move(content);
                co_return answer;
            }
            answer = tl::unexpected<Error>(content.error());
        }
        count(answer.error().fault);
        if (answer.error().fault == Fault::link_closed) break;
    }
    co_return answer;
}

void DracalUsbTenki::note_chip(int device_channel, int chip) {
    const auto measure = tenki_measure(chip);
    if (!measure) return;
    auto& source = sources_[static_cast<std::size_t>(channel_of(*measure))];
    if (!source || measure->rank < source->rank)
        source = Source{device_channel, chip, measure->rank};
}

/// " 0x11 0xff"
std::string DracalUsbTenki::chip_list() const {
    std::string list;
    for (const int chip : chips_) {
        char word[16];
        std::snprintf(word, sizeof word, " 0x%02x", static_cast<unsigned>(chip) & 0xFFU);
        list += word;
    }
    return list;
}

/// Which chips the stick has. @errors Fault::bad_frame for a number of channels that is none.
Task<Result<void>> DracalUsbTenki::survey(UsbLink& link, InstrumentContext context) {
    sources_ = {};
    chips_.clear();
    refusal_told_ = false;
    AXISCAL_CO_TRY(const TimedBytes count, co_await ask(link, context, get_channel_count, 0));
    const int channels = count.bytes.size() == 1 ? static_cast<int>(byte_at(count.bytes, 0)) : 0;
    if (channels < 1 || channels > most_channels)
        co_return fail(Fault::bad_frame,
                       link_settings_.describe() + " states no number of channels");
    for (int channel = 0; channel < channels; ++channel) {
        AXISCAL_CO_TRY(const TimedBytes chip, co_await ask(link, context, get_chip, channel));
        chips_.push_back(chip.bytes.size() == 1 ? static_cast<int>(byte_at(chip.bytes, 0)) : -1);
        note_chip(channel, chips_.back());
    }
    if (std::ranges::none_of(sources_, [](const auto& source) { return source.has_value(); }))
        co_return fail(Fault::bad_configuration,
                       link_settings_.describe() +
                           " has no chip for air or a probe:" + chip_list());
    co_return Result<void>{};
}

/// Calibration 0 is the PT100's where there is one on channel 0; the two of the MS5611 follow it.
Task<Result<void>> DracalUsbTenki::read_calibration(UsbLink& link, InstrumentContext context) {
    calibration_ = {};
    int index = 0;
    if (chips_.front() == pt100_chip) {
        AXISCAL_CO_TRY(const TimedBytes source, co_await ask(link, context, get_calibration, 0));
        if (source.bytes.size() >= 2)
            calibration_.pt100_current_A += signed16(little16(source.bytes, 0)) / 1e7;
        index = 1;
    }
    const bool has_ms5611 = std::ranges::any_of(chips_, [](int chip) {
        return chip == ms5611_pressure_chip || chip == ms5611_temperature_chip;
    });
    if (!has_ms5611) co_return Result<void>{};
    AXISCAL_CO_TRY(TimedBytes first, co_await ask(link, context, get_calibration, index));
    AXISCAL_CO_TRY(const TimedBytes second,
                   co_await ask(link, context, get_calibration, index + 1));
    first.bytes.insert(first.bytes.end(), second.bytes.begin(), second.bytes.end());
    AXISCAL_CO_TRY(calibration_.ms5611, decode_ms5611_calibration(first.bytes));
    co_return Result<void>{};
}

/// The number of chips that answered, an error of the chip being an answer.
Task<Result<int>> DracalUsbTenki::round(UsbLink& link, InstrumentContext context) {
    int answered = 0;
    bool refused = false;
    Error last;
    for (std::size_t place = 0; place < channel_count; ++place) {
        const int channel = static_cast<int>(place);
        const auto source = sources_[place];
        if (!source) {
            // A stick without a probe is no fault; one without its air sensors is.
            if (channel != probe_temperature)
                context.sink->take(Sample::bad(channel, context.scheduler->now(), Quality::absent));
            continue;
        }
        const auto raw = co_await ask(link, context, get_raw, source->device_channel);
        // A late or damaged answer says nothing about the chip: its last value only grows old.
        if (!raw) last = raw.error();
        if (!raw && raw.error().fault != Fault::refused) {
            const bool lost = last.fault == Fault::link_closed || last.fault == Fault::link_timeout;
            if (lost) co_return tl::unexpected<Error>(last);
            continue;
        }
        ++answered;
        if (!raw) {
            refused = true;
            if (!std::exchange(refusal_told_, true))
                context.sink->note(Fault::refused, last.detail);
        }
        ++counters_.samples;
        const auto value = raw ? tenki_value(source->chip, raw->bytes, calibration_) : std::nullopt;
        const MonotonicTime read_at = raw ? raw->read_at : context.scheduler->now();
        context.sink->take(sample_at(channel, placed_between(asked_at_, read_at), value));
    }
    refusal_told_ = refused;
    if (answered == 0 && last.fault != Fault::internal) co_return tl::unexpected<Error>(last);
    co_return answered;
}

Task<Result<void>> DracalUsbTenki::run(InstrumentContext context) {
    auto opened =
        co_await context.links->open_usb(link_settings_, context.scheduler->now() + open_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<UsbLink> link = *std::move(opened);
    const auto surveyed = co_await survey(*link, context);
    if (!surveyed) co_return surveyed;
    const auto calibrated = co_await read_calibration(*link, context);
    if (!calibrated) co_return calibrated;
    const UsbEntry& entry = link->entry();
    const Identity identity{"Dracal Technologies", entry.name, entry.serial, ""};
    context.sink->identify(identity);
    MonotonicTime next = context.scheduler->now();
    for (;;) {
        const auto answered = co_await round(*link, context);
        if (!answered) co_return tl::unexpected<Error>(answered.error());
        next = std::max(next + poll_period_, context.scheduler->now());
        co_await context.scheduler->sleep_until(next);
    }
}

// 1781:0a98 is shared by many makers: the product string tells. Of Dracal's own number the
// sticks of the VCP kind are none of ours: they have the class of a serial line.
const std::array tenki_ids{UsbId{0x1781, 0x0A98, "USBTenki"}, UsbId{0x1781, 0x0A98, "USB_Temp"},
                           UsbId{0x289B, 0, "", 0xFF}};

} // namespace

const Appearance dracal_usbtenki_appearance{Wire::usb, tenki_ids, false, "air", ""};

std::unique_ptr<Instrument> make_dracal_usbtenki(const InstrumentConfig& /*config*/,
                                                 Settings& options) {
    LinkSettings defaults;
    defaults.kind = LinkSettings::Kind::usb;
    defaults.usb.ids.assign(tenki_ids.begin(), tenki_ids.end());
    const LinkSettings link = read_usb_link(options, defaults);
    const Duration poll_period =
        options.duration("poll_period", std::chrono::milliseconds{100}, std::chrono::seconds{60},
                         std::chrono::milliseconds{500});
    return std::make_unique<DracalUsbTenki>(link, poll_period);
}

} // namespace axiscal
