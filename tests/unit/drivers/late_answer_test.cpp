// Answers that come after the next request was sent: u(t) covers the request that they belong to.
// An answer cannot tell; so each tape has the truth, by how it was made.
#include "drivers/clock/open_requests.hpp"
#include "drivers/recording/tape_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::late_answer_test {
namespace {

using namespace std::chrono_literals;

constexpr MonotonicTime start{1000s};
const double root_3 = std::sqrt(3.0);

TEST(OpenRequests, AreAnsweredInTheirOrder) {
    OpenRequests requests;
    for (const Duration after : {0ms, 100ms, 200ms})
        requests.asked(start + after);
    for (const Duration after : {0ms, 100ms, 200ms})
        EXPECT_EQ(requests.answered(start + after + 250ms), start + after);
    EXPECT_EQ(requests.answered(start + 500ms), std::nullopt);
}

TEST(OpenRequests, AreWaitedForOnlyAfterAnAnswerThatLeavesOthersOpen) {
    OpenRequests requests;
    requests.asked(start);
    requests.asked(start + 100ms);
    EXPECT_EQ(requests.listen_until(), std::nullopt) << "it may have heard nothing at all";
    requests.answered(start + 120ms);
    EXPECT_EQ(requests.listen_until(), start + 120ms + 240ms);
    requests.answered(start + 220ms);
    EXPECT_EQ(requests.listen_until(), std::nullopt);
}

TEST(OpenRequests, ThatWereLostLongAgoMakeNoAnswerOld) {
    OpenRequests requests;
    requests.asked(start);
    requests.asked(start + 60s);
    EXPECT_EQ(requests.answered(start + 60100ms), start + 60s);
    requests.asked(start + 120s); // the only one: nothing else can be meant
    EXPECT_EQ(requests.answered(start + 125s), start + 120s);
}

Task<void> run_through(Instrument& instrument, InstrumentContext context) {
    co_await instrument.run(context);
}

/// A good sample of one channel, in ms from the first opening.
struct Placed {
    double at_ms, uncertainty_ms;
};

std::vector<Placed> play(const std::string& driver,
                         const std::string& keys,
                         const std::string& transfers,
                         int channel = 0) {
    const auto tape = parse_tape("origin = simulator\n" + transfers + "! 3600000000000\n");
    EXPECT_TRUE(tape);
    testing::VirtualScheduler scheduler;
    const MonotonicTime begin = scheduler.now();
    TapePlayer player{scheduler, *tape};
    testing::SampleRecorder sink;
    const auto made = testing::instrument(driver, "link = \"serial:/dev/null\"\n" + keys);
    boost::asio::co_spawn(scheduler.loop(), run_through(*made, {&scheduler, &player, &sink}),
                          [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
    scheduler.run_for(1min);
    std::vector<Placed> placed;
    for (const Sample& sample : sink.samples)
        if (sample.channel == channel && sample.value())
            placed.push_back(
                {seconds_of(sample.at - begin) * 1e3, seconds_of(sample.time_uncertainty) * 1e3});
    return placed;
}

std::string at(char direction, int offset_ms, const std::string& hex) {
    return std::string{direction} + " " + std::to_string(offset_ms) + "000000 " + hex + "\n";
}

void expect_placed(const std::vector<Placed>& placed, const std::vector<Placed>& expected) {
    ASSERT_EQ(placed.size(), expected.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_NEAR(placed[i].at_ms, expected[i].at_ms, 1e-5) << "sample " << i;
        EXPECT_NEAR(placed[i].uncertainty_ms, expected[i].uncertainty_ms, 1e-5) << "sample " << i;
    }
}

// ND 28x: 18 characters of 11 bits at 9600 baud are 20.625 ms on the wire.
const std::string ask_nd = "02", nd_record = "2b202020312e3030303030202220200d0a";
const std::string nd_keys = "model = \"nd-28x\"\npoll_period = \"100 ms\"\n";

TEST(LateAnswer, OfAGaugeSlowerThanItsPollPeriodIsAsOldAsItsOwnRequest) {
    // Each comes 120 ms after its request: 99.375 ms without the time on the wire.
    const auto placed = play("ascii-gauge", nd_keys,
                             at('>', 0, ask_nd) + at('>', 100, ask_nd) + at('<', 120, nd_record) +
                                 at('<', 220, nd_record));
    expect_placed(placed, {{99.375, 99.375 / root_3}, {199.375, 99.375 / root_3}});
}

TEST(LateAnswer, OfAGaugeThatLostARequestMakesOnlyItselfOld) {
    // The request at 0 is lost. 110 ms: 89.375 ms as old as that one may be; for twice as long
    // nothing comes, so that it is asked again at 268.125 ms.
    const auto placed = play("ascii-gauge", nd_keys,
                             at('>', 0, ask_nd) + at('>', 100, ask_nd) + at('<', 110, nd_record) +
                                 at('>', 268, ask_nd) + at('<', 318, nd_record));
    expect_placed(placed, {{89.375, 89.375 / root_3}, {297.375, (297.375 - 268.125) / root_3}});
}

TEST(LateAnswer, IsNotLookedForWhereAnErrorWasTheAnswer) {
    // ELCOMAT 3000: 24 characters of 10 bits at 19200 baud are 12.5 ms on the wire.
    const std::string ask = "610d0a", dark = "342030303020302e303020302e30300d";
    const std::string good = "342030303320342e35303030303020322e3330303030300d";
    const auto placed =
        play("ascii-gauge", "model = \"elcomat-x\"\npoll_period = \"100 ms\"\n",
             at('>', 0, ask) + at('<', 40, dark) + at('>', 100, ask) + at('<', 140, good));
    expect_placed(placed, {{127.5, 27.5 / root_3}});
}

TEST(LateAnswer, OfAVaisalaLiesBetweenItsOwnRequestAndItself) {
    const std::string send = "73656e640d";
    const std::string form =
        "666f726d20342e322022503d2220502022202220553620332e322022543d2220542022202220553320332e3120"
        "2252483d222052482022202220553420435358205c72205c6e0d";
    const std::string reading = "503d20313031332e323520685061202020543d202a2a2a2a2a2027432052483d20"
                                "33382e34202552482031300d0a";
    // Told its settings until 1000 ms, then asked each 200 ms; each answer takes 250 ms.
    const auto placed = play(
        "vaisala", "model = \"ptu300\"\npoll_period = \"200 ms\"\n",
        at('>', 0, "730d") + at('>', 500, form) + at('<', 600, "4f4b0d0a") + at('>', 1000, send) +
            at('>', 1200, send) + at('<', 1250, reading) + at('<', 1450, reading) +
            at('>', 1600, send) + at('>', 1800, send) + at('<', 1850, reading));
    expect_placed(placed, {{1125, 125 / root_3}, {1325, 125 / root_3}, {1725, 125 / root_3}});
}

TEST(LateAnswer, OfATemperLiesBetweenItsOwnRequestAndItself) {
    const std::string ask = "5265616454656d70";
    const std::string reading =
        "54656d702d496e6e65723a33302e3533205b435d2c33392e3932205b2552485d3c0d0a";
    // Known at 70 ms, then asked each 500 ms; each answer takes 600 ms.
    const auto placed = play(
        "temper-serial", "poll_period = \"500 ms\"\n",
        at('>', 0, "56657273696f6e") + at('<', 20, "54454d506572583233325f56322e300d0a") +
            at('>', 20, "5265616443616c6962") +
            at('<', 60, "496e6e65722d43616c69623a302e30205b435d2c302e30205b2552485d0d0a") +
            at('<', 70, "4f757465722d43616c69623a302e30205b435d2c302e30205b2552485d0d0a") +
            at('>', 70, ask) + at('>', 570, ask) + at('<', 670, reading) + at('<', 1170, reading) +
            at('>', 1570, ask) + at('>', 2070, ask) + at('<', 2170, reading),
        1); // the stick's own temperature
    expect_placed(placed, {{370, 300 / root_3}, {870, 300 / root_3}, {1870, 300 / root_3}});
}

} // namespace
} // namespace axiscal::late_answer_test
