// Lasertex HPI-3D, sold by Status Pro as uLine-f1, too: laser interferometer with sensors of air
// and material, binary frames on a serial line.
//
// Document: the maker publishes none of the wire. The public reader l-pio/pylinef1, commit ba679cd,
// state of 2022 (MIT): facts of the wire only. Nothing here was seen on a real device yet.
//
// [line]     3 Mbaud, 8N1, no handshake
// [frame]    to the laser: AA, command (2 bytes), data (4), checksum: 8 bytes. From it: AA, command
//            (2), data (12), checksum: 16 bytes. CRC-8, polynomial 31, begun with FF, over all that
//            is before it. The high byte comes first, numbers are two's complement.
// [command]  B0 32 distance on, B0 35 velocity off, B0 79 sensors on; the laser measures either
//            distance or velocity. B0 3D and B0 3F delete the flags of a weak signal and of
//            overspeed, which stand until then. Each is answered by a frame of the same command.
// [distance] B0 15: bytes 0 to 6 position in 100 pm; 7 and 8 not known; 9 to 11 [signal]
// [velocity] B0 16: bytes 0 to 3 in 100 nm/s; 9 to 11 [signal]
// [signal]   byte 9 bit 3 overspeed; byte 10 bit 0 laser ready, bit 3 signal strong enough; byte 11
//            level without a unit. The other bits are not known.
// [meteo]    B0 0A: byte 0 sensor (0 air, others material), 1 and 2 temperature in 0.01 degC, 3
//            humidity in %, 4 battery, 5 radio link, 6 and 7 pressure in 10 Pa
// [rate]     distance 25 Hz, each sensor 1 Hz
//
// Not known: whether a position is corrected for air already (the station file must state it),
// bytes 7 and 8, the fast ("dynamic") mode, what a laser sends that has just been switched on.
// The position is never zeroed from here.

#include "drivers/laser/laser_lasertex.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/laser/lasertex_reading.hpp"
#include "drivers/wire/link_settings.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr int lasertex_baud = 3'000'000;
/// Longer than a host may stall: opening the line anew costs the datum, waiting costs nothing.
constexpr Duration patience = std::chrono::seconds{8};
/// An acknowledgement is a frame among 25 a second.
constexpr Duration answer_patience = std::chrono::seconds{1};
constexpr int tries = 3;
/// One USB frame between a whole frame and the host.
constexpr Duration usb_frame = std::chrono::milliseconds{1};
/// The stream comes first: a frame counts when another one stands behind it.
constexpr std::array start_commands{LasertexCommand::distance_on, LasertexCommand::velocity_off,
                                    LasertexCommand::meteo_on, LasertexCommand::forget_overspeed,
                                    LasertexCommand::forget_weak_signal};

struct LasertexSetup {
    LinkSettings link;
    std::optional<Length> wavelength; ///< of a raw position; empty: it is compensated
    Speed fastest;
};

std::vector<Channel> lasertex_channels() {
    std::vector<Channel> channels{{"axis 1", ChannelKind::displacement, Medium::none},
                                  {"level", ChannelKind::strength, Medium::none},
                                  {"air temperature", ChannelKind::temperature, Medium::air},
                                  {"air pressure", ChannelKind::pressure, Medium::air},
                                  {"air humidity", ChannelKind::humidity, Medium::air}};
    for (const char* number : {"1", "2", "3"})
        channels.push_back({std::string{"material "} + number, ChannelKind::temperature,
                            Medium::none}); // a sensor of either kind may lie anywhere
    return channels;
}

class Lasertex final : public Instrument {
public:
    explicit Lasertex(LasertexSetup setup)
        : setup_{std::move(setup)}
        , channels_{lasertex_channels()}
        , reading_{setup_.fastest, counters_} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    [[nodiscard]] std::optional<Optics> optics() const override {
        if (!setup_.wavelength) return std::nullopt;
        return Optics{*setup_.wavelength, 2};
    }
    [[nodiscard]] bool incremental() const override { return true; }

private:
    Task<Result<void>> begin();
    Task<Result<void>> order(LasertexCommand command);
    Task<Result<void>> await_acknowledgement(LasertexCommand command, MonotonicTime end);
    Task<Result<void>> measure();
    void digest(const TimedBytes& arrived);
    void hear(const LasertexArrival& arrival);

    LasertexSetup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    LasertexReading reading_;
    // Of one connection:
    InstrumentContext context_{};
    std::unique_ptr<ByteLink> link_;
    LasertexFramer framer_;
    std::optional<LasertexCommand> acknowledged_;
    bool introduced_ = false;
};

/// It tells neither serial number nor firmware.
void Lasertex::hear(const LasertexArrival& arrival) {
    if (!introduced_ && arrival.message)
        context_.sink->identify(Identity{"Lasertex", "HPI-3D", "", ""});
    introduced_ = introduced_ || arrival.message.has_value();
    if (!arrival.message) return;
    if (const auto* answer = std::get_if<LasertexAcknowledgement>(&*arrival.message))
        acknowledged_ = answer->command;
}

