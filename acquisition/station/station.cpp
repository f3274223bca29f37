#include "acquisition/station/station.hpp"

#include "acquisition/run/live_position.hpp"
#include "analysis/air/air_refraction.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "analysis/rotary/rotary_position.hpp"
#include "drivers/loop/spawn.hpp"

#include <boost/asio/bind_cancellation_slot.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

namespace axiscal {
namespace {

constexpr Duration log_every =
    std::chrono::milliseconds{500}; // bounds the environment table of a long run
constexpr Duration port_pause = std::chrono::seconds{1};
constexpr Duration first_looks =
    std::chrono::seconds{2}; // the station is judged once after its start
constexpr Duration judge_within = std::chrono::seconds{2}; // and looked at once more
constexpr std::size_t kept_notes = 20;

std::vector<WatchedChannel> watched(const StationRoles& roles,
                                    const std::vector<StationChannel>& channels) {
    std::vector<WatchedChannel> list;
    const auto add = [&](EnvironmentRole role, std::optional<int> id) {
        if (!id) return;
        const StationChannel& channel = channels[static_cast<std::size_t>(*id)];
        list.push_back({role, channel.instrument_name + "/" + channel.name, channel.place});
    };
    add(EnvironmentRole::air_temperature, roles.air_temperature);
    add(EnvironmentRole::air_pressure, roles.air_pressure);
    add(EnvironmentRole::air_humidity, roles.air_humidity);
    for (const int id : roles.material)
        add(EnvironmentRole::material_temperature, id);
    for (const int id : roles.scale)
        add(EnvironmentRole::scale_temperature, id);
    return list;
}

/// A capture looks back, and so does the check for drift.
SampleHistory::Limits history_limits(const StationConfig& config) {
    SampleHistory::Limits limits;
    limits.depth = std::max<Duration>(config.capture.history, drift_reach(config.preflight));
    return limits;
}

/// After so long without a sample nothing changes any more: every reading is stale for the CNC, its
/// silence is judged (10 s), and it lies behind every window of the limits.
Duration age_that_matters(const StationConfig& config) {
    Duration longest = std::chrono::seconds{15};
    longest = std::max<Duration>(longest, config.axis.air.oldest);
    if (config.environment.asks_for_change())
        longest = std::max<Duration>(longest, config.environment.change_window);
    return longest + judge_within;
}

/// A little more than the checks look back.
std::vector<SensorLog> sensor_logs(const std::vector<StationChannel>& channels,
                                   const StationConfig& config) {
    constexpr Duration shortest = std::chrono::minutes{1};
    Duration window = config.preflight.soak_window;
    if (config.environment.asks_for_change())
        window = std::max(window, config.environment.change_window);
    const Duration depth = std::max<Duration>(window * 5 / 4, shortest);
    std::vector<SensorLog> logs;
    logs.reserve(channels.size());
    for (const StationChannel& channel : channels)
        logs.emplace_back(depth, channel.kind == ChannelKind::strength ? SensorLog::Keep::lowest
                                                                       : SensorLog::Keep::newest);
    return logs;
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
    , report_program_{std::move(parts.report_program)}
    , slept_{scheduler.asleep()}
    , sleep_lock_{scheduler, std::move(parts.inhibit_program)}
    , supervisor_{scheduler, links, *this}
    , port_{std::move(parts.port)}
    , journal_{scheduler, parts.journal_thread}
    , history_{history_limits(config_)}
    , watch_{(seat_all(supervisor_, config_, std::move(parts.instruments), std::move(parts.tapes)),
              watched(roles_, supervisor_.channels()))}
    , environment_{roles_.environment()}
    , latest_(supervisor_.channels().size())
    , logged_(supervisor_.channels().size())
    , sensor_logs_{sensor_logs(supervisor_.channels(), config_)}
    , outbox_watch_{config_.state_directory, config_.publish}
    , stale_after_{age_that_matters(config_)}
    , bell_{scheduler.executor()} {
    if (config_.axis.angle)
        config_.capture = in_readings(config_.capture, config_.axis.angle->setup);
    if (reads_faces()) config_.capture.fastest = Speed{}; // from face to face the reading jumps
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
    sleep_lock_.try_out();
    supervisor_.start();
    judged_ = judged_outbox_ = scheduler_.now();
    time_counts_until_ = std::max(time_counts_until_, judged_ + first_looks);
    spawn(scheduler_, tick());
    const Result<void> taken = co_await take_over_stored_runs();
    if (taken) {
        open_port();
    } else if (taken.error().fault == Fault::not_durable) {
        waiting_for_disk_ = true;
        std::string message = disk_text(taken.error());
        note("What the last daemon left cannot be taken over yet: " + message +
             " The station tries again by itself; until then the trigger port stays shut.");
        spawn(scheduler_, take_over_when_disk_is_back(std::move(message)));
    } else {
        co_return taken;
    }
    co_return Result<void>{};
}

void Station::open_port() {
    boost::asio::co_spawn(scheduler_.executor(), serve_port(),
                          boost::asio::bind_cancellation_slot(end_port_.slot(), RethrowOnLoop{}));
}

Task<void> Station::stop() {
    stopping_ = true;
    sleep_lock_.want(false);
    end_port_.emit(boost::asio::cancellation_type::terminal);
    if (recording() || drift_open()) {
        if (circular_)
            if (auto rest = circular_->chunker.finish()) keep_chunk(*std::move(rest));
        perform(RecordEvent{{EventKind::interrupted, scheduler_.now(), 0,
                             "The daemon was stopped; the run stays open.", Fault::none, 0}});
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
    latest_[static_cast<std::size_t>(sample.channel)] = sample;
    time_counts_until_ = sample.at + stale_after_;
    if (asleep_) bell_.ring();
    if (sample.channel == roles_.laser) return take_reading(sample);
    if (sample.channel == roles_.autocollimator) return take_face(sample);
    if (sample.channel == roles_.ballbar) return take_bar(sample);
    if (circular_ && sample.channel == roles_.bar_temperature)
        log_environment(sample.channel, sample);
    log_sensor(sample);
    for (std::size_t i = 0; i < environment_.size(); ++i)
        if (environment_[i] == sample.channel) {
            watch_.take(i, sample);
            log_environment(sample.channel, sample);
        }
}

void Station::take_reading(const Sample& sample) {
    history_.push(sample);
    watch_set_up(sample);
    watch_alignment(sample);
    if (!datum_ || !recording()) return;
    if (sample.epoch != datum_epoch_) {
        if (!std::exchange(datum_lost_told_, true))
            feed(LaserFault{Fault::datum_lost,
                            "The " + reference_word() + "'s counter lost its zero.", sample.at});
        return;
    }
    const auto value = sample.value();
    if (value && !run_->header.rotary) // whose halts no port judges
        port_->position(
            sample.at,
            live_position(run_->header.laser, *datum_, metre(*value), live_scale_).in(mm));
}

void Station::log_environment(int channel, const Sample& sample) {
    auto& last = logged_[static_cast<std::size_t>(channel)];
    if (!recording() || !sample.value() || (last && sample.at - *last < log_every)) return;
    last = sample.at;
    journal_.note(std::vector<EnvironmentReading>{{channel, sample.at, *sample.value()}});
}

std::string Station::state_phrase(const InstrumentView& view) {
    const bool plays = view.state == InstrumentState::available && !view.tape.empty();
    return plays ? "plays a tape" : "is " + std::string{name_of(view.state)};
}

void Station::on_instrument_state(const InstrumentView& view) {
    const auto id = roles_.autocollimator;
    const bool sees_faces = id && view.name == channel_of(*id).instrument_name;
    const std::string how = sees_faces ? news_of_autocollimator(view) : state_phrase(view);
    if (!how.empty()) record_instrument(view.name + " " + how + ".", Fault::none);
}

void Station::on_instrument_note(const InstrumentView& view) {
    record_instrument(view.name + ": " + view.last_note, view.last_fault);
}

void Station::record_instrument(const std::string& sentence, Fault fault) {
    note(sentence);
    if (recording() || drift_open())
        perform(RecordEvent{{EventKind::instrument, scheduler_.now(), 0, sentence, fault, 0}});
}

void Station::on_trigger(const TriggerEvent& event) {
    port_note_.clear(); // it works
    if (circular_ && recording()) {
        take_circular(event);
        return;
    }
    if (machine_) return feed_with_air(event);
    if (event.sequence == 0) return;
    // Without an open run the first value seen is the baseline, unless the CNC waits for a run
    // that ended with the last daemon: then it is told why.
    if (event.standing && left_over_fault_)
        refuse_on_port(event.sequence, *left_over_fault_);
    else if (!event.standing)
        refuse_on_port(event.sequence, {Fault::no_run_armed, {}, {}, {}});
}

/// The CNC may repeat itself as fast as it likes: one line a change.
void Station::refuse_on_port(std::uint16_t sequence, const Error& error) {
    port_->refuse(sequence, error.fault);
    std::string sentence =
        "Request " + std::to_string(sequence) + " is refused: " + describe(error);
    if (sentence == refused_note_) return;
    note(sentence);
    refused_note_ = std::move(sentence);
}

void Station::on_cnc_silent(bool silent) {
    cnc_silent_ = silent;
    note(silent ? "The CNC's heartbeat has stopped." : "The CNC's heartbeat is back.");
}

void Station::on_port_note(Fault fault, std::string sentence) {
    std::string message = describe({fault, std::move(sentence), {}, {}});
    if (message == port_note_) return; // a taken address is tried again each second
    note("Trigger port: " + message);
    port_note_ = std::move(message);
}

void Station::note(const std::string& sentence) {
    std::string message = valid_text(sentence); // of errors, which may quote a client or a file
    spdlog::info("{}", message);
    const ClockTie tie = scheduler_.clock_tie();
    notes_.push_back(iso8601_utc(tie.utc_ns) + " " + std::move(message));
    if (notes_.size() > kept_notes) notes_.pop_front();
    bell_.ring(); // what was worth a word may be worth a look
}

const StationChannel& Station::channel_of(int id) const {
    return supervisor_.channels()[static_cast<std::size_t>(id)];
}

std::string Station::shown_name_of(int id) const {
    const StationChannel& channel = channel_of(id);
    return channel.instrument_name + "/" + channel.shown;
}

bool Station::recording() const {
    return run_ && (machine_ || circular_) && !run_->closing && !run_->closed;
}

bool Station::run_open() const {
    return run_ && !run_->closed;
}

/// Of readings that watch_.check() has just found fresh.
double Station::strain_now(EnvironmentRole role, Expansion coefficient, MonotonicTime now) const {
    const Temperature temperature =
        Temperature::celsius(*watch_.fresh_mean(role, now, config_.axis.air.oldest));
    return (coefficient * (temperature - reference_temperature)).si();
}

Result<double> Station::live_scale_now() const {
    const MonotonicTime now = scheduler_.now();
    const Duration oldest = config_.axis.air.oldest;
    AXISCAL_CHECK(watch_.check(now, oldest));
    if (reads_polygon()) return 0.0; // an autocollimator counts no wavelengths
    if (config_.axis.scale) {        // a scale that grows itself counts less
        const double machine = strain_now(EnvironmentRole::material_temperature,
                                          config_.axis.material.coefficient, now);
        const double scale = strain_now(EnvironmentRole::scale_temperature,
                                        config_.axis.scale->setup.coefficient, now);
        return (1 + machine) / (1 + scale) - 1;
    }
    AirState air;
    air.temperature =
        Temperature::celsius(*watch_.fresh_mean(EnvironmentRole::air_temperature, now, oldest));
    air.pressure = pascal(*watch_.fresh_mean(EnvironmentRole::air_pressure, now, oldest));
    air.relative_humidity = percent(*watch_.fresh_mean(EnvironmentRole::air_humidity, now, oldest));
    air.vacuum_wavelength = run_ ? run_->header.laser.vacuum_wavelength : nm(632.991);
    air.co2_ppm = config_.axis.air.co2_ppm;
    AXISCAL_TRY(const Refractivity refractivity, refractivity_of(config_.axis.air.formula, air));
    if (config_.axis.angle) return refractivity.n_minus_1; // an angle does not expand
    const double growth =
        strain_now(EnvironmentRole::material_temperature, config_.axis.material.coefficient, now);
    return refractivity.n_minus_1 + growth + refractivity.n_minus_1 * growth;
}

} // namespace axiscal
