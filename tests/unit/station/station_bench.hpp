#pragma once
// A whole station under virtual time: made instruments at its door `Instrument`, a scripted port at
// its door `TriggerPort`, a machine that moves. Tests only.

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/station/station.hpp"
#include "drivers/wire/arrival.hpp"
#include "drivers/loop/doorbell.hpp"
#include "tests/support/cnc_map_bench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::testing {

using namespace std::chrono_literals;

/// Straight moves at one speed, rest otherwise. Survives the station: a daemon restarts, a machine
/// does not.
class MovingAxis {
public:
    void go(double to_mm, MonotonicTime now) {
        from_mm_ = at(now);
        to_mm_ = to_mm;
        began_ = now;
    }
    [[nodiscard]] double at(MonotonicTime now) const {
        const double way = speed_mm_per_s * seconds_of(now - began_);
        const double distance = to_mm_ - from_mm_;
        return way >= std::abs(distance) ? to_mm_ : from_mm_ + (distance < 0 ? -way : way);
    }
    [[nodiscard]] Duration time_to(double to_mm, MonotonicTime now) const {
        return from_seconds(std::abs(to_mm - at(now)) / speed_mm_per_s);
    }
    double speed_mm_per_s = 400;

private:
    double from_mm_ = 0, to_mm_ = 0;
    MonotonicTime began_{};
};

/// Sends one sample a channel and period, and misbehaves as told.
class BenchInstrument final : public Instrument {
public:
    using Reading = std::function<double(int channel, MonotonicTime at)>;
    BenchInstrument(std::vector<Channel> channels, Duration period, Reading reading)
        : send_every{period}
        , channels_{std::move(channels)}
        , period_{period}
        , reading_{std::move(reading)} {}

    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    [[nodiscard]] std::optional<Optics> optics() const override {
        return channels_.front().kind == ChannelKind::displacement
                   ? std::optional{Optics{nm(632.991354), 2}}
                   : std::nullopt;
    }
    [[nodiscard]] std::uint64_t count_modulus() const override { return modulus; }

    Task<Result<void>> run(InstrumentContext context) override {
        ++opened;
        opened_at.push_back(context.scheduler->now());
        if (!refuses_with.empty()) {
            Error error = refuses_with.front();
            refuses_with.pop_front();
            co_return tl::unexpected<Error>(std::move(error));
        }
        if (unplugged && !link) co_return fail(Fault::link_closed, "no such device");
        if (link) {
            const auto link_open = co_await context.links->open(*link, context.scheduler->now());
            if (!link_open) co_return tl::unexpected<Error>(link_open.error());
        }
        if (asks_the_next_too) {
            const auto next =
                co_await context.links->open(*asks_the_next_too, context.scheduler->now());
            if (!next) co_return fail(Fault::link_timeout, "no answer");
        }
        context.sink->identify({"Maker", "Model", serial, "1.0"});
        for (;;) {
            co_await context.scheduler->sleep_for(send_every);
            if (unplugged) co_return tl::unexpected<Error>(when_unplugged);
            const MonotonicTime now = context.scheduler->now();
            if (!silent) unread_.push_back(now);
            while (!unread_.empty() && !read_late) {
                send(unread_.front(), *context.sink);
                unread_.pop_front();
            }
            for (int i = 0; i < notes_each_period; ++i)
                context.sink->note(Fault::bad_frame, "garbage " + std::to_string(++noted));
        }
    }

    Duration send_every;              ///< the device may leave out some of its numbers
    Duration strength_every{1s};      ///< of a channel that tells a strength
    std::optional<LinkSettings> link; ///< opened first, where there is one
    /// Mute: the next device is asked whether it is the wanted one.
    std::optional<LinkSettings> asks_the_next_too;
    std::deque<Error> refuses_with; ///< each opening ends with the next of them
    bool unplugged = false, silent = false;
    bool read_late = false; ///< what it measures waits in a buffer meanwhile
    Error when_unplugged{Fault::link_closed, "unplugged", {}, {}};
    Quality quality = Quality::good;
    std::uint32_t epoch = 0;
    std::uint64_t modulus = 0;
    bool number_wraps = false;
    MonotonicTime switched_on{}; ///< its number counts from here
    Duration time_uncertainty{}; ///< u(t) of each sample; 0: it states none
    std::string serial = "S-1";
    int opened = 0, notes_each_period = 0, noted = 0;
    std::vector<MonotonicTime> opened_at;

private:
    std::deque<MonotonicTime> unread_;