void Lasertex::digest(const TimedBytes& arrived) {
    const auto arrivals = framer_.feed(arrived.bytes, arrived.read_at);
    counters_.frames += arrivals.size();
    counters_.bad_frames += framer_.take_damaged();
    for (const LasertexArrival& arrival : arrivals)
        hear(arrival);
    reading_.take(arrivals, *context_.sink);
}

/// Ends well at the deadline, too: `acknowledged_` tells. A stream that never pauses ends it, too.
Task<Result<void>> Lasertex::await_acknowledgement(LasertexCommand command, MonotonicTime end) {
    while (acknowledged_ != command) {
        const auto arrived = co_await link_->read_some(end);
        const bool silent = !arrived && arrived.error().fault == Fault::link_timeout;
        if (silent) ++counters_.timeouts;
        if (silent) break;
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        digest(*arrived);
        if (arrived->read_at >= end) break;
    }
    co_return Result<void>{};
}

Task<Result<void>> Lasertex::order(LasertexCommand command) {
    const std::uint64_t frames_before = counters_.frames;
    for (int nth = 0; nth < tries; ++nth) {
        acknowledged_.reset();
        const MonotonicTime end = context_.scheduler->now() + answer_patience;
        const auto written = co_await link_->write_all(lasertex_request(command), end);
        if (!written) co_return tl::unexpected<Error>(written.error());
        const auto heard = co_await await_acknowledgement(command, end);
        if (!heard) co_return heard;
        if (acknowledged_ == command) co_return Result<void>{};
    }
    const bool mute = counters_.frames == frames_before;
    co_return fail(
        mute ? Fault::link_timeout : Fault::refused,
        (mute ? "no frame of an HPI-3D on " : "the laser sends, but acknowledges no command on ") +
            setup_.link.describe());
}

Task<Result<void>> Lasertex::begin() {
    for (const LasertexCommand command : start_commands) {
        const auto done = co_await order(command);
        if (!done) co_return done;
    }
    reading_.begin();
    co_return Result<void>{};
}

Task<Result<void>> Lasertex::measure() {
    for (;;) {
        const auto arrived = co_await link_->read_some(context_.scheduler->now() + patience);
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        digest(*arrived);
        if (arrived->read_at - reading_.last_distance_at() > patience)
            co_return fail(Fault::bad_frame,
                           "data but no distance of an HPI-3D on " + setup_.link.describe());
        const auto command = reading_.to_forget();
        if (!command) continue;
        const MonotonicTime end = context_.scheduler->now() + answer_patience;
        const auto written = co_await link_->write_all(lasertex_request(*command), end);
        if (!written) co_return tl::unexpected<Error>(written.error());
    }
}

Task<Result<void>> Lasertex::run(InstrumentContext context) {
    context_ = context;
    auto opened = co_await context.links->open(setup_.link, context.scheduler->now() + patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    link_ = *std::move(opened);
    if (!link_->remark().empty()) context.sink->note(Fault::none, link_->remark());
    framer_ = LasertexFramer{};
    introduced_ = false;
    reading_.opened(context.scheduler->now(), usb_frame + link_->latency_uncertainty());
    auto done = co_await begin();
    if (done) done = co_await measure();
    link_.reset();
    co_return done;
}

/// No default: a position that is corrected twice, or never, is wrong by 0.27 mm in a metre, and
/// the frame does not tell.
void read_position(Settings& options, LasertexSetup& setup) {
    const bool raw = options.choice("position", {"raw", "compensated"}) == "raw";
    if (raw || options.refused("position") || !options.has("position")) {
        setup.wavelength = options.length("wavelength", nm(400), nm(1600));
        return;
    }
    if (options.has("wavelength"))
        options.refuse("wavelength", "belongs to a raw position, which is corrected for air here: "
                                     "leave it out beside \"compensated\"");
}

} // namespace

// No USB numbers: the document names none.
const Appearance lasertex_appearance{
    Wire::serial,
    {},
    false,
    "laser",
    "position = \"raw\"                # or \"compensated\": as it is set in the laser's program\n"
    "wavelength = \"632.991354 nm\"    # in vacuum: write that of the laser's certificate\n"};

std::unique_ptr<Instrument> make_lasertex(const InstrumentConfig& /*config*/, Settings& options) {
    LasertexSetup setup;
    LinkSettings defaults;
    defaults.baud = lasertex_baud;
    setup.link = read_link(options, defaults);
    read_position(options, setup);
    setup.fastest =
        options.speed("fastest", mm_per_minute(1), metre_per_second(20), metre_per_second(1));
    return std::make_unique<Lasertex>(std::move(setup));
}

} // namespace axiscal
