// Linear transducers of the CANopen profile CiA 406 (Temposonics E-series) as a ballbar or gauge: a
// position every millisecond.
//
// Documents: MTS Temposonics E-series CANopen, operation manual (document 551449), cited as
// [mts]; CiA 406 V3.2, encoders. Nothing here was seen on a real device yet.
//
// [mts]  node number 127 when delivered, no heartbeat until it is set. TPDO1 by time, every
//        millisecond: 0x6020:1 position (32 bits, the low byte first), 0x6030:1 velocity (16 bits),
//        0x6400:1 work area; the manual shows it with and without the last byte. 0x6005:1 is the
//        step in nanometres. A missing magnet is told by an emergency and 0x6503.
//
// What the PDOs hold and the step are read from the device itself. Its samples have no number: what
// is missing is found by time (pdo_stream.hpp).

#include "drivers/ballbar/ballbar_canopen_406.hpp"

#include "analysis/quantity/counted.hpp"
#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/ballbar/cia406_position.hpp"
#include "drivers/canopen/pdo_stream.hpp"
#include "drivers/wire/link_settings.hpp"

#include <array>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

constexpr int mts_node = 127;
constexpr std::array step_keys{cia406_step_key, cia406_single_step_key};
/// The position is that of the measuring cycle before; the frame is on the wire for 0.1 to 0.5 ms
/// [N].
constexpr Duration latency = std::chrono::milliseconds{1};
/// The kernel stamps and keeps the frames; fetching each by itself would cost ten times as much.
constexpr Duration rest = std::chrono::milliseconds{4};

struct Cia406Setup {
    CanOpenSetup bus;
    std::optional<Length> step; ///< as the station file states it; empty: as the device tells
    bool reversed = false, heed_area = true;
};

class CanOpen406 final : public Instrument {
public:
    explicit CanOpen406(Cia406Setup setup)
        : setup_{std::move(setup)}
        , channels_{{"ballbar", ChannelKind::displacement, Medium::none}}
        , session_{setup_.bus, counters_}
        , stream_{setup_.bus.sample_period} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<void>> serve(InstrumentContext context);
    Task<Result<double>> read_step();
    Task<Result<void>> find_position();
    void hand_up(const std::vector<PdoStream::Numbered>& settled, SampleSink& sink);
    void count_losses(SampleSink& sink);

    Cia406Setup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    CanOpenSession session_;
    PdoStream stream_;
    Cia406Position position_;
    std::uint32_t epoch_ = 0;
    bool begun_ = false;
};

/// Metres.
Task<Result<double>> CanOpen406::read_step() {
    constexpr double nanometre = 1e-9;
    const double sign = setup_.reversed ? -1 : 1;
    if (setup_.step) co_return sign* setup_.step->si();
    for (const ObjectKey key : step_keys) {
        const auto step_nm = co_await session_.node().read_number(key);
        if (step_nm && *step_nm > 0) co_return sign** step_nm* nanometre;
        if (!step_nm && step_nm.error().fault != Fault::refused)
            co_return tl::unexpected<Error>(step_nm.error());
    }
    co_return fail(Fault::bad_configuration,
                   session_.node().name() + " does not tell its step in " +
                       name_of(cia406_step_key) + ": set position_step in the station file");
}

Task<Result<void>> CanOpen406::find_position() {
    if (is_rotary_encoder(session_.device_type()))
        co_return fail(Fault::bad_configuration,
                       session_.node().name() + " is a rotary encoder, no transducer of length");
    AXISCAL_CO_TRY(position_, find_cia406_position(session_.layouts()));
    AXISCAL_CO_TRY(position_.metres_per_step, co_await read_step());
    position_.heed_area = setup_.heed_area;
    co_return Result<void>{};
}

void CanOpen406::count_losses(SampleSink& sink) {
    const std::uint64_t lost = stream_.lost() - counters_.lost_records;
    if (lost == 0) return;
    counters_.lost_records += lost;
    ++counters_.gaps;
    sink.note(Fault::samples_lost, counted(static_cast<long>(lost), "position of the stream is",
                                           "positions of the stream are") +
                                       " missing");
}

void CanOpen406::hand_up(const std::vector<PdoStream::Numbered>& settled, SampleSink& sink) {
    using Why = Cia406Reading::Why;
    count_losses(sink);
    const PdoLayout& layout = session_.layouts()[position_.layout];
    for (const PdoStream::Numbered& one : settled) {
        const auto reading = read_cia406_position(position_, layout, one.arrival.frame);
        const MonotonicTime at = one.at - latency;
        if (reading.why == Why::short_frame) session_.take_short_frame();
        ++counters_.samples;
        const bool good = reading.metres && !one.arrival.in_error;
        const Quality why = one.arrival.in_error ? Quality::signal_error : Quality::absent;
        Sample sample = good ? Sample{0, at, *reading.metres, one.number, epoch_}
                             : Sample::bad(0, at, why, one.number, epoch_);
        sample.time_uncertainty = latency;
        sink.take(sample);
    }
}

Task<Result<void>> CanOpen406::serve(InstrumentContext context) {
    const auto opened = co_await session_.open(context);
    if (!opened) co_return opened;
    const auto found = co_await find_position();
    if (!found) co_return found;
    std::vector<std::size_t> used{position_.layout};
    const auto started = co_await session_.start(std::move(used));
    if (!started) co_return started;
    if (std::exchange(begun_, true)) {
        ++epoch_;
        ++counters_.restarts;
    }
    stream_.restart();
    for (;;) {
        const auto arrived = co_await session_.next();
        if (!arrived) {
            hand_up(stream_.finish(), *context.sink);
            co_return tl::unexpected<Error>(arrived.error());
        }
        for (const PdoArrival& arrival : *arrived)
            hand_up(stream_.take(arrival), *context.sink);
    }
}

Task<Result<void>> CanOpen406::run(InstrumentContext context) {
    auto ended = co_await serve(context);
    session_.close();
    co_return ended;
}

} // namespace

const Appearance canopen_406_appearance{
    Wire::can,
    {},
    false,
    "ballbar",
    "node = 127                     # its node number on the bus\n"};

std::unique_ptr<Instrument> make_canopen_406(const InstrumentConfig& /*config*/,
                                             Settings& options) {
    using namespace std::chrono_literals;
    Cia406Setup setup;
    setup.bus.link = read_can_link(options);
    setup.bus.node = static_cast<int>(options.integer("node", 1, 127, mts_node));
    setup.bus.profile = cia406_profile;
    setup.bus.sample_period = options.duration("sample_period", 1ms, 100ms, 1ms);
    if (setup.bus.sample_period % 1ms != Duration::zero())
        options.refuse("sample_period", "whole milliseconds: a CANopen timer has no finer step");
    setup.bus.rest = rest;
    if (options.has("position_step")) setup.step = options.length("position_step", mm(1e-6), mm(1));
    setup.reversed = options.flag("reversed", false);
    setup.heed_area = options.choice("work_area", {"heeded", "ignored"}, "heeded") == "heeded";
    return std::make_unique<CanOpen406>(std::move(setup));
}

} // namespace axiscal
