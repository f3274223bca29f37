#include "acquisition/live/supervisor.hpp"

#include "analysis/quantity/valid_text.hpp"
#include "analysis/record/channel_correction.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/wire/arrival.hpp"
#include "drivers/wire/can_link.hpp"
#include "drivers/wire/usb_link.hpp"

#include <algorithm>
#include <exception>
#include <set>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration first_pause = std::chrono::milliseconds{250};
constexpr Duration longest_pause = std::chrono::seconds{2}; // a cable is back within 5 s
/// Of a device that is not there and whose coming is told: in case it is not told after all.
constexpr Duration look_all_the_same = std::chrono::minutes{5};
constexpr Duration between_notes = std::chrono::seconds{2};
constexpr Duration silence = std::chrono::seconds{10}; // slowest sensor reports every few seconds

/// The way to the links, which remembers what could not be opened. The first place decides: a
/// driver that asks several devices for their serial number ends at a place where nothing is.
class TrackedOpener final : public LinkOpener, public ClosedLineListener {
public:
    explicit TrackedOpener(LinkOpener& links)
        : links_{links} {}
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime deadline) override {
        auto opened = co_await links_.open(settings, deadline);
        remember(settings, opened.has_value());
        co_return opened;
    }
    Task<Result<std::unique_ptr<UsbLink>>> open_usb(const LinkSettings& settings,
                                                    MonotonicTime deadline) override {
        auto opened = co_await links_.open_usb(settings, deadline);
        remember(settings, opened.has_value());
        co_return opened;
    }
    Task<Result<std::unique_ptr<CanLink>>> open_can(const LinkSettings& settings,
                                                    MonotonicTime deadline) override {
        auto opened = co_await links_.open_can(settings, deadline);
        remember(settings, opened.has_value());
        co_return opened;
    }
    void missed(const LinkSettings& settings) override { remember(settings, false); }
    [[nodiscard]] ModbusBuses* modbus_buses() override { return links_.modbus_buses(); }

    [[nodiscard]] const std::optional<LinkSettings>& missing() const { return missing_; }
    void forget() {
        missing_.reset();
        tried_ = false;
    }

private:
    void remember(const LinkSettings& settings, bool opened) {
        if (opened)
            missing_.reset();
        else if (!tried_)
            missing_ = settings;
        tried_ = true;
    }
    LinkOpener& links_;
    bool tried_ = false;
    std::optional<LinkSettings> missing_; ///< of the first opening, where all failed
};

/// A tape and its player, in the place of an instrument's link.
struct SeatedTape {
    SeatedTape(Scheduler& scheduler, Tape of)
        : tape{std::move(of)}
        , player{scheduler, tape} {}
    SeatedTape(const SeatedTape&) = delete;
    SeatedTape& operator=(const SeatedTape&) = delete;
    ~SeatedTape() = default;

    Tape tape;
    TapePlayer player;
};

const ChannelConfig* find_stated(const InstrumentConfig& config, const std::string& channel) {
    const auto found = std::ranges::find(config.channels, channel, &ChannelConfig::channel);
    return found == config.channels.end() ? nullptr : &*found;
}

} // namespace

std::string_view name_of(InstrumentState state) {
    switch (state) {
    case InstrumentState::unavailable: return "unavailable";
    case InstrumentState::available: return "available";
    case InstrumentState::faulty: return "faulty";
    }
    return "?";
}

std::string_view shown_state(const InstrumentView& view) {
    const bool plays = !view.tape.empty() && view.state == InstrumentState::available;
    return plays ? "tape" : name_of(view.state);
}

bool StationChannel::certified() const {
    const ChannelCalibration& c = calibration;
    return !c.certificate_number.empty() || !c.calibrated_on.empty() || !c.due_on.empty() ||
           c.expanded_uncertainty || c.expanded_uncertainty_per_m || !c.corrections.empty();
}

std::vector<StationChannel> station_channels(const InstrumentConfig& config,
                                             const Instrument& instrument,
                                             int index,
                                             int first_id) {
    std::vector<StationChannel> channels;
    for (const Channel& channel : instrument.channels()) {
        StationChannel entry;
        entry.id = first_id++;
        entry.instrument = index;
        entry.name = entry.shown = channel.name;
        entry.instrument_name = config.name;
        entry.kind = channel.kind;
        entry.medium = channel.medium;
        if (const ChannelConfig* stated = find_stated(config, channel.name)) {
            if (!stated->name.empty()) entry.shown = stated->name;
            entry.place = stated->place;
            entry.correction = stated->correction;
            entry.calibration = stated->calibration;
            entry.calibration.channel = entry.id;
            entry.medium = stated->medium.value_or(channel.medium);
        }
        channels.push_back(std::move(entry));
    }
    return channels;
}