    /// As the driver does: unwrapped while it runs, from what the device says at first.
    std::uint64_t first_count(std::uint64_t number) {
        if (first_number_ == 0) first_number_ = number;
        return first_number_ % 65'536;
    }
    void send(MonotonicTime now, SampleSink& sink) {
        // The device numbers by its own clock: a daemon that restarts finds it further on.
        auto count = static_cast<std::uint64_t>((now - switched_on) / period_);
        if (number_wraps) count = first_count(count) + count - first_number_;
        for (int channel = 0; channel < static_cast<int>(channels_.size()); ++channel) {
            if (!is_due(channel, now)) continue;
            Sample sample = quality == Quality::good
                                ? Sample{channel, now, reading_(channel, now), count, epoch}
                                : Sample::bad(channel, now, quality, count, epoch);
            sample.time_uncertainty = time_uncertainty;
            sink.take(sample);
        }
    }
    /// A strength is told more seldom than the length that it belongs to.
    bool is_due(int channel, MonotonicTime now) {
        const bool strength =
            channels_[static_cast<std::size_t>(channel)].kind == ChannelKind::strength;
        if (!strength) return true;
        if (now - strength_told_at_ < strength_every) return false;
        strength_told_at_ = now;
        return true;
    }
    std::vector<Channel> channels_;
    Duration period_;
    Reading reading_;
    MonotonicTime strength_told_at_{};
    InstrumentCounters counters_;
    std::uint64_t first_number_ = 0;
};

/// Remembers what the CNC would read.
class ScriptedPort final : public TriggerPort {
public:
    Task<Result<void>> run(TriggerContext context) override {
        sink = context.sink;
        ++runs;
        try {
            while (!broken)
                co_await context.scheduler->sleep_for(looks_every);
        } catch (const std::exception&) { // cancelled: the way a port ends
        }
        if (broken) co_return fail(Fault::io, "the address is taken");
        ended = true;
        co_return Result<void>{};
    }
    void publish_armed() override {
        ++armed;
        done = 0;
        words.arm();
    }
    void acknowledge_skip(const JournalReceipt& receipt) override {
        acknowledge(receipt);
        words.finish_skip(receipt.sequence());
    }
    void publish_no_run(RunEnd end) override {
        words.end_run(end);
        done = words.word(sequence_block::acknowledged_sequence);
    }
    void acknowledge(const JournalReceipt& receipt) override {
        done = receipt.sequence();
        if (sink == nullptr) done_before_open = done;
        acknowledged.push_back(receipt.sequence());
        words.finish(receipt.sequence());
    }
    void refuse(std::uint16_t sequence, Fault fault) override {
        refusals.emplace_back(sequence, fault);
        words.refuse(sequence, fault);
    }
    void publish(const PortStatus& of) override {
        status = of;
        ++published;
        words.show(of);
    }
    [[nodiscard]] std::string describe() const override { return "scripted"; }

    TriggerSink* sink = nullptr;
    Duration looks_every = 100ms; ///< whether it is broken
    bool broken = false, ended = false;
    int runs = 0, armed = 0, published = 0;
    std::uint16_t done = 65535;
    std::optional<std::uint16_t> done_before_open;
    std::vector<std::uint16_t> acknowledged;
    std::vector<std::pair<std::uint16_t, Fault>> refusals;
    PortStatus status;
    MapBench<SequenceBlockMap> words{false, false}; ///< as a CNC with this shape would read them
};

