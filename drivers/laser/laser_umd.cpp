// uMD0 / uMD1 / uMD2 "Micro Measurement Display" laser and scale counters, serial ASCII.
//
// Document: the record list and low-speed codes of the firmware and Windows GUI published in the
// repository lasersamcode "Micro-Measurement-Display-Firmware-and-Windows-GUI-for-uMD0-uMD1-and-
// uMD2", revisions read: uMD0 v09, uMD1 v60.00, uMD2 v1.26, v2.20, v2.47r, v3.15e, v264.07
// (state of 2025). "field n" is the place in a record from 0, "code n" the low-speed code, both as
// listed in docs/instruments/umd.md. Nothing here was seen on a real device yet.
//
// The instrument only sends: there is nothing to ask, to zero or to configure. Its homodyne
// firmware counts the lines of a scale as it counts fringes: one count is pitch / counts per cycle.

#include "drivers/laser/laser_umd.hpp"
#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/framing/line_framer.hpp"
#include "drivers/laser/umd_counter.hpp"
#include "drivers/wire/link_settings.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

/// 16 fields of at most 20 characters, and their separators.
constexpr std::size_t longest_record = 352;
/// One USB frame between the end of a sample period and the host.
constexpr Duration usb_frame = std::chrono::milliseconds{1};
/// Longer than a host may stall: opening the line anew costs the datum, waiting costs nothing. That
/// the laser is silent is seen by the age of its samples.
constexpr Duration patience = std::chrono::seconds{8};
constexpr std::string_view umd0_greeting = "Minimalist Homodyne Test:";

std::vector<Channel> channels_of(const UmdSetup& setup) {
    const std::string axis = "axis " + std::to_string(setup.axis);
    return {{axis, ChannelKind::displacement, Medium::none},
            {"temperature 1", ChannelKind::temperature, Medium::air},
            {"temperature 2", ChannelKind::temperature, Medium::air},
            {"pressure", ChannelKind::pressure, Medium::air},
            {"humidity", ChannelKind::humidity, Medium::air}};
}

class UmdInstrument final : public Instrument {
public:
    UmdInstrument(LinkSettings link, UmdSetup setup)
        : link_settings_{std::move(link)}
        , setup_{setup}
        , channels_{channels_of(setup)}
        , counter_{setup, counters_} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    [[nodiscard]] std::optional<Optics> optics() const override {
        if (setup_.resolution) return std::nullopt;
        return Optics{setup_.wavelength, setup_.optical_fold};
    }
    [[nodiscard]] std::optional<Length> resolution() const override { return setup_.resolution; }
    [[nodiscard]] bool incremental() const override { return true; }
    [[nodiscard]] std::uint64_t count_modulus() const override { return counter_.modulus(); }

private:
    void digest(const TimedBytes& arrived, LineFramer& framer, SampleSink& sink);
    void take_line(std::string_view line, MonotonicTime read_at, SampleSink& sink);
    void take_burst(MonotonicTime read_at, SampleSink& sink);

    LinkSettings link_settings_;
    UmdSetup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    UmdCounter counter_;
    std::vector<UmdRecord> burst_;
    MonotonicTime last_record_at_{};
};

void UmdInstrument::take_burst(MonotonicTime read_at, SampleSink& sink) {
    if (burst_.empty()) return;
    counters_.frames += burst_.size();
    last_record_at_ = read_at;
    counter_.take(burst_, read_at, sink);
    burst_.clear();
}

void UmdInstrument::take_line(std::string_view line, MonotonicTime read_at, SampleSink& sink) {
    if (const auto record = decode_umd_record(line)) {
        burst_.push_back(*record);
    } else if (line == umd0_greeting) {
        take_burst(read_at, sink);
        counter_.greeted(sink);
    } else if (!line.empty()) {
        ++counters_.bad_frames;
    }
}

void UmdInstrument::digest(const TimedBytes& arrived, LineFramer& framer, SampleSink& sink) {
    const auto oversized = framer.feed(
        arrived.bytes, [&](std::string_view line) { take_line(line, arrived.read_at, sink); });
    counters_.bad_frames += oversized;
    take_burst(arrived.read_at, sink);
}