/// One instrument, its view and the sink through which it speaks.
struct Supervisor::Seat final : SampleSink {
    Seat(Supervisor& owner, std::unique_ptr<Instrument> of, std::unique_ptr<SeatedTape> played)
        : supervisor{owner}
        , tape{std::move(played)}
        , links{tape ? static_cast<LinkOpener&>(tape->player) : owner.links_}
        , instrument{std::move(of)} {}

    void take(const Sample& sample) override {
        const MonotonicTime now = supervisor.scheduler_.now();
        const auto value = sample.value();
        if (value) last_good = now;
        last_sample = now;
        const int id = first_channel + sample.channel;
        const StationChannel& channel = supervisor.channels_[static_cast<std::size_t>(id)];
        const Sample forwarded =
            sample.corrected(channel.id, value ? correction_for(channel, *value) : 0);
        if (value) supervisor.set_state(*this, InstrumentState::available);
        supervisor.listener_.on_sample(forwarded);
    }
    /// The certificate's constant, or its table; told once where the table ends.
    double correction_for(const StationChannel& channel, double value) {
        const auto& points = channel.calibration.corrections;
        if (beyond_certificate(points, value) && told_beyond.insert(channel.id).second)
            note(Fault::none, "\"" + channel.name +
                                  "\" reads beyond the table of its certificate: "
                                  "the correction at its end is used");
        return channel.correction + correction_at(points, value);
    }
    /// Here and in note() and end_with() an instrument's own words enter: bytes of a wire.
    void identify(const Identity& identity) override {
        view.identity = {valid_text(identity.maker), valid_text(identity.model),
                         valid_text(identity.serial), valid_text(identity.firmware)};
    }
    /// What ended a connection that had given values is told however soon it comes after another
    /// note. What only one try of the outage met, an adapter that has not let go yet, is none of
    /// its reasons; and that nothing answers is one, in whatever words the next try says it.
    void end_with(const Error& error) {
        std::string sentence = valid_text(describe(error));
        const bool stays = std::exchange(ended_with, sentence) == sentence;
        const bool still_silent =
            error.fault == Fault::link_timeout && told_fault == Fault::link_timeout;
        const bool begins = !std::exchange(outage_told, true);
        if (begins) told_at.reset();
        if (begins || (stays && !still_silent)) {
            note(error.fault, std::move(sentence));
            kept_is_outage = true;
            return;
        }
        keep(error.fault, std::move(sentence));
        kept_is_outage = true;
        ++view.repeats;
    }
    void keep(Fault fault, std::string sentence) {
        view.last_fault = fault;
        view.last_note = std::move(sentence);
    }
    [[nodiscard]] bool is_played_out() const { return tape && tape->player.at_end(); }
    /// Told however soon it comes: nothing follows it.
    void end_of_tape() {
        told_at.reset();
        note(Fault::link_closed, "the tape is at its end");
    }
    void note(Fault fault, std::string sentence) override {
        sentence = valid_text(sentence);
        const MonotonicTime now = supervisor.scheduler_.now();
        const bool again = fault == told_fault && sentence == told_note;
        const bool too_soon = told_at && now - *told_at < between_notes;
        keep(fault, std::move(sentence));
        kept_is_outage = false;
        if (again || too_soon) return void(++view.repeats);
        view.repeats = 0;
        told_at = now;
        told_fault = fault;
        told_note = view.last_note;
        supervisor.listener_.on_instrument_note(view);
    }

    Supervisor& supervisor;
    std::unique_ptr<SeatedTape> tape; ///< null: an instrument
    TrackedOpener links;
    std::unique_ptr<Instrument> instrument;
    int first_channel = 0;
    InstrumentView view;
    std::optional<MonotonicTime> last_sample, last_good; ///< on this connection
    bool outage_told = false;    ///< what ended the last connection that gave values
    bool kept_is_outage = false; ///< the view's note tells why a connection ended
    std::string ended_with;      ///< the last try
    std::optional<MonotonicTime> told_at;
    Fault told_fault = Fault::none; ///< what the listener heard last
    std::string told_note;
    std::set<int> told_beyond; ///< channels whose table was left
};

Supervisor::Supervisor(Scheduler& scheduler, LinkOpener& links, SupervisorListener& listener)
    : scheduler_{scheduler}
    , links_{links}
    , listener_{listener} {}

Supervisor::~Supervisor() = default;

