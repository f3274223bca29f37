// What a shop is told of a run's faults, and how often.

#include "acquisition/events/event_folder.hpp"
#include "acquisition/station/fault_teller.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

namespace axiscal::fault_teller_test {
namespace {

using namespace std::chrono_literals;

class FaultTellerTest : public ::testing::Test {
protected:
    FaultTellerTest() {
        config_.station = "bay 3";
        config_.state_directory = state_.path();
        config_.webhook = WebhookConfig{};
    }

    /// By the thread that lays them down: waited for, at most ten seconds.
    std::size_t waiting(std::size_t wanted) {
        const auto end = std::chrono::steady_clock::now() + 10s;
        std::size_t count = 0;
        while ((count = waiting_events(state_.path()).size()) < wanted &&
               std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(1ms);
        return count;
    }

    testing::VirtualScheduler scheduler_;
    testing::ScratchFolder state_;
    StationConfig config_;
};

TEST_F(FaultTellerTest, TellsAFaultOnceARun) {
    FaultTeller teller{scheduler_, config_};
    ASSERT_TRUE(teller.open());
    for (int i = 0; i < 3; ++i)
        teller.take("The beam is lost.", {Fault::beam_lost, "r1", ""});
    teller.take("The beam is lost.", {Fault::beam_lost, "r2", ""});
    teller.take("Too fast.", {Fault::overspeed, "r2", ""});
    EXPECT_EQ(waiting(3), 3U);
    const auto first = waiting_body(state_.path(), waiting_events(state_.path()).front());
    const auto body = nlohmann::json::parse(first.value());
    EXPECT_EQ(body["station"], "bay 3");
    EXPECT_EQ(body["kind"], "fault");
}

TEST_F(FaultTellerTest, PassesOverWhatIsNoFaultOfARun) {
    FaultTeller teller{scheduler_, config_};
    ASSERT_TRUE(teller.open());
    teller.take("Run r1 is complete.", {Fault::none, "r1", ""});
    teller.take("It is busy.", {Fault::busy, "r1", ""});
    teller.take("No run is open.", {Fault::beam_lost, "", ""});
    teller.take("The beam is lost.", {Fault::beam_lost, "r1", ""}); // the jobs run in order
    EXPECT_EQ(waiting(1), 1U);
}

TEST_F(FaultTellerTest, AnotherDaemonDoesNotTellItAgain) {
    {
        FaultTeller teller{scheduler_, config_};
        ASSERT_TRUE(teller.open());
        teller.take("The beam is lost.", {Fault::beam_lost, "r1", ""});
        ASSERT_EQ(waiting(1), 1U);
    }
    const std::string id = waiting_events(state_.path()).front();
    ASSERT_TRUE(settle_event(state_.path(), id));
    FaultTeller teller{scheduler_, config_};
    ASSERT_TRUE(teller.open());
    teller.take("The beam is lost.", {Fault::beam_lost, "r1", ""});
    teller.take("Too fast.", {Fault::overspeed, "r1", ""});
    ASSERT_EQ(waiting(1), 1U);
    EXPECT_NE(waiting_events(state_.path()).front(), id);
}

TEST_F(FaultTellerTest, WithoutAWebhookTheFolderGoes) {
    ASSERT_TRUE((FaultTeller{scheduler_, config_}.open()));
    config_.webhook.reset();
    FaultTeller teller{scheduler_, config_};
    ASSERT_TRUE(teller.open());
    teller.take("The beam is lost.", {Fault::beam_lost, "r1", ""});
    EXPECT_FALSE(std::filesystem::exists(state_.file("events")));
}

} // namespace
} // namespace axiscal::fault_teller_test
