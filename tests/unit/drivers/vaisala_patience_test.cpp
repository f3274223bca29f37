// A Vaisala that falls silent: told its settings anew, then its line is opened anew, under virtual
// time.
#include "drivers/recording/tape_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

namespace axiscal::vaisala_patience_test {
namespace {

using namespace std::chrono_literals;

/// "s", FORM, "send", each with CR.
const std::string stop = "730d", send = "73656e640d";
const std::string form =
    "666f726d20342e322022503d2220502022202220553620332e322022543d2220542022202220553320332e3120"
    "2252483d222052482022202220553420435358205c72205c6e0d";
/// P= 1013.25 hPa, T= asterisks, RH= 38.4 %RH and its CSX, from tests/traces/vaisala-ptu300.tape.
const std::string reading =
    "< 1100000000 "
    "503d20313031332e323520685061202020543d202a2a2a2a2a2027432052483d2033382e3420255248"
    "2031300d0a\n";

/// Written in this order; the player looks at the bytes, not at their time.
std::string written(const std::string& offset_ns, const std::vector<std::string>& commands) {
    std::string transfers;
    for (const std::string& command : commands)
        transfers += "> " + offset_ns + " " + command + "\n";
    return transfers;
}

class VaisalaPatience : public ::testing::Test {
protected:
    /// Plays what is sent and answered; then nothing comes for an hour.
    void play(const std::string& transfers) {
        auto parsed = parse_tape("origin = simulator\n\n" + transfers + "! 3600000000000\n");
        ASSERT_TRUE(parsed) << describe(parsed.error());
        tape = *std::move(parsed);
        boost::asio::co_spawn(scheduler.loop(), run(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
        scheduler.run_for(60s);
    }
    Task<void> run() {
        TapePlayer player{scheduler, tape};
        const InstrumentContext context{&scheduler, &player, &sink};
        const auto result = co_await vaisala->run(context);
        ended = result ? Fault::none : result.error().fault;
        ended_at = scheduler.now();
    }

    testing::VirtualScheduler scheduler;
    MonotonicTime begin = scheduler.now();
    Tape tape;
    testing::SampleRecorder sink;
    std::unique_ptr<Instrument> vaisala =
        testing::instrument("vaisala", "link = \"serial:/dev/none\"\nmodel = \"ptu300\"\n");
    std::optional<Fault> ended;
    MonotonicTime ended_at;
};

TEST_F(VaisalaPatience, ThatFallsSilentIsOpenedAnewBeforeItsLastValueIsTenSecondsOld) {
    play(written("0", {stop, form, send}) + reading +
         written("1100000000", {send, send, send, stop, form, send, send, send}));
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::link_timeout);
    EXPECT_EQ(sink.samples.size(), 3U);
    EXPECT_LT(ended_at - begin, 1.1s + 10s);
}

TEST_F(VaisalaPatience, CountsALineWithoutEndAsOneBadFrame) {
    std::string endless; // 200 characters, none of them an end of line
    for (int i = 0; i < 200; ++i)
        endless += "78";
    play(written("0", {stop, form, send}) + "< 1100000000 " + endless + "\n" +
         written("1100000000", {send, send}));
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::link_timeout);
    EXPECT_EQ(vaisala->counters().bad_frames, 1u);
    EXPECT_TRUE(sink.samples.empty());
}

TEST_F(VaisalaPatience, OnALineWithoutAByteIsOpenedAnewAfterOneRequest) {
    play(written("0", {stop, form, send}));
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::link_timeout);
    EXPECT_LE(ended_at - begin, 2s + 50ms) << "half a second a command, one for the request";
}

} // namespace
} // namespace axiscal::vaisala_patience_test