void Supervisor::add(const InstrumentConfig& config,
                     std::unique_ptr<Instrument> instrument,
                     std::optional<Tape> tape) {
    std::unique_ptr<SeatedTape> played;
    if (tape) played = std::make_unique<SeatedTape>(scheduler_, *std::move(tape));
    auto seat = std::make_unique<Seat>(*this, std::move(instrument), std::move(played));
    seat->first_channel = static_cast<int>(channels_.size());
    seat->view.name = config.name;
    seat->view.driver = config.driver;
    seat->view.tape = config.tape;
    seat->view.due_on = config.due_on;
    seat->view.since = scheduler_.now();
    seat->view.since_utc_ns = scheduler_.clock_tie().utc_ns;
    const int index = static_cast<int>(seats_.size());
    for (StationChannel& channel :
         station_channels(config, *seat->instrument, index, seat->first_channel))
        channels_.push_back(std::move(channel));
    seats_.push_back(std::move(seat));
}

void Supervisor::start() {
    for (auto& seat : seats_)
        spawn(scheduler_, keep_running(*seat));
}

/// What a driver throws is a bug of it and ends its connection: neither the others nor the loop.
Task<Result<void>> Supervisor::run_once(Seat& seat) {
    const InstrumentContext context{&scheduler_, &seat.links, &seat};
    try {
        co_return co_await seat.instrument->run(context);
    } catch (const std::exception& bug) {
        co_return fail(Fault::internal, "The driver ended with: " + std::string{bug.what()} +
                                            ". Please report it with a tape (axiscal record).");
    }
}

Task<void> Supervisor::keep_running(Seat& seat) {
    Duration pause{};
    for (;;) {
        const MonotonicTime begun = scheduler_.now();
        seat.links.forget();
        const Result<void> ended = co_await run_once(seat);
        ++seat.view.restarts;
        seat.last_sample.reset();
        seat.last_good.reset();
        if (!ended) seat.end_with(ended.error());
        set_state(seat, InstrumentState::unavailable);
        if (seat.is_played_out()) {
            seat.end_of_tape();
            co_return;
        }
        const bool ran_well = scheduler_.now() - begun > longest_pause;
        pause = ran_well ? first_pause : std::clamp(2 * pause, first_pause, longest_pause);
        // Who uses a node that has just come is settled a moment later: tried soon again.
        if (co_await pause_after(seat, pause)) pause = {};
    }
}

Task<bool> Supervisor::pause_after(const Seat& seat, Duration pause) {
    const MonotonicTime now = scheduler_.now();
    const RetryTimes times{now + pause, now + look_all_the_same};
    auto* listener = dynamic_cast<PlugListener*>(&links_);
    if (listener == nullptr || !seat.links.missing()) {
        co_await scheduler_.sleep_until(times.usual);
        co_return false;
    }
    LinkSettings settings = *seat.links.missing();
    co_return co_await listener->worth_another_try(scheduler_, std::move(settings), times);
}

void Supervisor::set_state(Seat& seat, InstrumentState state) {
    if (seat.view.state == state) return;
    // The next outage tells its reason again, be it the same one, and however soon it comes.
    if (state == InstrumentState::available) {
        seat.told_note.clear();
        seat.told_at.reset();
        seat.outage_told = false;
        if (std::exchange(seat.kept_is_outage, false)) seat.keep(Fault::none, {});
    }
    seat.view.state = state;
    seat.view.since = scheduler_.now();
    seat.view.since_utc_ns = scheduler_.clock_tie().utc_ns;
    listener_.on_instrument_state(seat.view);
}

void Supervisor::judge() {
    const MonotonicTime now = scheduler_.now();
    for (auto& seat : seats_) {
        const bool heard = seat->last_sample && now - *seat->last_sample < silence;
        const bool good = seat->last_good && now - *seat->last_good < silence;
        if (!good) set_state(*seat, heard ? InstrumentState::faulty : InstrumentState::unavailable);
    }
}

bool Supervisor::somebody_speaks() const {
    return std::ranges::any_of(
        seats_, [](const auto& seat) { return seat->view.state != InstrumentState::unavailable; });
}

std::vector<InstrumentView> Supervisor::view() const {
    std::vector<InstrumentView> views;
    for (const auto& seat : seats_) {
        views.push_back(seat->view);
        views.back().counters = seat->instrument->counters();
    }
    return views;
}

const Instrument& Supervisor::instrument(int index) const {
    return *seats_[static_cast<std::size_t>(index)]->instrument;
}
const Identity& Supervisor::identity(int index) const {
    return seats_[static_cast<std::size_t>(index)]->view.identity;
}

} // namespace axiscal