/// Opens what is plugged in, and tells who waits for it when it comes. The links are empty: made
/// instruments read nothing from them.
class PlugBoard final : public LinkOpener, public PlugListener {
public:
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                 MonotonicTime) override {
        ++openings;
        if (!is_there(settings)) co_return fail(Fault::link_closed, "no such device");
        co_return std::unique_ptr<ByteLink>{};
    }
    Task<bool>
    worth_another_try(Scheduler& scheduler, LinkSettings settings, RetryTimes times) override {
        if (deaf || is_there(settings)) {
            co_await scheduler.sleep_until(times.usual);
            co_return false;
        }
        const auto bell = std::make_shared<Doorbell>(scheduler.executor());
        waiting_.push_back(bell);
        co_await bell->wait(scheduler, times.latest);
        co_return plugged;
    }
    void plug_in() {
        plugged = true;
        for (const auto& bell : std::exchange(waiting_, {}))
            bell->ring();
    }
    static constexpr const char* nowhere = "/dev/nowhere";
    bool plugged = true, deaf = false;
    int openings = 0;

private:
    [[nodiscard]] bool is_there(const LinkSettings& settings) const {
        return plugged && settings.path != nowhere;
    }
    std::vector<std::shared_ptr<Doorbell>> waiting_;
};

/// What outlives a daemon: the folder, the machine, the time.
struct Shop {
    ScratchFolder scratch;
    MovingAxis axis;
    StationConfig config = make_config(scratch.path());
    MonotonicTime now = monotonic_from_ns(1'000'000'000);
    std::uint64_t laser_modulus = 0;
    bool laser_number_wraps = false;
    MonotonicTime laser_switched_on{};
    std::string laser_serial = "S-1", air_serial = "S-1", bar_serial = "S-1";
    bool air_is_out = false; ///< its cable, when the daemon starts
    BootId boot_id{"boot-1"};
    StationKey key;                                          ///< none: nothing is signed
    std::int64_t utc_at_zero_ns = 1'795'255'200'000'000'000; ///< 2026-11-21T10:00:00Z
    JournalThread journal_thread = JournalThread::caller;    ///< its own takes real time
    bool port_broken = false;
    Duration port_looks_every = 100ms;
    bool linked = false; ///< each instrument opens a link of Life::links
    /// Reading of a ballbar in metres, 1 kHz; none: the station has no ballbar.
    std::function<double(MonotonicTime)> ballbar;
    /// What the laser tells of its signal, %, each `strength_every`; empty: it tells nothing.
    std::function<double(MonotonicTime)> laser_strength;
    MonotonicTime ballbar_switched_on{};
    /// What adds to the laser's reading, and what the air warms up by; nothing at first.
    std::function<double(MonotonicTime)> drift_um, warmth_K;

    /// What the sensors show, by channel; nothing: steady air of 23 degC and a steady machine.
    std::function<double(int, MonotonicTime)> shown_air, shown_material;

    /// What the laser reads, in place of the moving axis in air; of another `first_channel` in its
    /// stored unit.
    std::function<double(MonotonicTime)> reading_m;
    Channel first_channel{"axis 1", ChannelKind::displacement};
    int further_axes = 0; ///< of the laser's counter: lengths that nobody asks for
    Duration laser_period = 5ms;

    [[nodiscard]] double laser_m(MonotonicTime at) const {
        if (reading_m) return reading_m(at);
        return axis.at(at) * 1e-3 * (1 + 2.7e-4) + (drift_um ? drift_um(at) * 1e-6 : 0.0);
    }

    static StationConfig make_config(const std::string& folder) {
        StationConfig config;
        config.text = "name = \"bench\"\n";
        config.station = "bench";
        config.state_directory = folder;
        config.axis.laser = {"laser", "axis 1"};
        config.axis.dead_path = mm(100);
        config.axis.air_temperature = {"air", "air temperature"};
        config.axis.air_pressure = {"air", "air pressure"};
        config.axis.air_humidity = {"air", "air humidity"};
        config.axis.material_temperature = {{"material", "contact 1"}, {"material", "contact 2"}};
        config.axis.material.coefficient = per_kelvin(11.5e-6);
        config.axis.material.standard_uncertainty = per_kelvin(0.5e-6);
        config.preflight.soak_window = config.preflight.drift_window = 0s;
        config.statements.state = "as found";
        config.statements.control_compensation = "none";
        config.cycle.travel_low = mm(0);
        config.cycle.travel_high = mm(1000);
        config.cycle.interval = mm(90);
        config.cycle.target_count = 11;
        config.cycle.first_target = mm(40);
        config.cycle.seed = 7;
        config.cycle.overrun = mm(5);
        config.cycle.feed = mm_per_minute(1000);
        config.capture.spread_limit = um(2);
        config.capture.fastest = mm_per_minute(30'000);
        config.statements.operator_name = "the station file's operator";
        for (const char* name : {"laser", "air", "material"}) {
            InstrumentConfig one;
            one.name = name;
            one.driver = "made";
            one.certificate_number = "C-1";
            one.due_on = "2099-12-31";
            config.instruments.push_back(one);
        }
        return config;
    }
    /// Five targets, one approach each way: ten points.
    void shorten() {
        config.cycle.target_count = 5;
        config.cycle.interval = mm(200);
        config.cycle.first_target = mm(70);
        config.cycle.approaches = 1;
    }
    [[nodiscard]] RunPlan plan() const {
        const auto passes = plan_passes(config.cycle, 7);
        if (!passes) throw std::runtime_error(describe(passes.error()));
        return passes->front();
    }
    [[nodiscard]] std::vector<std::string> run_files() const {
        std::vector<std::string> files;
        for (const RunSummary& run : list_run_files(scratch.file("runs")))
            files.push_back(run.path);
        return files;
    }
};

/// One life of the daemon.
class Life {
public:
    explicit Life(Shop& of,
                  const std::string& report = "/nonexistent/axiscal-report",
                  Duration at_first = 2s)
        : shop{of} {
        scheduler.utc_at_zero_ns = shop.utc_at_zero_ns;
        scheduler.run_until(shop.now);
        station.emplace(scheduler, links, parts(report));
        boost::asio::co_spawn(scheduler.loop(), station->start(),
                              [this](std::exception_ptr, Result<void> result) {
                                  EXPECT_TRUE(result);
                                  started = true;
                              });
        run(at_first);
    }
    ~Life() { shop.now = scheduler.now(); }
    Life(const Life&) = delete;
    Life& operator=(const Life&) = delete;

    void run(Duration span) { scheduler.run_for(span); }
    /// For what a real process has a part in.
    void run_until(const std::function<bool()>& reached) {
        for (int i = 0; i < 400 && !reached(); ++i) {
            run(20ms);
            scheduler.loop().restart();
            scheduler.loop().run_one_for(20ms);
        }
        EXPECT_TRUE(reached());
    }
    Result<std::string> arm(ArmRequest request = {}) {
        shop.axis.go(shop.plan().datum.in(mm), scheduler.now());
        run(4s);
        auto answer = begin_arm(std::move(request));
        run(3s);
        return *answer ? **answer : Result<std::string>{fail(Fault::internal, "still arming")};
    }
    Result<RetakeAnswer> retake(RevisionRequest request) {
        std::optional<Result<RetakeAnswer>> answer;
        boost::asio::co_spawn(
            scheduler.loop(), station->retake(std::move(request)),
            [&answer](std::exception_ptr, Result<RetakeAnswer> r) { answer = std::move(r); });
        run(1s);
        return answer ? *answer : Result<RetakeAnswer>{fail(Fault::internal, "still at it")};
    }
    /// The answer stands there once it came.
    std::shared_ptr<std::optional<Result<RunEnding>>> begin_abort(const std::string& reason,
                                                                  Orderer by = {}) {
        auto answer = std::make_shared<std::optional<Result<RunEnding>>>();
        boost::asio::co_spawn(
            scheduler.loop(), station->abort(reason, std::move(by)),
            [answer](std::exception_ptr, Result<RunEnding> r) { *answer = std::move(r); });
        return answer;
    }
    Result<RunEnding> abort(const std::string& reason, Orderer by = {}) {
        const auto answer = begin_abort(reason, std::move(by));
        run(100ms);
        return *answer ? **answer : Result<RunEnding>{fail(Fault::internal, "still at it")};
    }
    Result<int> exclude(RevisionRequest request) {
        std::optional<Result<int>> answer;
        boost::asio::co_spawn(
            scheduler.loop(), station->exclude(std::move(request)),
            [&answer](std::exception_ptr, Result<int> r) { answer = std::move(r); });
        run(1s);
        return answer ? *answer : Result<int>{fail(Fault::internal, "still at it")};
    }
    Result<void> answer_finding(AnswerRequest request) {
        std::optional<Result<void>> answer;
        boost::asio::co_spawn(
            scheduler.loop(), station->answer_finding(std::move(request)),
            [&answer](std::exception_ptr, Result<void> r) { answer = std::move(r); });
        run(1s);
        return answer ? *answer : Result<void>{fail(Fault::internal, "still at it")};
    }
    Result<std::vector<PreflightRecord>> preflight(ArmRequest request = {}) {
        std::optional<Result<std::vector<PreflightRecord>>> answer;
        boost::asio::co_spawn(scheduler.loop(), station->preflight(std::move(request)),
                              [&answer](std::exception_ptr,
                                        Result<std::vector<PreflightRecord>> r) {
                                  answer = std::move(r);
                              });
        run(100ms);
        if (!answer) return fail(Fault::internal, "still at it");
        return *answer;
    }
    std::shared_ptr<std::optional<Result<std::string>>> begin_arm(ArmRequest request = {}) {
        auto answer = std::make_shared<std::optional<Result<std::string>>>();
        boost::asio::co_spawn(
            scheduler.loop(), station->arm(std::move(request)),
            [answer](std::exception_ptr, Result<std::string> r) { *answer = std::move(r); });
        return answer;
    }
    /// The answer stands there once the test has begun, or was refused.
    std::shared_ptr<std::optional<Result<std::string>>> begin_drift(DriftRequest request) {
        auto answer = std::make_shared<std::optional<Result<std::string>>>();
        boost::asio::co_spawn(
            scheduler.loop(), station->drift(std::move(request)),
            [answer](std::exception_ptr, Result<std::string> r) { *answer = std::move(r); });
        run(100ms);
        return answer;
    }
    /// To the point from its side, then rest.
    void drive_to(const PlannedPoint& point) {
        const RunPlan plan = shop.plan();
        const double target = plan.targets[static_cast<std::size_t>(point.target_index)].in(mm);
        const double way = 1.5 * plan.overrun.in(mm) * static_cast<int>(point.direction);
        for (const double stop : {target - way, target}) {
            const Duration needed = shop.axis.time_to(stop, scheduler.now());
            shop.axis.go(stop, scheduler.now());
            run(needed + 50ms);
        }
    }
    static TriggerEvent request_for(const PlannedPoint& point, std::uint16_t sequence) {
        TriggerEvent event;
        event.sequence = sequence;
        event.target_index = point.target_index;
        event.direction = point.direction;
        return event;
    }
    void ask(TriggerEvent event) {
        event.at = scheduler.now();
        port->sink->on_trigger(event);
    }
    /// The CNC ties the datum where the axis stands. @returns done is the request's number
    bool prepare(std::uint16_t sequence) {
        TriggerEvent event;
        event.command = TriggerCommand::prepare;
        event.sequence = sequence;
        event.nominal_counts = static_cast<std::int32_t>(std::lround(shop.plan().datum.in(um)*10));
        ask(event);
        run(2s);
        return port->done == sequence;
    }
    /// Drives, asks, waits. @returns done is the point's number
    bool take(int step) { return take(step, static_cast<std::uint16_t>(step + 1)); }
    bool take(int step, std::uint16_t sequence) {
        const PlannedPoint point = shop.plan().points[static_cast<std::size_t>(step)];
        drive_to(point);
        ask(request_for(point, sequence));
        for (int i = 0; i < 40 && port->done != sequence && port->refusals.empty(); ++i)
            run(100ms);
        return port->done == sequence;
    }
    [[nodiscard]] StationStatus status() const { return station->status(); }
    [[nodiscard]] int notes_with(const std::string& words) const {
        const auto notes = status().notes;
        return static_cast<int>(std::ranges::count_if(
            notes, [&](const std::string& note) { return note.find(words) != note.npos; }));
    }

    Shop& shop;
    VirtualScheduler scheduler; // before the station: its tasks end with the loop
    PlugBoard links;
    BenchInstrument *laser = nullptr, *air = nullptr, *material = nullptr, *bar = nullptr;
    ScriptedPort* port = nullptr;
    std::optional<Station> station;
    bool started = false;

private:
    StationParts parts(const std::string& report) {
        StationParts made;
        made.config = shop.config;
        made.config_hash = sha256_hex(shop.config.text);
        made.boot_id = shop.boot_id;
        made.key = shop.key;
        made.report_program = report;
        made.journal_thread = shop.journal_thread;
        std::vector<Channel> of_light{shop.first_channel};
        if (shop.laser_strength) of_light.push_back({"contrast", ChannelKind::strength});
        for (int axis = 0; axis < shop.further_axes; ++axis)
            of_light.push_back({"axis " + std::to_string(axis + 2), ChannelKind::displacement});
        auto light = std::make_unique<BenchInstrument>(
            std::move(of_light), shop.laser_period, [this](int channel, MonotonicTime at) {
                return channel == 1 && shop.laser_strength ? shop.laser_strength(at)
                                                           : shop.laser_m(at);
            });
        auto weather = std::make_unique<BenchInstrument>(
            std::vector<Channel>{{"air temperature", ChannelKind::temperature, Medium::air},
                                 {"air pressure", ChannelKind::pressure, Medium::air},
                                 {"air humidity", ChannelKind::humidity, Medium::air}},
            500ms, [this](int channel, MonotonicTime at) {
                if (shop.shown_air) return shop.shown_air(channel, at);
                if (channel == 0) return 23.0 + (shop.warmth_K ? shop.warmth_K(at) : 0.0);
                return channel == 1 ? 101'325.0 : 50.0;
            });
        auto contacts = std::make_unique<BenchInstrument>(
            std::vector<Channel>{{"contact 1", ChannelKind::temperature, Medium::material},
                                 {"contact 2", ChannelKind::temperature, Medium::material}},
            1s, [this](int channel, MonotonicTime at) {
                if (shop.shown_material) return shop.shown_material(channel, at);
                return channel == 0 ? 22.5 : 22.7;
            });
        laser = light.get(), air = weather.get(), material = contacts.get();
        laser->modulus = shop.laser_modulus;
        laser->number_wraps = shop.laser_number_wraps;
        laser->switched_on = shop.laser_switched_on;
        laser->serial = shop.laser_serial;
        air->serial = shop.air_serial;
        air->unplugged = shop.air_is_out;
        made.instruments.push_back(std::move(light));
        made.instruments.push_back(std::move(weather));
        made.instruments.push_back(std::move(contacts));
        if (shop.ballbar) {
            auto length = std::make_unique<BenchInstrument>(
                std::vector<Channel>{{"ballbar", ChannelKind::displacement}}, 1ms,
                [this](int, MonotonicTime at) { return shop.ballbar(at); });
            bar = length.get();
            bar->switched_on = shop.ballbar_switched_on;
            bar->serial = shop.bar_serial;
            made.instruments.push_back(std::move(length));
        }
        if (shop.linked)
            for (BenchInstrument* one : {laser, air, material})
                one->link.emplace();
        auto scripted = std::make_unique<ScriptedPort>();
        port = scripted.get();
        port->broken = shop.port_broken;
        port->looks_every = shop.port_looks_every;
        made.port = std::move(scripted);
        std::vector<StationChannel> channels;
        for (std::size_t i = 0; i < made.instruments.size(); ++i)
            for (StationChannel& channel :
                 station_channels(made.config.instruments[i], *made.instruments[i],
                                  static_cast<int>(i), static_cast<int>(channels.size())))
                channels.push_back(std::move(channel));
        made.roles = *resolve_roles(made.config.axis, channels);
        if (made.config.ballbar)
            made.roles.ballbar = *resolve_ballbar(*made.config.ballbar, made.roles, channels);
        return made;
    }
};

} // namespace axiscal::testing
