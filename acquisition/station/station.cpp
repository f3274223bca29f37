#include "acquisition/station/station.hpp"

#include "acquisition/measurement/positioning/polygon_reading.hpp"
#include "analysis/rotary/rotary_position.hpp"
#include "drivers/loop/spawn.hpp"

#include <boost/asio/bind_cancellation_slot.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration after_being_ready = std::chrono::seconds{1};
constexpr Duration port_pause = std::chrono::seconds{1};
constexpr Duration first_looks =
    std::chrono::seconds{2}; // the station is judged once after its start
constexpr Duration judge_within = std::chrono::seconds{2}; // and looked at once more

/// After so long without a sample nothing changes any more: every reading is stale for the CNC, its
/// silence is judged (10 s), and it lies behind every window of the limits.
Duration age_that_matters(const StationConfig& config) {
    Duration longest = std::chrono::seconds{15};
    longest = std::max<Duration>(longest, config.axis.air.oldest);
    if (config.environment.asks_for_change())
        longest = std::max<Duration>(longest, config.environment.change_window);
    return longest + judge_within;
}

/// Stillness is judged in what the interferometer reads, while the station file speaks of the axis.
CaptureConfig in_readings(CaptureConfig capture, const RotarySetup& rotary) {
    const double per_coordinate = reading_per_coordinate(rotary);
    capture.spread_limit = capture.spread_limit * per_coordinate;
    capture.slope_limit_um_per_s *= per_coordinate;
    capture.fastest = capture.fastest * per_coordinate;
    return capture;
}

/// The supervisor with every instrument seated; in a function so that the member can be
/// const-built.
void seat_all(Supervisor& supervisor,
              const StationConfig& config,
              std::vector<std::unique_ptr<Instrument>> instruments,
              std::map<std::string, Tape> tapes) {
    for (std::size_t i = 0; i < instruments.size(); ++i) {
        std::optional<Tape> tape;
        if (const auto found = tapes.find(config.instruments[i].name); found != tapes.end())
            tape = std::move(found->second);
        supervisor.add(config.instruments[i], std::move(instruments[i]), std::move(tape));
    }
}

} // namespace

Station::Station(Scheduler& scheduler, LinkOpener& links, StationParts parts)
    : scheduler_{scheduler}
    , config_{std::move(parts.config)}
    , roles_{std::move(parts.roles)}
    , config_hash_{std::move(parts.config_hash)}
    , boot_id_{std::move(parts.boot_id)}
    , sleep_lock_{scheduler, std::move(parts.inhibit_program)}
    , supervisor_{scheduler, links, *this}
    , port_{std::move(parts.port)}
    , journal_{scheduler, parts.journal_thread}
    , readings_{config_, roles_,
                (seat_all(
                     supervisor_, config_, std::move(parts.instruments), std::move(parts.tapes)),
                 supervisor_.channels())}
    , outbox_watch_{config_.state_directory, config_.publish}
    , stale_after_{age_that_matters(config_)}
    , bell_{scheduler.executor()}
    , notices_{scheduler, bell_}
    , fault_teller_{scheduler, config_}
    , files_{scheduler, journal_, notices_, stopping_}
    , certificates_{scheduler, notices_, std::move(parts.report_program),
                    config_.state_directory + "/outbox"}
    , disk_{measurement_context(), tests_}
    , recovery_{positioning_context(), tests_, under_way_.arming}
    , beam_{cnc_context(), tests_} {
    if (config_.axis.angle)
        config_.capture = in_readings(config_.capture, config_.axis.angle->setup);
    if (reads_faces()) config_.capture.fastest = Speed{}; // from face to face the reading jumps
    notices_.ask_for_run([this] { return tests_.open_id(); });
    notices_.tell_too([this](const std::string& sentence, const LogFacts& about) {
        fault_teller_.take(sentence, about);
    });
    sign_with(std::move(parts.key));
}

/// That another key signs, or none, stands in the events of the next run, too.
void Station::sign_with(StationKey key) {
    journal_.sign_with(std::move(key.key));
    if (!key.news.empty()) note(key.news);
    if (key.warns)
        journal_.note(EventRecord{EventKind::note, scheduler_.now(), scheduler_.clock_tie().utc_ns,
                                  std::move(key.news), Fault::none, 0});
}

Station::~Station() = default;

Task<Result<void>> Station::start() {
    std::error_code error;
    for (const char* folder : {"runs", "outbox"}) {
        std::filesystem::create_directories(std::filesystem::path{config_.state_directory} / folder,
                                            error);
        if (error)
            co_return fail(Fault::io,
                           "cannot make " + config_.state_directory + "/" + folder +
                               "; check station.state_directory and its owner",
                           error);
    }
    if (const auto opened = fault_teller_.open(); !opened)
        note("Nobody is told by the webhook: " + describe(opened.error()));
    supervisor_.start();
    judged_ = scheduler_.now();
    outbox_watch_.begin_judging(judged_);
    time_counts_until_ = std::max(time_counts_until_, judged_ + first_looks);
    spawn(scheduler_, tick());
    const Result<void> taken = co_await recovery_.take_over_stored_runs();
    if (taken) {
        open_port();
    } else if (taken.error().fault == Fault::not_durable) {
        std::string told = disk_.begin_to_take_over(taken.error());
        spawn(scheduler_, open_port_once_taken_over(std::move(told)));
    } else {
        co_return taken;
    }
    spawn(scheduler_, try_out_sleep_lock());
    co_return Result<void>{};
}

Task<void> Station::open_port_once_taken_over(std::string told) {
    const bool taken = co_await disk_.until_taken_over(recovery_, std::move(told));
    if (taken) open_port();
}

