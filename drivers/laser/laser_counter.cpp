// Any laser or scale with A-quad-B signals on a counter that the Linux kernel knows.
//
// Document: Linux, include/uapi/linux/counter.h and Documentation/driver-api/generic-counter.rst,
// kernel 6.1. Nothing here was seen on a real device or a kernel with this subsystem: Debian's own
// kernels are built without it.
//
// [event]  read() gives whole struct counter_event, 24 bytes: timestamp and value of 64 bits, the
//          watch (component type, scope, parent, id; event; channel), status, one byte to fill.
//          The timestamp is CLOCK_MONOTONIC.
// [watch]  ADD_WATCH for the count (type COUNT, scope COUNT, its number as parent) on an event,
// then
//          ENABLE.
//
// There is a sample for each event and none between. A count of an incremental encoder knows
// nothing of where it was before: each opening is a new epoch.

#include "drivers/laser/laser_counter.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/laser/counter_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <linux/counter.h>
#include <utility>

namespace axiscal {
namespace {

/// A timestamp further away from its arrival is of another clock.
constexpr Duration clock_tolerance = std::chrono::seconds{10};
/// The kernel stamps in the interrupt of the event: a latched count is older than its stamp by the
/// latency of the interrupt, one that is read there is younger by the reading. Taken as +-50 us,
/// rectangular [N]: u(t) = 50 us / sqrt(3).
constexpr Duration stamp_uncertainty = std::chrono::nanoseconds{28'868};
constexpr Duration open_patience = std::chrono::seconds{2};

struct EventName {
    std::string_view name;
    std::uint8_t event;
};
constexpr std::array event_names{
    EventName{"change of state", COUNTER_EVENT_CHANGE_OF_STATE},
    EventName{"index", COUNTER_EVENT_INDEX},
    EventName{"capture", COUNTER_EVENT_CAPTURE},
    EventName{"threshold", COUNTER_EVENT_THRESHOLD},
};

struct CounterSetup {
    LinkSettings link;
    std::uint8_t count = 0, event = COUNTER_EVENT_INDEX;
    int bits = 32, sign = 1;
    double metres_per_count = 0;
    std::optional<Instrument::Optics> optics; ///< of a laser; a scale has none
    Speed fastest;
    Duration silence{};
};

class Counter final : public Instrument {
public:
    explicit Counter(CounterSetup setup)
        : setup_{std::move(setup)}
        , channels_{{"axis 1", ChannelKind::displacement}}
        , unwrapper_{setup_.bits} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    [[nodiscard]] std::optional<Optics> optics() const override { return setup_.optics; }
    [[nodiscard]] std::optional<Length> resolution() const override {
        if (setup_.optics) return std::nullopt;
        return metre(setup_.metres_per_count);
    }
    [[nodiscard]] bool incremental() const override { return true; }

private:
    void take(const CounterRecord& record, MonotonicTime read_at, SampleSink& sink);
    [[nodiscard]] bool is_ours(const CounterRecord& record) const;
    PlacedTime instant_of(const CounterRecord& record, MonotonicTime read_at, SampleSink& sink);
    void judge_jump(double metres, MonotonicTime at, SampleSink& sink);

    CounterSetup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    CountUnwrapper unwrapper_;
    std::uint32_t epoch_ = 0;
    bool counted_before_ = false, clock_told_ = false, unread_ = false;
    std::optional<double> last_metres_;
    MonotonicTime last_at_{};
    Duration asleep_{}; ///< of the computer; each reading of it is at most the truth
};

bool Counter::is_ours(const CounterRecord& record) const {
    return record.component_type == COUNTER_COMPONENT_COUNT &&
           record.scope == COUNTER_SCOPE_COUNT && record.parent == setup_.count &&
           record.event == setup_.event;
}

/// Of another clock's events nothing is known but that they were before their arrival: no u(t).
PlacedTime
Counter::instant_of(const CounterRecord& record, MonotonicTime read_at, SampleSink& sink) {
    // The kernel stamps by CLOCK_MONOTONIC, which a suspend stops.
    const MonotonicTime stamped = monotonic_from_ns(record.at_ns) + asleep_;
    const Duration away = read_at > stamped ? read_at - stamped : stamped - read_at;
    if (away <= clock_tolerance) return {stamped, stamp_uncertainty};
    if (!std::exchange(clock_told_, true))
        sink.note(Fault::bad_frame, "the counter stamps its events by another clock: the time of "
                                    "their arrival is used");
    return {read_at, Duration{}};
}

void Counter::judge_jump(double metres, MonotonicTime at, SampleSink& sink) {
    if (last_metres_) {
        const double way_m = std::abs(metres - *last_metres_) - setup_.metres_per_count;
        if (way_m > setup_.fastest.in(metre_per_second)*seconds_of(at - last_at_)) {
            ++epoch_;
            sink.note(Fault::implausible_jump, "the count jumped further than the axis can move");
        }
    }
    last_metres_ = metres;
    last_at_ = at;
}

void Counter::take(const CounterRecord& record, MonotonicTime read_at, SampleSink& sink) {
    if (!is_ours(record)) {
        ++counters_.bad_frames;
        return;
    }
    ++counters_.frames;
    ++counters_.samples;
    const auto [at, uncertainty] = instant_of(record, read_at, sink);
    if (record.status != 0) {
        if (!std::exchange(unread_, true))
            sink.note(Fault::signal_error, "the kernel could not read the counter (error " +
                                               std::to_string(record.status) + ")");
        return sink.take(Sample::bad(0, at, Quality::signal_error, 0, epoch_));
    }
    unread_ = false;
    const auto counts = static_cast<double>(unwrapper_.unwrap(record.value));
    const double metres = setup_.sign * counts * setup_.metres_per_count;
    judge_jump(metres, at, sink);
    counted_before_ = true;
    Sample sample{0, at, metres, 0, epoch_};
    sample.time_uncertainty = uncertainty;
    sink.take(sample);
}

Task<Result<void>> Counter::run(InstrumentContext context) {
    const MonotonicTime latest = context.scheduler->now() + open_patience;
    auto opened = co_await context.links->open(setup_.link, latest);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    context.sink->identify(Identity{"Linux", "counter", "", ""});
    unwrapper_ = CountUnwrapper{setup_.bits};
    last_metres_.reset();
    clock_told_ = unread_ = false;
    if (std::exchange(counted_before_, false)) ++epoch_;
    CounterFramer framer;
    for (;;) {
        const MonotonicTime deadline = context.scheduler->now() + setup_.silence;
        const auto arrived = co_await link->read_some(deadline);
        // A standing axis makes no events; opening anew would cost the zero.
        if (!arrived && arrived.error().fault == Fault::link_timeout) {
            ++counters_.timeouts;
            continue;
        }
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        asleep_ = std::max(asleep_, context.scheduler->asleep());
        for (const CounterRecord& record : framer.feed(arrived->bytes))
            take(record, arrived->read_at, *context.sink);
    }
}

std::uint8_t read_event(Settings& options) {
    std::vector<std::string> names;
    names.reserve(event_names.size());
    for (const EventName& row : event_names)
        names.emplace_back(row.name);
    const std::string wanted = options.choice("event", names);
    const auto row = std::ranges::find(event_names, wanted, &EventName::name);
    return row == event_names.end() ? std::uint8_t{COUNTER_EVENT_INDEX} : row->event;
}

/// A scale by its resolution, or a laser by its wavelength: one of them.
void read_scale(Settings& options, CounterSetup& setup) {
    const bool scale = options.has("resolution"), laser = options.has("wavelength");
    if (scale == laser)
        options.refuse(scale ? "wavelength" : "resolution",
                       "state one of them: resolution for a scale (length of one count), "
                       "wavelength for a laser");
    const Length count = options.length("resolution", nm(0.01), mm(1), um(1));
    const Length wavelength = options.length("wavelength", nm(400), nm(1600), nm(633));
    const double fold =
        options.choice("fold", {"corner cube", "plane mirror"}, "corner cube") == "plane mirror"
            ? 4
            : 2;
    const auto per_cycle = static_cast<double>(options.integer(
        "counts_per_cycle", 1, 65536, laser ? std::nullopt : std::optional{std::int64_t{4}}));
    setup.metres_per_count =
        laser ? wavelength.si() / (fold * std::max(per_cycle, 1.0)) : count.si();
    if (laser) setup.optics = Instrument::Optics{wavelength, fold};
}

} // namespace

const Appearance counter_appearance{
    Wire::counter,
    {},
    false,
    "laser",
    "event = \"capture\"              # what makes the counter record\n"
    "bits = 32                      # of the counter\n"
    "wavelength = \"632.991354 nm\"   # in vacuum: write that of the laser's certificate\n"
    "fold = \"plane mirror\"          # or \"corner cube\"\n"
    "counts_per_cycle = 4           # of the quadrature\n"
    "fastest = \"30 m/min\"           # the axis cannot move faster\n"};

std::unique_ptr<Instrument> make_counter(const InstrumentConfig& /*config*/, Settings& options) {
    CounterSetup setup;
    setup.link.kind = LinkSettings::Kind::counter;
    setup.link.path = options.text("device");
    setup.count = static_cast<std::uint8_t>(options.integer("count", 0, 255, 0));
    setup.event = read_event(options);
    const auto channel = static_cast<std::uint8_t>(options.integer("event_channel", 0, 255, 0));
    setup.link.watch = {
        COUNTER_COMPONENT_COUNT, COUNTER_SCOPE_COUNT, setup.count, 0, setup.event, channel};
    setup.bits = static_cast<int>(options.integer("bits", 8, 64));
    read_scale(options, setup);
    setup.sign = options.choice("counting", {"normal", "reversed"}, "normal") == "normal" ? 1 : -1;
    setup.fastest =
        options.speed("fastest", mm_per_minute(1), metre_per_second(100), metre_per_second(1));
    setup.silence = options.duration("silence", std::chrono::milliseconds{100},
                                     std::chrono::hours{1}, std::chrono::seconds{10});
    return std::make_unique<Counter>(std::move(setup));
}

} // namespace axiscal
