// How true the time of a sample is on a host under load in fact: records whose true time is known
// go through a pseudo terminal into the serial link, the loop and the clock that the drivers use,
// while twice as many threads as there are processors keep them busy at the same priority. One line
// of JSON a case; tests/bench/clock.py judges them.
//
// loaded_clock [SECONDS]   how long each case goes on after its clock must be right; default 20
//
// An instrument is never late, the thread that stands for it is: what the host lets it wait counts
// as a delay of the record, so the figures are rather too large.
#include "drivers/clock/device_clock.hpp"
#include "drivers/instrument.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/link_opener.hpp"
#include "tests/support/pty_pair.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <sys/prctl.h>
#include <thread>
#include <vector>

namespace axiscal::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t record_bytes = 60;

struct Case {
    const char* name = "";
    double rate_Hz = 1000;
    Duration frame{};     ///< the bus is polled so often; 0: each record comes by itself
    double fast_ppm = 50; ///< the instrument's crystal
    double right_after_s = 10;
    double seconds = 20; ///< after that

    [[nodiscard]] Duration period() const { return from_seconds(1 / rate_Hz); }
    [[nodiscard]] std::int64_t records() const {
        return std::llround((right_after_s + seconds) * rate_Hz);
    }
    [[nodiscard]] MonotonicTime taken_at(MonotonicTime begin, std::int64_t record) const {
        const double nominal_s = static_cast<double>(record) / rate_Hz;
        return begin + from_seconds(nominal_s * (1 - fast_ppm * 1e-6));
    }
};

class Judge {
public:
    explicit Judge(const Case& which)
        : which_{which} {}
    void take(const PlacedTime& placed, MonotonicTime taken, std::int64_t record) {
        const double off_us = seconds_of(placed.at - taken) * 1e6;
        const double uncertainty_us = seconds_of(placed.uncertainty) * 1e6;
        ++records_;
        if (std::abs(off_us) <= 2 * uncertainty_us) ++covered_;
        if (static_cast<double>(record) < which_.right_after_s * which_.rate_Hz) return;
        off_us_.push_back(off_us);
        largest_uncertainty_us_ = std::max(largest_uncertainty_us_, uncertainty_us);
    }
    void tell() const {
        double mean = 0, squares = 0, worst = 0;
        for (const double off : off_us_)
            mean += off / static_cast<double>(off_us_.size());
        for (const double off : off_us_) {
            squares += (off - mean) * (off - mean) / static_cast<double>(off_us_.size());
            worst = std::max(worst, std::abs(off - mean));
        }
        std::printf("{\"case\": \"%s\", \"rms_us\": %.3f, \"worst_us\": %.3f, \"bias_us\": %.3f, "
                    "\"u_us\": %.3f, \"covered\": %.5f}\n",
                    which_.name, std::sqrt(squares), worst, mean, largest_uncertainty_us_,
                    static_cast<double>(covered_) / static_cast<double>(records_));
        std::fflush(stdout);
    }

private:
    const Case& which_;
    std::vector<double> off_us_;
    double largest_uncertainty_us_ = 0;
    std::int64_t records_ = 0, covered_ = 0;
};

/// Sleeping alone ends some 50 us late; the last moment is spent awake.
void wait_until(MonotonicTime when) {
    constexpr Duration awake = 100us;
    const Duration ahead = when - awake - monotonic_now();
    if (ahead > Duration{}) std::this_thread::sleep_for(ahead);
    while (monotonic_now() < when) {
    }
}

/// Each record when it was taken, or at the first poll of the bus after that.
void write_records(const Case& which, testing::PtyPair& line, MonotonicTime begin) {
    ::prctl(PR_SET_TIMERSLACK, 1UL); // ns
    const std::string record(record_bytes, 'x');
    const std::int64_t count = which.records();
    for (std::int64_t next = 0, poll = 0; next < count; ++poll) {
        const bool framed = which.frame > Duration{};
        const MonotonicTime due = framed ? begin + which.frame * poll : which.taken_at(begin, next);
        std::string bytes;
        for (; next < count && which.taken_at(begin, next) <= due; ++next)
            bytes += record;
        wait_until(due);
        line.send(bytes);
    }
}

[[noreturn]] void give_up(const Error& error) {
    std::fprintf(stderr, "loaded_clock: %s\n", describe(error).c_str());
    std::exit(1);
}

/// All arguments outlive the loop.
Task<void>
follow(const Case& which, InstrumentContext context, testing::PtyPair& line, Judge& judge) {
    Scheduler& scheduler = *context.scheduler;
    LinkSettings settings;
    settings.path = line.path;
    auto opened = co_await context.links->open(settings, scheduler.now() + 5s);
    if (!opened) give_up(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    const MonotonicTime begin = scheduler.now() + 100ms;
    const std::jthread writer{write_records, std::cref(which), std::ref(line), begin};
    DeviceClock clock{which.frame};
    std::size_t bytes = 0;
    for (std::int64_t number = 0; number < which.records();) {
        const auto arrived = co_await link->read_some(scheduler.now() + 10s);
        if (!arrived) give_up(arrived.error());
        bytes += arrived->bytes.size();
        for (; bytes >= record_bytes; bytes -= record_bytes, ++number) {
            const auto behind = static_cast<std::int64_t>(bytes / record_bytes) - 1;
            const auto placed = clock.place(static_cast<std::uint64_t>(number + 1),
                                            arrived->read_at, which.period(), behind);
            judge.take(placed, which.taken_at(begin, number), number);
        }
    }
}

void run(const Case& which) {
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    RealLinkOpener links{scheduler};
    testing::PtyPair line;
    Judge judge{which};
    boost::asio::co_spawn(loop, follow(which, {&scheduler, &links, nullptr}, line, judge),
                          [&loop](const std::exception_ptr& bug) {
                              if (bug) std::rethrow_exception(bug);
                              loop.stop();
                          });
    loop.run();
    judge.tell();
}

void burn(const std::stop_token& stop) {
    for (volatile unsigned turns = 0; !stop.stop_requested();)
        turns = turns + 1;
}

} // namespace
} // namespace axiscal::bench

int main(int count, char** words) {
    using namespace axiscal::bench;
    const double seconds = count > 1 ? std::strtod(words[1], nullptr) : 20;
    std::vector<std::jthread> load;
    for (unsigned i = 0; i < 2 * std::max(1U, std::thread::hardware_concurrency()); ++i)
        load.emplace_back(burn);
    using std::chrono::milliseconds;
    for (const Case& which :
         {Case{.name = "serial line, 1 kHz", .seconds = seconds},
          Case{.name = "stream of 10 kHz over USB frames",
          .rate_Hz = 10'000,
          .frame = milliseconds{1},
          .seconds = seconds},
          // A beat of 10 s; the floors of three teeth have been seen after 30 s.
          Case{.name = "1 kHz over USB frames, after two beats",
          .frame = milliseconds{1},
          .fast_ppm = 100,
          .right_after_s = 35,
          .seconds = seconds}})
        run(which);
}
