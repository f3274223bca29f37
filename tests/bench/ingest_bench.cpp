// A serial line as a uMD counter fills it, through a pseudo-terminal: from the read to the sample
// in the history. Only the reader's own CPU time counts; the limit reads the same bytes and drops
// them.
#include "acquisition/capture/sample_history.hpp"
#include "drivers/wire/link_opener.hpp"
#include "drivers/registry.hpp"
#include "tests/bench/row.hpp"
#include "tests/support/pty_pair.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <atomic>
#include <ctime>
#include <random>
#include <thread>

namespace axiscal::bench {
namespace {

constexpr std::uint64_t records_a_second = 50'000;
constexpr std::uint64_t records_a_burst = 64; // as many as a pty hands over in one read
constexpr std::uint64_t bursts = 64;
constexpr double most_records_ms = 4096 / 2e6 * 1e3; // two million a second
constexpr double most_of_a_second_ms = 30;           // 3 % of a processor

double cpu_seconds() {
    timespec spent{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
    return static_cast<double>(spent.tv_sec) + static_cast<double>(spent.tv_nsec) * 1e-9;
}

/// Records as firmware prints them, about 60 bytes long, their width changing: a parser must not
/// learn it.
class UmdPrinter {
public:
    /// What a line loses that is just being opened.
    std::string one() { return record(); }
    std::string burst(std::uint64_t records = records_a_burst) {
        std::string text;
        for (std::uint64_t i = 0; i < records; ++i)
            text += record();
        return text;
    }

private:
    std::string record() {
        ++sequence_;
        displacement_ += std::uniform_int_distribution<int>{-40, 40}(random_);
        const auto slot = sequence_ % 32;
        const std::string low_speed = slot == 1   ? "10 247"
                                      : slot == 2 ? "8 5000000" // hundredths of 50 kHz
                                      : slot == 3 ? "20 1025"
                                                  : "0 0";
        const auto counts = 2'000'000'000 + displacement_;
        return "0 " + std::to_string(displacement_ % 97) + " " + std::to_string(counts) + " " +
               std::to_string(displacement_ % 997) + " " +
               std::to_string(1'000'000 + displacement_) + " " +
               std::to_string(10'000'000'000 + sequence_) + " " + low_speed + "\r\n";
    }
    std::mt19937 random_{1};
    std::int64_t displacement_ = 0;
    std::uint64_t sequence_ = 0;
};

/// Time goes as the records say: 50 000 of them are a second, however quickly they are read.
class RecordScheduler final : public Scheduler {
public:
    explicit RecordScheduler(boost::asio::io_context& loop)
        : loop_{loop} {}
    [[nodiscard]] MonotonicTime now() const override { return now_; }
    [[nodiscard]] ClockTie clock_tie() const override { return {now(), 0, now()}; }
    Task<void> sleep_until(MonotonicTime /*when*/) override {
        boost::asio::steady_timer timer{loop_, std::chrono::hours{1}};
        co_await timer.async_wait(boost::asio::use_awaitable);
    }
    [[nodiscard]] boost::asio::any_io_executor executor() override { return loop_.get_executor(); }
    void pass(std::uint64_t records) {
        now_ = now() + std::chrono::nanoseconds{records * 1'000'000'000 / records_a_second};
    }

private:
    boost::asio::io_context& loop_;
    std::atomic<MonotonicTime> now_ = monotonic_from_ns(1'000'000'000); ///< passes in the feeder
};

class History final : public SampleSink {
public:
    void take(const Sample& sample) override {
        history_.push(sample);
        ++samples;
    }
    void identify(const Identity& /*identity*/) override {}
    void note(Fault /*fault*/, std::string sentence) override { said = std::move(sentence); }

    std::uint64_t samples = 0;
    std::string said;

private:
    SampleHistory history_;
};

/// The instrument as the station runs it, on a line that the bench fills.
class Ingest {
public:
    Ingest() {
        auto document = SettingsDocument::parse(
            "link = \"serial:" + line_.path +
                "\"\nwavelength = \"632.991354 nm\"\nfold = \"plane mirror\"\n"
                "counts_per_cycle = 4\nhead = \"homodyne\"\nphase = \"none\"\nfastest = \"300 "
                "m/min\"\n",
            "bench");
        std::vector<Settings> options{document->root()};
        InstrumentConfig config;
        config.driver = "umd";
        instrument_ = std::move(make_instruments({config}, options).front());
        boost::asio::co_spawn(loop_, run(), boost::asio::detached);
        while (sink_.samples == 0) { // opening empties the line
            line_.send(printer_.one());
            loop_.run_for(std::chrono::milliseconds{20});
        }
        while (sink_.samples < 32)
            burst();
    }
    /// Seconds of CPU that reading one burst took.
    double burst() {
        const std::uint64_t wanted = instrument_->counters().frames + records_a_burst;
        scheduler_.pass(records_a_burst);
        line_.send(printer_.burst());
        const double begin = cpu_seconds();
        while (instrument_->counters().frames + 1 < wanted)
            loop_.run_one();
        return cpu_seconds() - begin;
    }
    /// Seconds of CPU of the reader, its waiting included, while a second of a 50 kHz counter
    /// arrives as USB hands it over: once a millisecond.
    double second() {
        constexpr std::uint64_t frames = 1000, records = records_a_second / frames;
        const std::uint64_t wanted = instrument_->counters().frames + records_a_second;
        std::jthread feeder{[this] {
            auto next = std::chrono::steady_clock::now();
            for (std::uint64_t frame = 0; frame < frames; ++frame) {
                std::this_thread::sleep_until(next += std::chrono::milliseconds{1});
                scheduler_.pass(records);
                line_.send(printer_.burst(records));
            }
        }};
        const double begin = cpu_seconds();
        while (instrument_->counters().frames + 1 < wanted)
            loop_.run_one();
        return cpu_seconds() - begin;
    }

private:
    Task<void> run() {
        const InstrumentContext context{&scheduler_, &links_, &sink_};
        co_await instrument_->run(context);
        std::abort(); // the line stays open
    }

    testing::PtyPair line_;
    UmdPrinter printer_;
    boost::asio::io_context loop_;
    RecordScheduler scheduler_{loop_};
    RealLinkOpener links_{scheduler_};
    History sink_;
    std::unique_ptr<Instrument> instrument_;
};

Ingest& line() {
    static Ingest one;
    return one;
}

double ingest() {
    Ingest& bench = line();
    double seconds = 0;
    for (std::uint64_t i = 0; i < bursts; ++i)
        seconds += bench.burst();
    return seconds;
}

/// The same bytes read and dropped.
double read_and_drop() {
    static testing::PtyPair line;
    static const int slave = ::open(line.path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK);
    static UmdPrinter printer;
    double seconds = 0;
    std::array<char, 16384> buffer{};
    for (std::uint64_t i = 0; i < bursts; ++i) {
        const std::string sent = printer.burst();
        line.send(sent);
        const double begin = cpu_seconds();
        for (std::size_t taken = 0; taken < sent.size();) {
            pollfd readable{slave, POLLIN, 0};
            ::poll(&readable, 1, -1);
            const auto count = ::read(slave, buffer.data(), buffer.size());
            if (count > 0) taken += static_cast<std::size_t>(count);
        }
        seconds += cpu_seconds() - begin;
    }
    return seconds;
}

[[maybe_unused]] const bool added =
    add(TimedRow{"serial ingest, 4096 records of 60 bytes", ingest, read_and_drop, 2.5,
                 "poll, read, drop", most_records_ms}) &&
    add(TimedRow{"serial ingest, a second of 50 kHz", [] { return line().second(); }, {}, 0, "",
                 most_of_a_second_ms});

} // namespace
} // namespace axiscal::bench
