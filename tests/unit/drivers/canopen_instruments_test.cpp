// Both CANopen drivers on a simulated bus under virtual time: what they hand up, and what they say
// of a bus and of nodes that fail.
#include "tests/support/loaded_host.hpp"
#include "tests/support/model_can.hpp"
#include "wire/can/can_instruments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace axiscal::canopen_instruments_test {
namespace {

using namespace std::chrono_literals;

const std::string on_can0 = "link = \"can:can0\"\n";

class CanOpen : public ::testing::Test {
protected:
    CanOpen() {
        bus.nodes = {probe.get(), bar.get()};
        probe->power_on(1);
        bar->power_on(1);
    }
    [[nodiscard]] double now_s() const { return seconds_of(scheduler.now().time_since_epoch()); }
    /// 3 mm + 0.5 mm sin t: 0.5 um a sample at the most, with steps of 1 um.
    static double metres(double seconds) { return 3e-3 + 0.5e-3 * std::sin(seconds); }

    testing::VirtualScheduler scheduler;
    int status = 0, area = 0;
    double celsius = 20.15;
    std::unique_ptr<simulate::CanNode> probe = simulate::make_cantrans(
        125, {[this](double) { return celsius; }, [this](double) { return status; }});
    simulate::TemposonicsWorld world{metres, [this](double) { return area; }};
    std::unique_ptr<simulate::CanNode> bar = simulate::make_temposonics(127, world);
    testing::ModelCanBus bus{scheduler};
    testing::InstrumentOnCan material{scheduler, bus, "canopen-404", on_can0};
    testing::InstrumentOnCan ballbar{scheduler, bus, "canopen-406", on_can0};
};

TEST_F(CanOpen, ProbeIsReadByItsOwnMappingUnitAndDigits) {
    material.start();
    scheduler.run_for(10s);
    EXPECT_TRUE(material.ends.empty()) << material.last_end();
    ASSERT_GE(material.sink.samples.size(), 18U);
    for (const Sample& sample : material.sink.samples)
        EXPECT_DOUBLE_EQ(sample.value().value(), 20.15);
    ASSERT_EQ(material.sink.identities.size(), 1U);
    EXPECT_EQ(material.sink.identities[0].model, "CANtrans T");
    EXPECT_EQ(material.sink.identities[0].serial, "4836");
    EXPECT_EQ(material.counters().bad_frames, 0U);
}

TEST_F(CanOpen, ProbeStatedInTheStationFileNeedsNoObjectsOfItsOwn) {
    auto bare = std::make_unique<simulate::CanNode>(5);
    bare->put_number(0x1000, 0, 0x00020194, 4);
    bare->put_measured(0x7130, 1, [](double) { return std::vector<std::uint8_t>{0xC9, 0x00}; });
    bare->put_tpdo(3, 0x3A5, 0x01, 0, {0x71300110}); // on SYNC, until it is told otherwise
    bus.nodes.push_back(bare.get());
    testing::InstrumentOnCan other{scheduler, bus, "canopen-404",
                                   on_can0 + "node = 5\nunit = \"degC\"\ndigits = 1\n"};
    bare->power_on(now_s());
    other.start();
    scheduler.run_for(5s);
    EXPECT_TRUE(other.ends.empty()) << other.last_end();
    ASSERT_FALSE(other.sink.samples.empty());
    EXPECT_DOUBLE_EQ(other.sink.samples.back().value().value(), 20.1);
}

/// A node without heartbeat whose value comes twice a minute: only guarding tells sooner than 90 s
/// that it is dead.
class GuardedProbe : public CanOpen {
protected:
    GuardedProbe() {
        node.put_number(0x1000, 0, 0x00020194, 4);
        node.put_measured(0x7130, 1, [](double) { return std::vector<std::uint8_t>{0xC9, 0x00}; });
        node.put_tpdo(3, 0x3A5, 0xFE, 0, {0x71300110});
        bus.nodes.push_back(&node);
    }
    [[nodiscard]] std::size_t questions() const {
        const auto asks = [](const CanFrame& frame) { return frame.remote && frame.id == 0x705; };
        return static_cast<std::size_t>(std::ranges::count_if(bus.sent, asks));
    }
    simulate::CanNode node{5};
    testing::InstrumentOnCan slow{
        scheduler, bus, "canopen-404",
        on_can0 + "node = 5\nunit = \"degC\"\ndigits = 1\nsample_period = \"30 s\"\n"};
};

TEST_F(GuardedProbe, IsAskedForItsStateOnceASecond) {
    node.put_guarding();
    node.power_on(now_s());
    slow.start();
    scheduler.run_for(100s);
    EXPECT_TRUE(slow.ends.empty()) << slow.last_end();
    EXPECT_EQ(slow.counters().bad_frames, 0U);
    EXPECT_NEAR(static_cast<double>(questions()), 100, 2);
    ASSERT_FALSE(slow.sink.samples.empty());
    EXPECT_DOUBLE_EQ(slow.sink.samples.back().value().value(), 20.1);
}

TEST_F(GuardedProbe, ThatDiesIsGivenUpWithinFourSecondsAndComesBack) {
    node.put_guarding();
    node.power_on(now_s());
    slow.start();
    scheduler.run_for(40s);
    node.power_off();
    scheduler.run_for(4s);
    ASSERT_FALSE(slow.ends.empty());
    EXPECT_EQ(slow.ends.front().fault, Fault::link_timeout);
    EXPECT_NE(slow.last_end().find("node 5 on CAN can0 does not answer"), std::string::npos);
    const auto samples = slow.sink.samples.size();
    node.power_on(now_s());
    scheduler.run_for(40s);
    EXPECT_GT(slow.sink.samples.size(), samples);
}

TEST_F(GuardedProbe, ThatSomebodyStopsIsNoticedByItsAnswer) {
    node.put_guarding();
    node.power_on(now_s());
    slow.start();
    scheduler.run_for(40s);
    node.take({0, {0x80, 5}, false}, now_s());
    scheduler.run_for(2s);
    ASSERT_EQ(slow.ends.size(), 1U);
    EXPECT_NE(slow.last_end().find("taken out of operation"), std::string::npos);
}

TEST_F(GuardedProbe, OneLostAnswerIsNoSilence) {
    node.put_guarding();
    node.power_on(now_s());
    slow.start();
    scheduler.run_for(40s);
    node.take({0x705, {}, true}, now_s()); // its answer comes to nobody
    scheduler.run_for(10s);
    EXPECT_TRUE(slow.ends.empty()) << slow.last_end();
    EXPECT_EQ(slow.counters().bad_frames, 1U) << "the toggle bit that came twice";
}

TEST_F(GuardedProbe, ThatDoesNotKnowGuardingIsAskedThreeTimesAndWatchedByItsValues) {
    node.power_on(now_s());
    slow.start();
    scheduler.run_for(100s);
    EXPECT_TRUE(slow.ends.empty()) << slow.last_end();
    EXPECT_EQ(questions(), 3U);
    EXPECT_GE(slow.sink.samples.size(), 2U);
}

TEST_F(GuardedProbe, WithAHeartbeatThatCannotBeChangedIsHeardAndNotAsked) {
    node.put_number(0x1017, 0, 3000, 2);
    node.power_on(now_s());
    slow.start();
    scheduler.run_for(100s);
    EXPECT_TRUE(slow.ends.empty()) << slow.last_end();
    EXPECT_EQ(questions(), 0U);
    node.power_off();
    scheduler.run_for(11s); // 2.5 of its own
    EXPECT_FALSE(slow.ends.empty());
}

TEST_F(CanOpen, PdosShorterThanTheirMappingAreNoReadingsAndAreTold) {
    material.start();
    ballbar.start();
    scheduler.run_for(5s);
    const auto good = material.sink.samples.size();
    bus.longest = 3; // both devices begin with a value of four bytes
    scheduler.run_for(5s);
    EXPECT_LE(material.sink.samples.size(), good + 1) << "one may have been on its way";
    EXPECT_FALSE(ballbar.sink.samples.back().value());
    EXPECT_GE(material.counters().bad_frames, 8U) << "two a second";
    EXPECT_GE(ballbar.counters().bad_frames, 4900U) << "a thousand a second";
    EXPECT_NE(std::ranges::count(material.sink.notes, Fault::bad_frame), 0);
    EXPECT_NE(std::ranges::count(ballbar.sink.notes, Fault::bad_frame), 0);
    bus.longest = 8;
    scheduler.run_for(1s);
    EXPECT_TRUE(ballbar.sink.samples.back().value());
    EXPECT_GT(material.sink.samples.size(), good);
    EXPECT_TRUE(ballbar.ends.empty()) << ballbar.last_end();
}

TEST_F(CanOpen, ANodeWithAHeartbeatIsNotAskedByRemoteFrames) {
    material.start();
    ballbar.start();
    scheduler.run_for(10s);
    for (const CanFrame& frame : bus.sent)
        EXPECT_FALSE(frame.remote) << frame.id;
}

TEST_F(CanOpen, ProbeWithoutUnitOrInputIsRefusedWithTheWayOut) {
    testing::InstrumentOnCan two{scheduler, bus, "canopen-404", on_can0 + "inputs = 2\n"};
    two.start();
    scheduler.run_for(3s);
    EXPECT_NE(two.last_end().find("input 2"), std::string::npos) << two.last_end();
    testing::InstrumentOnCan wrong{scheduler, bus, "canopen-404", on_can0 + "node = 127\n"};
    wrong.start();
    scheduler.run_for(3s);
    EXPECT_NE(wrong.last_end().find("profile 406, not 404"), std::string::npos) << wrong.last_end();
}

TEST_F(CanOpen, BrokenProbeHasNoNumberAndSaysSo) {
    material.start();
    scheduler.run_for(3s);
    status = 1;
    probe->tell_emergency(0x5030, 1, {0, 1});
    scheduler.run_for(2s);
    EXPECT_EQ(material.sink.samples.back().quality(), Quality::absent);
    EXPECT_EQ(material.sink.notes, std::vector{Fault::signal_error});
    status = 0;
    probe->tell_emergency(0, 0, {});
    scheduler.run_for(2s);
    EXPECT_TRUE(material.sink.samples.back().value());
    EXPECT_TRUE(material.ends.empty());
}

// CiA 301, 7.2.7.1: 0000h says that one fault is over; the register tells whether another lasts.
TEST_F(CanOpen, ProbeHasNoNumberUntilNoFaultIsLeft) {
    material.start();
    scheduler.run_for(3s);
    using Emergency = std::pair<std::uint16_t, std::uint8_t>;
    for (const auto& [code, error_register] :
         {Emergency{0x5030, 0x81}, Emergency{0x4210, 0x89}, Emergency{0x0000, 0x81}}) {
        probe->tell_emergency(code, error_register, {});
        scheduler.run_for(2s);
        EXPECT_EQ(material.sink.samples.back().quality(), Quality::absent) << code;
    }
    probe->tell_emergency(0, 0, {});
    scheduler.run_for(2s);
    EXPECT_TRUE(material.sink.samples.back().value());
}

TEST_F(CanOpen, AFaultThatWasToldBeforeAnybodyListenedIsFoundInTheRegister) {
    probe->put_number(0x1001, 0, 0x81, 1);
    bar->put_number(0x1001, 0, 0x81, 1);
    material.start();
    ballbar.start();
    scheduler.run_for(3s);
    EXPECT_EQ(material.sink.samples.back().quality(), Quality::absent);
    EXPECT_EQ(material.sink.notes, std::vector{Fault::signal_error});
    EXPECT_EQ(ballbar.sink.samples.back().quality(), Quality::signal_error);
    for (auto* node : {probe.get(), bar.get()})
        node->tell_emergency(0, 0, {});
    scheduler.run_for(2s);
    EXPECT_TRUE(material.sink.samples.back().value());
    EXPECT_TRUE(ballbar.sink.samples.back().value());
}

std::ptrdiff_t reads_of_the_register(const std::vector<CanFrame>& sent) {
    const CanFrame read = plain_frame(0x600 + 125, {0x40, 0x01, 0x10, 0, 0, 0, 0, 0});
    return std::ranges::count(sent, read);
}

// 7.5.2.2: the register is the device's; the emergency tells it as it was when that was sent.
TEST_F(CanOpen, TheRegisterIsReadAgainAfterEachEmergency) {
    material.start();
    scheduler.run_for(3s);
    const auto at_the_start = reads_of_the_register(bus.sent);
    EXPECT_EQ(at_the_start, 1);
    probe->tell_emergency(0x5030, 0x81, {});
    scheduler.run_for(2s);
    EXPECT_EQ(reads_of_the_register(bus.sent), at_the_start + 1);
    probe->tell_emergency(0, 0, {});
    probe->put_number(0x1001, 0, 0x81, 1); // what it says is over is not
    scheduler.run_for(2s);
    EXPECT_EQ(reads_of_the_register(bus.sent), at_the_start + 2);
    EXPECT_EQ(material.sink.samples.back().quality(), Quality::absent);
    EXPECT_EQ(material.sink.notes, (std::vector{Fault::signal_error, Fault::signal_error}));
    probe->tell_emergency(0, 0, {});
    scheduler.run_for(2s);
    EXPECT_TRUE(material.sink.samples.back().value());
    EXPECT_TRUE(material.ends.empty()) << material.last_end();
}

// An answer that comes before the last emergency was heard says nothing of it.
TEST_F(CanOpen, AFaultThatCameAndWentAtOnceLeavesNumbers) {
    material.start();
    scheduler.run_for(3s);
    probe->tell_emergency(0x5030, 0x81, {});
    probe->tell_emergency(0, 0, {});
    scheduler.run_for(2s);
    EXPECT_TRUE(material.sink.samples.back().value());
    EXPECT_TRUE(material.ends.empty()) << material.last_end();
}

TEST_F(CanOpen, ARegisterThatTellsOfTheBusAloneSpoilsNoNumber) {
    probe->put_number(0x1001, 0, 0x11, 1);
    material.start();
    scheduler.run_for(3s);
    EXPECT_TRUE(material.sink.samples.back().value());
}

TEST_F(CanOpen, BallbarStreamsAtOneKilohertzWithoutAHole) {
    ballbar.start();
    scheduler.run_for(10s);
    EXPECT_TRUE(ballbar.ends.empty()) << ballbar.last_end();
    const auto& samples = ballbar.sink.samples;
    ASSERT_GE(samples.size(), 9500U);
    EXPECT_EQ(ballbar.counters().gaps, 0U);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        ASSERT_EQ(samples[i].device_count, samples[i - 1].device_count + 1);
        ASSERT_NEAR(seconds_of(samples[i].at - samples[i - 1].at), 1e-3, 1e-6);
    }
    for (const Sample& sample : samples) {
        // The model measures when it sends, 1 ms after the driver's stamp: 0.5 um; a step is 1 um.
        const double seconds = seconds_of(sample.at.time_since_epoch());
        ASSERT_NEAR(sample.value().value(), metres(seconds), 1.1e-6);
    }
    EXPECT_EQ(ballbar.sink.identities.at(0).model, "Temposonics E-series");
}

