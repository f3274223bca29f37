#include "tests/unit/week/week.hpp"

#include "analysis/record/run_clock.hpp"

#include <cmath>
#include <numbers>

namespace axiscal::testing {
namespace {

// Midnight in Berlin, 2026-10-22; the clocks there go back on the 25th at 01:00 UTC.
constexpr std::int64_t begin_utc_ns = 1'792'620'000'000'000'000;
constexpr Duration chunk = 10s;
constexpr Duration answer_limit = 12'300ms;   // capture.timeout, the grace of 2 s, three heartbeats
constexpr double reading_tolerance_um = 0.05; // of a mean over a still window

Shop& prepare(Shop& shop) {
    shop.shorten();
    shop.config.publish.destination = shop.scratch.file("share");
    std::filesystem::create_directory(shop.config.publish.destination);
    const auto day = [](MonotonicTime at) {
        return std::sin(seconds_of(at - MonotonicTime{}) / 86'400 * 2 * std::numbers::pi);
    };
    shop.drift_um = [day](MonotonicTime at) {
        return 40 * day(at) + 2e-5 * seconds_of(at - MonotonicTime{}); // and 12 um in a week
    };
    shop.warmth_K = [day](MonotonicTime at) { return 1.5 * day(at); };
    return shop;
}

/// What a report program leaves behind, in one shell without further programs but two.
std::string report(const ScratchFolder& scratch) {
    return report_script(scratch, R"(id=${1##*/}; id=${id%.axiscal}
mkdir -p "$3/.$id.staging" && echo "of $id" > "$3/.$id.staging/certificate.json" && mv "$3/.$id.staging" "$3/$id"
echo "{\"entry\": \"$3/$id\"}")");
}

} // namespace

Week::Week(std::uint64_t seed, Duration laser_idle_period)
    : dice_{seed}
    , life_{prepare(shop_), report(shop_.scratch)}
    , idle_period_{laser_idle_period}
    , share_{shop_.config.publish.destination}
    , publisher_{{shop_.scratch.file("outbox"), 5s},
                 {[this] { return life_.scheduler.now(); }, [this] { return utc_ns(); }},
                 share_,
                 heard_} {
    life_.laser->send_every = 5ms;
    life_.run(2 * shop_.config.capture.history); // as much as it ever keeps
    hour_began_ = life_.scheduler.now();
    life_.scheduler.utc_at_zero_ns = begin_utc_ns - nanoseconds_of(hour_began_);
    life_.laser->send_every = idle_period_;
}

Duration Week::some(Duration least, Duration most) {
    return from_seconds(
        std::uniform_real_distribution<double>{seconds_of(least), seconds_of(most)}(dice_));
}

BenchInstrument* Week::victim(Trouble trouble) const {
    switch (trouble) {
    case Trouble::laser_out: return life_.laser;
    case Trouble::air_out: return life_.air;
    case Trouble::material_out: return life_.material;
    default: return nullptr;
    }
}

InstrumentState Week::state_of(const BenchInstrument& one) const {
    const auto views = life_.status().instruments;
    return views[&one == life_.laser ? 0 : &one == life_.air ? 1 : 2].state;
}

std::uint64_t Week::restarts_but(const BenchInstrument& one) const {
    std::uint64_t sum = 0;
    const auto views = life_.status().instruments;
    const std::array<const BenchInstrument*, 3> seats{life_.laser, life_.air, life_.material};
    for (std::size_t i = 0; i < seats.size(); ++i)
        if (seats[i] != &one) sum += views[i].restarts;
    return sum;
}

void Week::run(Duration span) {
    const MonotonicTime end = life_.scheduler.now() + span;
    while (life_.scheduler.now() < end) {
        life_.run(std::min<Duration>(chunk, end - life_.scheduler.now()));
        carry_to_share();
        judge_alarm();
    }
}

/// The files' own times are of the computer that runs this; here they are of the virtual one.
void Week::carry_to_share() {
    const MonotonicTime now = life_.scheduler.now();
    if (share_back_at_ && now >= *share_back_at_) lose_share(false);
    const auto due = publisher_.next_due();
    const std::string outbox = shop_.scratch.file("outbox");
    if ((due && *due <= now) || (!due && !entry_names(outbox).empty())) publisher_.pass();
    const auto since_1970 = std::chrono::nanoseconds{utc_ns()};
    const auto stamp = std::chrono::file_clock::from_sys(
        std::chrono::sys_time<std::chrono::nanoseconds>{since_1970});
    std::set<std::string> waiting;
    for (const std::string& name : entry_names(outbox)) {
        if (!stamped_.contains(name)) std::filesystem::last_write_time(outbox + "/" + name, stamp);
        waiting.insert(name);
    }
    stamped_ = std::move(waiting);
    std::filesystem::last_write_time(outbox, stamp);
}

/// Results that wait for more than a quarter of an hour are an alarm, and not before, however the
/// clock is stepped meanwhile. The test sees the first of them up to a chunk late, the station too.
void Week::judge_alarm() {
    const StationStatus status = life_.status();
    if (status.notes.size() > 20) ++tally_.too_many_notes;
    if (status.outbox.waiting == 0) {
        waits_since_.reset();
        return;
    }
    if (!waits_since_) waits_since_ = life_.scheduler.now();
    const Duration waited = life_.scheduler.now() - *waits_since_;
    const PublishConfig& publish = shop_.config.publish;
    const bool many = status.outbox.waiting >= publish.alarm_count;
    if (waited < publish.alarm_age - 2 * chunk && !many && !status.outbox.alarm.empty())
        ++tally_.false_alarms;
    if (waited < publish.alarm_age + 2 * chunk) return;
    ++tally_.alarms;
    if (status.outbox.alarm.empty()) ++tally_.untold_waits;
}

void Week::lose_share(bool lost) {
    const std::string name = shop_.config.publish.destination;
    std::filesystem::rename(lost ? name : name + ".gone", lost ? name + ".gone" : name);
    if (!lost) return share_back_at_.reset();
    ++tally_.losses;
    share_back_at_ = life_.scheduler.now() + some(60s, 3h);
}

void Week::step_clock(Duration by) {
    life_.scheduler.utc_at_zero_ns += by.count();
    stepped_ += by;
    ++tally_.steps;
    if (waits_since_) ++tally_.steps_while_waiting;
}

void Week::unplug(BenchInstrument& one) {
    ++tally_.unplugged;
    one.unplugged = true;
    run(std::max<Duration>(one.send_every, 1s) + 100ms); // the next thing it would have sent
    if (state_of(one) != InstrumentState::unavailable) ++tally_.unseen;
}

void Week::plug_in(BenchInstrument& one) {
    one.unplugged = false;
    one.opened_at = {}; // a list of the test's own, of each attempt
    run(5s);
    if (state_of(one) != InstrumentState::available) ++tally_.late_back;
}

void Week::idle_trouble(Trouble trouble) {
    if (trouble == Trouble::share_lost && !share_back_at_) return lose_share(true);
    if (trouble == Trouble::clock_steps) {
        step_clock(some(-1h, 1h));
        run(some(1s, 10min));
        return step_clock(-stepped_);
    }
    if (BenchInstrument* one = victim(trouble)) {
        const auto before = restarts_but(*one);
        unplug(*one);
        run(some(1s, 10min));
        plug_in(*one);
        if (restarts_but(*one) != before) ++tally_.disturbed;
    }
}

void Week::hour() {
    if (hours_++ % 24 == 0) {
        const auto heap = ::mallinfo2();
        tally_.bytes_at_midnight.push_back(heap.uordblks == 0 ? 0 : heap.uordblks + heap.hblkhd);
    }
    const auto trouble = static_cast<Trouble>(std::uniform_int_distribution{0, 5}(dice_));
    const bool in_the_run = std::bernoulli_distribution{0.5}(dice_);
    run(some(1min, 40min));
    if (!in_the_run) idle_trouble(trouble);
    hour_began_ += 1h;
    run(hour_began_ - 15s - life_.scheduler.now());
    measure(in_the_run ? trouble : Trouble::none);
}

/// A CNC that waits, and that does the same point again when a person has mended the cause.
bool Week::take(int step, bool may_be_refused) {
    const PlannedPoint point = shop_.plan().points[static_cast<std::size_t>(step)];
    const auto sequence = static_cast<std::uint16_t>(step + 1);
    life_.drive_to(point);
    life_.port->refusals.clear();
    const MonotonicTime stands = life_.scheduler.now();
    stood_um_[static_cast<std::size_t>(step)] =
        shop_.laser_m(stands) * 1e6 - shop_.drift_um(stands);
    ++tally_.requests;
    const MonotonicTime asked = life_.scheduler.now();
    life_.ask(Life::request_for(point, sequence));
    const auto answered = [&] {
        return life_.port->done == sequence || !life_.port->refusals.empty();
    };
    while (!answered() && life_.scheduler.now() - asked < answer_limit)
        life_.run(100ms);
    const bool taken = life_.port->done == sequence;
    ++(taken ? tally_.acknowledged : answered() ? tally_.refused : tally_.unanswered);
    if (taken || !answered()) return taken;
    ++tally_.faults[std::string{fault_name(life_.port->refusals.back().second)}];
    if (!may_be_refused) ++tally_.refused_for_nothing;
    return false;
}

void Week::measure(Trouble trouble) {
    life_.laser->send_every = 5ms;
    run(2s);
    const auto armed = life_.arm();
    if (!armed) {
        ++tally_.left_open;
        ADD_FAILURE() << describe(armed.error());
        return;
    }
    ++tally_.armed;
    const std::int64_t armed_utc_ns = utc_ns();
    const std::string path = life_.status().run->file;
    BenchInstrument* one = victim(trouble);
    const int trouble_at = std::uniform_int_distribution{0, 9}(dice_);
    bool all_taken = true;
    for (int step = 0; step < 10 && all_taken; ++step) {
        if (step == trouble_at && one != nullptr) {
            unplug(*one);
            run(some(0s, 90s));
        } else if (step == trouble_at && trouble == Trouble::clock_steps) {
            step_clock(some(-1h, 1h)); // until the run is closed
            run(some(1s, 10min));
        } else if (step == trouble_at) {
            idle_trouble(trouble);
        }
        bool taken = take(step, one != nullptr && step == trouble_at);
        if (one != nullptr && one->unplugged) plug_in(*one);
        if (!taken) taken = take(step, false);
        all_taken = taken;
    }
    close_and_check(path, all_taken, armed_utc_ns);
    if (stepped_ != Duration{}) {
        ++tally_.left_standing;
        step_clock(-stepped_);
    }
    life_.port->acknowledged.clear();
    life_.laser->send_every = idle_period_;
}

void Week::close_and_check(const std::string& path, bool all_taken, std::int64_t armed_utc_ns) {
    if (!all_taken) {
        ++tally_.left_open;
        (void)life_.abort("the week's CNC gave up");
    }
    life_.run_until([&] { return !life_.status().run_open; });
    if (all_taken) life_.run_until([&] { return !life_.status().run->certificate.empty(); });
    const auto record = read_run_file(path);
    if (!record) return void(++tally_.left_open);
    if (record->complete && record->points.size() == 10) ++tally_.complete;
    const double off_s = static_cast<double>(record->opened.utc_ns - armed_utc_ns) * 1e-9;
    if (std::abs(off_s) > 10) ++tally_.wrong_dates; // arming drives, ties and waits
    check_times(*record);
    for (const PointRecord& point : record->points) {
        const MonotonicTime middle =
            point.window_begin + (point.window_end - point.window_begin) / 2;
        const double shown_um =
            stood_um_[static_cast<std::size_t>(point.step)] + shop_.drift_um(middle);
        const double off_um = point.reading.in(um)-shown_um;
        if (std::abs(off_um) > reading_tolerance_um) ++tally_.wrong_points;
    }
}

/// As a certificate tells them.
void Week::check_times(RunRecord record) {
    const std::int64_t right_at_zero_ns = life_.scheduler.utc_at_zero_ns - stepped_.count();
    std::vector<RetakeRecord> no_retakes;
    tell_times_by_one_clock(record.opened, record.events, no_retakes, record.closed);
    const auto is_right = [&](MonotonicTime at, std::int64_t utc_ns) {
        return utc_ns == right_at_zero_ns + nanoseconds_of(at);
    };
    bool right = is_right(record.closed.before, record.closed.utc_ns);
    for (const EventRecord& event : record.events)
        right = right && is_right(event.at, event.utc_ns);
    if (!right) ++tally_.wrong_times;
}

void Week::settle() {
    if (share_back_at_) lose_share(false);
    run(2min);
    tally_.published = heard_.published_count;
}

} // namespace axiscal::testing