/// Its program takes longer to start than a station does, which is ready before.
Task<void> Station::try_out_sleep_lock() {
    co_await scheduler_.sleep_for(after_being_ready);
    if (!stopping_) sleep_lock_.try_out();
}

void Station::open_port() {
    boost::asio::co_spawn(scheduler_.executor(), serve_port(),
                          boost::asio::bind_cancellation_slot(end_port_.slot(), RethrowOnLoop{}));
}

Task<void> Station::stop() {
    stopping_ = true;
    sleep_lock_.want(false);
    end_port_.emit(boost::asio::cancellation_type::terminal);
    if (takes_records() || drift_open()) {
        if (const auto& run = last_run()) run->keep_rest();
        record(EventKind::interrupted, "The daemon was stopped; the run stays open.");
        co_await journal_.flush();
    }
}

Task<void> Station::serve_port() {
    while (!stopping_) {
        TriggerContext context{&scheduler_, this};
        const Result<void> ended = co_await port_->run(context);
        if (stopping_) co_return;
        if (!ended) on_port_note(ended.error().fault, ended.error().detail);
        co_await scheduler_.sleep_for(port_pause);
    }
}

void Station::on_sample(const Sample& sample) {
    readings_.take(sample);
    time_counts_until_ = sample.at + stale_after_;
    if (asleep_) bell_.ring();
    if (const auto& resting = tests_.resting()) resting->on_sample(sample);
    keep_reading(sample);
    if (const auto& run = last_run()) run->on_sample(sample);
}

void Station::keep_reading(const Sample& sample) {
    if (sample.channel == roles_.laser) {
        readings_.take_reference(sample);
        recovery_.watch_set_up(sample);
        beam_.take(sample);
    } else if (sample.channel == roles_.autocollimator) {
        readings_.take_reference(in_degrees(sample));
    } else if (sample.channel == roles_.ballbar) {
        readings_.take_bar(sample);
        readings_.log(sample);
    } else {
        readings_.take_sensor(sample);
    }
}

void Station::record(EventKind kind, std::string sentence, Fault fault) {
    journal_.note(EventRecord{kind, scheduler_.now(), scheduler_.clock_tie().utc_ns,
                              std::move(sentence), fault, 0});
}

std::string Station::news_of_state(const InstrumentView& view) {
    const bool plays = view.state == InstrumentState::available && !view.tape.empty();
    return plays ? "plays a tape" : "is " + std::string{name_of(view.state)};
}

/// Once it was seen to see a face, having none before it is the way to the next: only where it
/// comes back without one, that is told, and the first face after it.
std::string Station::news_of_autocollimator(const InstrumentView& view) {
    const bool between_faces =
        autocollimator_ == InstrumentState::available && view.state == InstrumentState::faulty;
    if (between_faces || view.state == autocollimator_) return {};
    const InstrumentState before = std::exchange(autocollimator_, view.state);
    if (view.state == InstrumentState::faulty) return "answers, and sees no face";
    return before == InstrumentState::faulty && view.state == InstrumentState::available
               ? "sees a face"
               : news_of_state(view);
}

void Station::on_instrument_state(const InstrumentView& view) {
    const auto id = roles_.autocollimator;
    const bool sees_faces = id && view.name == supervisor_.channel(*id).instrument_name;
    const std::string how = sees_faces ? news_of_autocollimator(view) : news_of_state(view);
    if (!how.empty()) record_instrument(view.name + " " + how + ".", {Fault::none, {}, view.name});
}

void Station::on_instrument_note(const InstrumentView& view) {
    record_instrument(view.name + ": " + view.last_note, {view.last_fault, {}, view.name});
}

void Station::record_instrument(const std::string& sentence, const LogFacts& about) {
    notices_.note(sentence, about);
    if (takes_records() || drift_open()) record(EventKind::instrument, sentence, about.fault);
}

void Station::on_trigger(const TriggerEvent& event) {
    notices_.port_works();
    if (const auto& run = last_run(); run && run->on_trigger(event)) return;
    if (event.sequence == 0) return;
    // Without an open run the first value seen is the baseline, unless the CNC waits for a run
    // that ended with the last daemon: then it is told why.
    if (event.standing && recovery_.why_not())
        refuse_on_port(event.sequence, *recovery_.why_not());
    else if (!event.standing)
        refuse_on_port(event.sequence, {Fault::no_run_armed, {}, {}, {}});
}

void Station::refuse_on_port(std::uint16_t sequence, const Error& error) {
    port_->refuse(sequence, error.fault);
    notices_.note_refusal(sequence, error);
}

void Station::on_cnc_silent(bool silent) {
    cnc_silent_ = silent;
    note(silent ? "The CNC's heartbeat has stopped." : "The CNC's heartbeat is back.");
}

void Station::on_port_note(Fault fault, std::string sentence) {
    notices_.note_port(fault, std::move(sentence));
}

bool Station::broken_off() const {
    return last_run() ? last_run()->broken_off() : recovery_.left_broken_off();
}

MeasurementContext Station::measurement_context() {
    return {scheduler_, journal_, notices_, readings_, config_, files_, certificates_, stopping_};
}

CncContext Station::cnc_context() {
    return {measurement_context(), *this, roles_, supervisor_, config_hash_, boot_id_};
}

PositioningContext Station::positioning_context() {
    return {cnc_context(), *this, readings_};
}

OrderContext Station::order_context() {
    return {positioning_context(), tests_, recovery_, disk_, beam_, under_way_,
            sleep_lock_.refusal()};
}

} // namespace axiscal