/// A frame is on the wire for 0.1 to 0.5 ms; a host that stalls stamps what waited when it goes on.
class LateHost {
public:
    MonotonicTime stamps(MonotonicTime sent) {
        const double ready_s = seconds_of(sent.time_since_epoch()) + 1e-4 + 4e-4 * part();
        const double stalled_until_s = stalls_.until_s(ready_s, [this] { return part(); });
        last_s_ = std::max({ready_s, stalled_until_s, last_s_});
        return MonotonicTime{from_seconds(last_s_)};
    }
    /// Since the end of the measuring cycle of 1 ms that a frame tells of.
    double age_s() { return 1e-3 * part(); }

private:
    double part() { return std::uniform_real_distribution<>{}(random_); }
    std::mt19937_64 random_{5};
    testing::HostStalls stalls_;
    double last_s_ = 0;
};

TEST_F(CanOpen, BallbarStatesATimeWithinTwoUncertaintiesOfTheTruth) {
    LateHost host;
    bus.stamp = [&](MonotonicTime sent) { return host.stamps(sent); };
    constexpr double speed = 0.1; // m/s: a value tells when it was measured, to 10 us
    simulate::TemposonicsWorld moving{
        [&](double seconds) { return speed * (seconds - host.age_s()); }, [](double) { return 0; }};
    const auto node = simulate::make_temposonics(126, moving);
    bus.nodes.push_back(node.get());
    testing::InstrumentOnCan other{scheduler, bus, "canopen-406", on_can0 + "node = 126\n"};
    node->power_on(now_s());
    other.start();
    scheduler.run_for(20s);
    EXPECT_TRUE(other.ends.empty()) << other.last_end();
    EXPECT_EQ(other.counters().lost_records, 0U);
    ASSERT_GE(other.sink.samples.size(), 19'000U);
    std::size_t covered = 0;
    for (const Sample& sample : other.sink.samples) {
        const double off_s =
            seconds_of(sample.at.time_since_epoch()) - sample.value().value() / speed;
        if (std::abs(off_s) <= 2 * seconds_of(sample.time_uncertainty)) ++covered;
        ASSERT_LE(sample.time_uncertainty, 1ms) << "one period of the stream";
    }
    EXPECT_GE(covered, other.sink.samples.size() * 95 / 100);
}

TEST_F(CanOpen, BallbarCanGrowTheOtherWayByAStepOfTheStationFile) {
    testing::InstrumentOnCan other{scheduler, bus, "canopen-406",
                                   on_can0 + "position_step = \"2 um\"\nreversed = true\n"};
    other.start();
    scheduler.run_for(3s);
    ASSERT_FALSE(other.sink.samples.empty());
    EXPECT_NEAR(other.sink.samples.back().value().value(), -2 * metres(now_s()), 5e-6);
}

TEST_F(CanOpen, BallbarTellsOneLostPositionInTheSingular) {
    ballbar.start();
    scheduler.run_for(3s);
    bus.drop = 1;
    scheduler.run_for(1s);
    EXPECT_EQ(ballbar.counters().lost_records, 1U);
    EXPECT_NE(ballbar.sink.text().find("1 position of the stream is missing"), std::string::npos)
        << ballbar.sink.text();
}

TEST_F(CanOpen, BallbarCountsWhatIsMissing) {
    ballbar.start();
    scheduler.run_for(3s);
    bus.swallow = 25; // lost on the wire: only time tells
    scheduler.run_for(1s);
    EXPECT_EQ(ballbar.counters().lost_records, 25U);
    bus.drop = 10; // dropped by the kernel, which says so
    scheduler.run_for(1s);
    EXPECT_EQ(ballbar.counters().lost_records, 35U);
    EXPECT_EQ(ballbar.counters().gaps, 2U);
    EXPECT_EQ(ballbar.sink.notes, (std::vector{Fault::samples_lost, Fault::samples_lost}));
    const auto& counters = ballbar.counters();
    EXPECT_EQ(ballbar.sink.samples.back().device_count, counters.samples + counters.lost_records);
}

TEST_F(CanOpen, BallbarHasNoNumberOutsideOfItsAreaOrWithAFault) {
    ballbar.start();
    scheduler.run_for(3s);
    area = 1;
    scheduler.run_for(500ms);
    EXPECT_EQ(ballbar.sink.samples.back().quality(), Quality::absent);
    area = 0;
    bar->tell_emergency(0xFF00, 0x81, {1}); // the magnet is missing
    scheduler.run_for(500ms);
    EXPECT_EQ(ballbar.sink.samples.back().quality(), Quality::signal_error);
    bar->tell_emergency(0, 0, {});
    scheduler.run_for(500ms);
    EXPECT_TRUE(ballbar.sink.samples.back().value());
}

TEST_F(CanOpen, DeadNodesAreGivenUpInOneSentenceAndComeBackWithin5Seconds) {
    material.start();
    ballbar.start();
    scheduler.run_for(5s);
    probe->power_off();
    bar->power_off();
    scheduler.run_for(20s);
    for (const auto* one : {&material, &ballbar}) {
        ASSERT_FALSE(one->ends.empty());
        for (const Error& end : one->ends) {
            EXPECT_EQ(end.fault, Fault::link_timeout);
            EXPECT_EQ(describe(end), describe(one->ends.front()));
        }
    }
    EXPECT_NE(ballbar.last_end().find("node 127 on CAN can0 does not answer"), std::string::npos);
    const auto probe_samples = material.sink.samples.size();
    const auto samples = ballbar.sink.samples.size();
    probe->power_on(now_s());
    bar->power_on(now_s());
    scheduler.run_for(5s);
    EXPECT_GT(material.sink.samples.size(), probe_samples);
    EXPECT_GT(ballbar.sink.samples.size(), samples);
    EXPECT_EQ(ballbar.sink.samples.back().epoch, 1U);
    EXPECT_EQ(ballbar.counters().restarts, 1U);
}

TEST_F(CanOpen, NodeThatWasResetIsSetUpAgain) {
    material.start();
    ballbar.start();
    scheduler.run_for(5s);
    bar->power_on(now_s());
    scheduler.run_for(5s);
    ASSERT_EQ(ballbar.ends.size(), 1U);
    EXPECT_EQ(ballbar.ends.front().fault, Fault::link_closed);
    EXPECT_NE(ballbar.last_end().find("was reset"), std::string::npos);
    EXPECT_TRUE(material.ends.empty()) << "the other was not disturbed";
    EXPECT_TRUE(ballbar.sink.samples.back().value());
    EXPECT_EQ(ballbar.sink.samples.back().epoch, 1U);
}

TEST_F(CanOpen, NodeThatSomebodyStopsIsStartedAgain) {
    material.start();
    scheduler.run_for(5s);
    probe->take({0, {0x80, 125}}, now_s());
    scheduler.run_for(5s);
    ASSERT_EQ(material.ends.size(), 1U);
    EXPECT_NE(material.last_end().find("taken out of operation"), std::string::npos);
    EXPECT_GT(seconds_of(material.sink.samples.back().at.time_since_epoch()), now_s() - 1);
}

TEST_F(CanOpen, BusThatIsMissingDownOrOffIsNamed) {
    ballbar.start();
    scheduler.run_for(5s);
    for (const auto& [state, words] :
         {std::pair{CanState::down, "can0 is down"}, std::pair{CanState::bus_off, "bus-off"},
          std::pair{CanState::missing, "no CAN interface can0"}}) {
        bus.state = state;
        scheduler.run_for(3s);
        EXPECT_EQ(ballbar.ends.back().fault, Fault::link_closed);
        EXPECT_NE(ballbar.last_end().find(words), std::string::npos) << ballbar.last_end();
        const auto samples = ballbar.sink.samples.size();
        bus.state = CanState::up;
        scheduler.run_for(5s);
        EXPECT_GT(ballbar.sink.samples.size(), samples);
    }
}

TEST_F(CanOpen, NothingIsHeardButWhatIsMeantForTheInstruments) {
    material.start();
    scheduler.run_for(5s); // the ballbar's node is on the bus, but nobody started it
    for (const CanFrame& frame : bus.sent) {
        const bool for_probe =
            frame.id == 0x67D || (frame.id == 0 && frame.bytes()[1] == std::byte{125});
        EXPECT_TRUE(for_probe) << frame.id;
    }
}

TEST(CanOpenKeys, AreRefusedWithTheWayOut) {
    const auto refusal = [](const std::string& driver, const std::string& keys) {
        const auto made = testing::make_instrument(driver, keys);
        return made.refusals.empty() ? std::string{} : made.refusals.front().describe();
    };
    EXPECT_NE(refusal("canopen-404", "link = \"can0\"\n").find("\"can:can0\""), std::string::npos);
    EXPECT_NE(refusal("canopen-404", "link = \"can:can0 up\"\n").find("can:can0"),
              std::string::npos);
    EXPECT_NE(refusal("canopen-404", "").find("link"), std::string::npos);
    EXPECT_NE(refusal("canopen-404", on_can0 + "node = 128\n").find("node"), std::string::npos);
    EXPECT_NE(refusal("canopen-406", on_can0 + "sample_period = \"1500 us\"\n").find("whole"),
              std::string::npos);
    EXPECT_EQ(refusal("canopen-406", on_can0 + "node = 3\nwork_area = \"ignored\"\n"), "");
}

} // namespace
} // namespace axiscal::canopen_instruments_test
