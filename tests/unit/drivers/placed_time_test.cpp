// What is known of the time of a reading that was asked for, and what each driver says of it.
#include "drivers/clock/placed_time.hpp"
#include "drivers/recording/tape_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

namespace axiscal::placed_time_test {
namespace {

using namespace std::chrono_literals;

constexpr MonotonicTime asked{1000s};

/// GUM 4.3.7: what lies anywhere within +-a has the standard uncertainty a / sqrt(3).
TEST(PlacedTime, IsTheMiddleBetweenRequestAndAnswerWithARectangularUncertainty) {
    const PlacedTime placed = placed_between(asked, asked + 6ms);
    EXPECT_EQ(placed.at, asked + 3ms);
    EXPECT_NEAR(seconds_of(placed.uncertainty), 3e-3 / std::sqrt(3.0), 1e-9);
}

TEST(PlacedTime, OfAnAnswerWithoutDelayIsStatedAllTheSame) {
    EXPECT_EQ(placed_between(asked, asked).at, asked);
    EXPECT_GT(placed_between(asked, asked).uncertainty, 0ns) << "0 would be one that is not stated";
    EXPECT_EQ(placed_between(asked, asked - 1ms).at, asked);
    EXPECT_GT(placed_at_end(asked, -1ms).uncertainty, 0ns);
}

/// Requests to an instrument that takes its reading at any moment until its answer is read, on a
/// host that stalls: what the truth is about `at`, in units of u(t).
std::vector<double> errors_in_uncertainties(bool at_the_end) {
    std::mt19937_64 random{11};
    std::uniform_real_distribution<> part{0, 1};
    std::exponential_distribution<> way_s{1 / 2e-3};
    std::vector<double> errors;
    for (int i = 0; i < 20'000; ++i) {
        const double stall_s = part(random) < 0.05 ? 8e-3 * part(random) : 0;
        const MonotonicTime answered = asked + from_seconds(1e-3 + way_s(random) + stall_s);
        const MonotonicTime taken =
            asked + from_seconds(part(random) * seconds_of(answered - asked));
        const PlacedTime placed = at_the_end ? placed_at_end(answered, answered - asked)
                                             : placed_between(asked, answered);
        errors.push_back(seconds_of(placed.at - taken) / seconds_of(placed.uncertainty));
    }
    return errors;
}

TEST(PlacedTime, LiesWithinTwoUncertaintiesOfTheTruthAndClaimsNoMoreThanItKnows) {
    for (const bool at_the_end : {false, true}) {
        const auto errors = errors_in_uncertainties(at_the_end);
        const auto covered =
            std::ranges::count_if(errors, [](double error) { return std::abs(error) <= 2; });
        EXPECT_GE(static_cast<double>(covered), 0.95 * static_cast<double>(errors.size()));
        double squares = 0;
        for (const double error : errors)
            squares += error * error;
        // A standard uncertainty is the root mean square of the error, neither more nor less.
        EXPECT_NEAR(std::sqrt(squares / static_cast<double>(errors.size())), 1, 0.02);
    }
}

TEST(PlacedTime, GoesWithAReadingThatIsAbsentToo) {
    const PlacedTime placed = placed_between(asked, asked + 2ms);
    const Sample good = sample_at(3, placed, 20.5), absent = sample_at(3, placed, std::nullopt);
    EXPECT_EQ(good.value(), 20.5);
    EXPECT_EQ(good.channel, 3);
    EXPECT_EQ(absent.quality(), Quality::absent);
    for (const Sample& sample : {good, absent}) {
        EXPECT_EQ(sample.at, placed.at);
        EXPECT_EQ(sample.time_uncertainty, placed.uncertainty);
    }
}

/// A tape and its first good reading, of which the tape itself tells when it was asked for and when
/// its answer had come.
struct Polled {
    std::string tape, driver, keys;
    double at_ms = 0, uncertainty_ms = 0;
};
std::ostream& operator<<(std::ostream& out, const Polled& which) {
    return out << which.tape;
}

Task<void> run_once(Instrument& instrument, InstrumentContext context) {
    co_await instrument.run(context);
}

class PolledInstrument : public ::testing::TestWithParam<Polled> {};

TEST_P(PolledInstrument, StatesTheUncertaintyOfTheTimeOfEachReading) {
    const Polled& which = GetParam();
    std::ifstream file{test::source_dir() + "/tests/traces/" + which.tape + ".tape"};
    std::stringstream text;
    text << file.rdbuf();
    const auto tape = parse_tape(text.str());
    ASSERT_TRUE(tape) << describe(tape.error());
    testing::VirtualScheduler scheduler;
    const MonotonicTime begin = scheduler.now();
    TapePlayer player{scheduler, *tape};
    testing::SampleRecorder sink;
    const auto instrument = testing::instrument(which.driver, which.keys);
    boost::asio::co_spawn(scheduler.loop(), run_once(*instrument, {&scheduler, &player, &sink}),
                          [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
    scheduler.run_for(1min);
    std::erase_if(sink.samples, [](const Sample& sample) { return !sample.value(); });
    ASSERT_FALSE(sink.samples.empty());
    EXPECT_NEAR(seconds_of(sink.samples[0].at - begin) * 1e3, which.at_ms, 1e-5);
    EXPECT_NEAR(seconds_of(sink.samples[0].time_uncertainty) * 1e3, which.uncertainty_ms, 1e-5);
    for (const Sample& sample : sink.samples)
        EXPECT_GT(sample.time_uncertainty, 0ns);
}

const double root_3 = std::sqrt(3.0);
const std::string serial = "link = \"serial:/dev/null\"\n";
const std::string ids = "link = \"tcp:192.168.1.1:9090\"\nair = \"corrected here\"\n"
                        "wavelength = \"1530 nm\"\nfastest = \"0.5 m/s\"\n"
                        "poll_period = \"100 ms\"\n";

INSTANTIATE_TEST_SUITE_P(
    Tapes,
    PolledInstrument,
    ::testing::Values(
        // asked at 1014 ms, answered at 1018 ms
        Polled{"ids3010", "ids3010", ids, 1016, 2 / root_3},
        // 1000 and 1120 ms: the line came in two parts
        Polled{"vaisala-ptu300", "vaisala", serial + "model = \"ptu300\"\n", 1060, 60 / root_3},
        // 14 and 16 ms
        Polled{"dracal-usbtenki-pth", "dracal-usbtenki", "link = \"usb:any\"\n", 15, 1 / root_3},
        // 140 and 160 ms: the first report
        Polled{"temper-x", "temper", "link = \"usb:any\"\n", 150, 10 / root_3},
        // 70 and 150 ms
        Polled{"temper-serial", "temper-serial", serial, 110, 40 / root_3},
        // sends by itself every 500 ms
        Polled{"dracal-vcp-pth450", "dracal-vcp", serial, 500, 500 / root_3},
        // sends by itself every 40 ms, and a USB frame
        Polled{"lasertex-hpi-3d", "lasertex", serial + "position = \"compensated\"\n", 175,
               41 / root_3},
        // 0 and 40 ms, less 18 characters of 11 bits at 9600 baud: up to 19.375 ms older
        Polled{"gauge-nd-28x", "ascii-gauge", serial + "model = \"nd-28x\"\n", 19.375,
               19.375 / root_3},
        // 100 and 160 ms at 4800 baud: half of the 41.25 ms of a line on the wire is more
        Polled{"gauge-sylvac", "ascii-gauge", serial + "model = \"sylvac\"\n", 118.75, 20.625},
        // 0 and 40 ms, less 24 characters of 10 bits at 19200 baud
        Polled{"gauge-elcomat", "ascii-gauge", serial + "model = \"elcomat-x\"\n", 27.5,
               27.5 / root_3}),
    [](const auto& which) {
        std::string name = which.param.tape;
        std::erase(name, '-');
        return name;
    });

} // namespace
} // namespace axiscal::placed_time_test