Task<Result<void>> UmdInstrument::run(InstrumentContext context) {
    const MonotonicTime begin = context.scheduler->now();
    auto opened = co_await context.links->open(link_settings_, begin + patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    if (!link->remark().empty()) context.sink->note(Fault::none, link->remark());
    counter_.opened(usb_frame + link->latency_uncertainty());
    LineFramer framer{longest_record, true};
    last_record_at_ = context.scheduler->now();
    for (;;) {
        const auto arrived = co_await link->read_some(context.scheduler->now() + patience);
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        digest(*arrived, framer, *context.sink);
        if (arrived->read_at - last_record_at_ > patience)
            co_return fail(Fault::bad_frame,
                           "data but no uMD record on " + link_settings_.describe());
    }
}

std::optional<UmdPhase> read_phase(Settings& options) {
    const auto text =
        options.choice("phase", {"auto", "none", "8 bit", "16 bit", "v3.15", "uMD1"}, "auto");
    if (text == "none") return UmdPhase::none;
    if (text == "8 bit") return UmdPhase::eight_bit;
    if (text == "16 bit") return UmdPhase::sixteen_bit;
    if (text == "v3.15") return UmdPhase::truncated;
    if (text == "uMD1") return UmdPhase::masked;
    return std::nullopt;
}

void read_laser(Settings& options, UmdSetup& setup) {
    setup.wavelength = options.length("wavelength", nm(400), nm(1600), nm(633));
    setup.optical_fold =
        options.choice("fold", {"corner cube", "plane mirror"}) == "plane mirror" ? 4 : 2;
    if (options.has("counts_per_cycle"))
        setup.counts_per_cycle = static_cast<int>(options.integer("counts_per_cycle", 1, 255));
    if (options.has("head"))
        setup.head = options.choice("head", {"homodyne", "heterodyne"}) == "homodyne"
                         ? UmdHead::homodyne
                         : UmdHead::heterodyne;
    setup.phase = read_phase(options);
}

/// The length of one count says everything of a scale: what belongs to a laser is refused beside
/// it.
void read_scale(Settings& options, UmdSetup& setup) {
    setup.resolution = options.length("resolution", nm(0.01), mm(1));
    setup.head = UmdHead::homodyne;
    setup.phase = UmdPhase::none;
    for (const char* key : {"wavelength", "fold", "counts_per_cycle", "head", "phase"})
        if (options.has(key))
            options.refuse(key, "belongs to a laser, resolution (length of one count) to a scale: "
                                "state one of them");
}

/// A scale by its resolution, or a laser by its wavelength: one of them.
UmdSetup read_setup(Settings& options) {
    UmdSetup setup;
    const bool scale = options.has("resolution");
    if (!scale && !options.has("wavelength"))
        options.refuse("wavelength", "is missing: state it for a laser (in vacuum), or resolution "
                                     "(length of one count) for a scale");
    if (scale)
        read_scale(options, setup);
    else
        read_laser(options, setup);
    setup.axis = static_cast<int>(options.integer("axis", 1, 3, 1));
    setup.fastest =
        options.speed("fastest", mm_per_minute(1), metre_per_second(20), metre_per_second(1));
    return setup;
}

// The firmware does not state them. Teensy (uMD2): usb.ids. chipKIT DP32 (uMD1) [N]: the default of
// the published chipKIT-core (HardwareSerial_cdcacm.c), without serial number; a board with another
// core may show another. Arduino Nano (uMD0) [N]: its FTDI or CH340.
const std::array umd_ids{UsbId{0x16C0, 0x0483}, UsbId{0x0403, 0xA662}, UsbId{0x0403, 0x6001},
                         UsbId{0x1A86, 0x7523}};

} // namespace

const Appearance umd_appearance{
    Wire::serial, umd_ids, false, "laser",
    "wavelength = \"632.991354 nm\"   # in vacuum: write that of the laser's certificate\n"
    "fold = \"corner cube\"           # or \"plane mirror\"\n"};

std::unique_ptr<Instrument> make_umd(const InstrumentConfig& /*config*/, Settings& options) {
    LinkSettings defaults; // USB: the rate matters on the uMD0 only
    const LinkSettings link = read_link(options, defaults);
    return std::make_unique<UmdInstrument>(link, read_setup(options));
}

} // namespace axiscal
