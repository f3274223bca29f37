// A Sylvac gauge is asked for its unit (SET?); what is said of one that does not tell it, under
// virtual time.
#include "drivers/recording/tape_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

namespace axiscal::gauge_unit_test {
namespace {

using namespace std::chrono_literals;

/// "SET?" and its CR, echoed by the opto cable.
const std::string asked = "> 0 5345543f0d\n", echo = "< 1000000 5345543f0d\n";

class UnitOfAGauge : public ::testing::Test {
protected:
    /// The gauge is asked, this comes, then nothing for an hour.
    Error play(const std::string& transfers) {
        auto parsed =
            parse_tape("origin = simulator\n\n" + asked + transfers + "! 3600000000000\n");
        EXPECT_TRUE(parsed);
        tape = *std::move(parsed);
        boost::asio::co_spawn(scheduler.loop(), run(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
        scheduler.run_for(60s);
        return ended;
    }
    Task<void> run() {
        TapePlayer player{scheduler, tape};
        const InstrumentContext context{&scheduler, &player, &sink};
        const auto result = co_await gauge->run(context);
        if (!result) ended = result.error();
    }

    testing::VirtualScheduler scheduler;
    Tape tape;
    testing::SampleRecorder sink;
    std::unique_ptr<Instrument> gauge =
        testing::instrument("ascii-gauge", "link = \"serial:/dev/none\"\nmodel = \"sylvac\"\n");
    Error ended{Fault::none, ""};
};

const std::string millimetres = "4d4d20524553332052454631204e4f52204348412b2042310d";
const std::string inches = "494e20524553352052454631204e4f52204348412b2042310d";
const std::string holds_max = "4d4d20524553332052454631204d4158204348412b2042310d";

std::string at(int ms, const std::string& direction, const std::string& hex) {
    return direction + " " + std::to_string(ms * 1'000'000LL) + " " + hex + "\n";
}
/// Told in mm, 0.500 mm read, then the second value, each asked by "?".
std::string second_value(const std::string& hex) {
    return echo + at(60, "<", millimetres) + at(100, ">", "3f0d") +
           at(160, "<", "2b3030302e3530300d") + at(300, ">", "3f0d") + at(360, "<", hex);
}

// Somebody presses the unit key: +0.01969 is half a millimetre, in inches.
TEST_F(UnitOfAGauge, ThatWasSwitchedGivesNoValueInTheOldOne) {
    play(second_value("2b302e30313936390d"));
    ASSERT_EQ(sink.samples.size(), 2U);
    EXPECT_NEAR(sink.samples[0].value().value(), 0.0005, 1e-12);
    EXPECT_EQ(sink.samples[1].quality(), Quality::signal_error);
    EXPECT_EQ(sink.notes, std::vector{Fault::signal_error});
}

/// Six values in mm, then the settings are asked again, a second after they were told.
std::string asked_again(const std::string& settings, const std::string& value) {
    std::string transfers = echo + at(60, "<", millimetres);
    for (const int ms : {100, 300, 500, 700, 900})
        transfers += at(ms, ">", "3f0d") + at(ms + 60, "<", "2b3030302e3530300d");
    return transfers + at(1100, ">", "5345543f0d") + at(1160, "<", settings) +
           at(1200, ">", "3f0d") + at(1260, "<", value);
}

TEST_F(UnitOfAGauge, IsAskedAgainEachSecond) {
    play(asked_again(inches, "2b302e30313936390d"));
    ASSERT_EQ(sink.samples.size(), 6U);
    EXPECT_NEAR(sink.samples[5].value().value(), 0.01969 * 0.0254, 1e-12);
    EXPECT_TRUE(sink.notes.empty());
}

TEST_F(UnitOfAGauge, ComesWithTheModeInWhichItHoldsAnExtreme) {
    play(asked_again(holds_max, "2b3030302e3530300d"));
    ASSERT_EQ(sink.samples.size(), 6U);
    EXPECT_TRUE(sink.samples[4].value());
    EXPECT_EQ(sink.samples[5].quality(), Quality::signal_error);
    EXPECT_EQ(sink.notes, std::vector{Fault::signal_error});
}

TEST_F(UnitOfAGauge, ThatAnswersWithoutItIsToBeStated) {
    const Error error = play(echo + "< 100000000 2b3031322e3334350d\n"); // +012.345
    EXPECT_EQ(error.fault, Fault::bad_configuration);
    EXPECT_NE(error.detail.find("state `unit` in the station file"), std::string::npos)
        << error.detail;
}

TEST_F(UnitOfAGauge, WhoseLineIsGarbledIsNoMatterOfTheStationFile) {
    const Error error = play(echo + "< 100000000 6b30707a6e727374750d\n");
    EXPECT_EQ(error.fault, Fault::bad_frame);
    EXPECT_NE(error.detail.find("sends what cannot be read"), std::string::npos) << error.detail;
    EXPECT_EQ(gauge->counters().bad_frames, 1U);
}

TEST_F(UnitOfAGauge, ThatSaysNothingIsFirstToBeSwitchedOn) {
    const Error error = play(echo);
    EXPECT_EQ(error.fault, Fault::link_timeout);
    EXPECT_NE(error.detail.find("is it switched on"), std::string::npos) << error.detail;
}

} // namespace
} // namespace axiscal::gauge_unit_test
