// A Sylvac gauge is asked for its unit (SET?); what is said of one that does not tell it, under
// virtual time.
#include "drivers/link/tape_link.hpp"
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
