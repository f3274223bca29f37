// From the durable commit to the register that the CNC reads.

#include "acquisition/journal/journal.hpp"
#include "drivers/trigger/dwell_trigger_port.hpp"
#include "drivers/trigger/single_register_map.hpp"
#include "drivers/trigger/trigger_server.hpp"
#include "tests/support/port_bench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/virtual_scheduler.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <functional>
#include <type_traits>

namespace axiscal::testing::receipt_to_cnc_test {
namespace {

using namespace std::chrono_literals;

// No receipt without a commit: it cannot be made here, and nothing else opens the way to `done`.
static_assert(!std::is_default_constructible_v<JournalReceipt>);
static_assert(!std::is_aggregate_v<JournalReceipt>);
static_assert(!std::constructible_from<JournalReceipt, std::uint16_t, int>);
static_assert(!std::constructible_from<JournalReceipt, int>);
static_assert(!std::assignable_from<JournalReceipt&, std::pair<std::uint16_t, int>>);

template <class Proof>
concept Acknowledged = requires(TriggerPort& port, const Proof& proof) {
    port.acknowledge(proof);
};
static_assert(Acknowledged<JournalReceipt>);
static_assert(!Acknowledged<std::uint16_t> && !Acknowledged<int> && !Acknowledged<PointRecord>);
template <class Map>
concept Finishable = requires(Map& map) {
    map.finish(std::uint16_t{1});
};
static_assert(!Finishable<RegisterMap>);

class ReceiptToCnc : public ::testing::Test {
protected:
    void SetUp() override {
        boost::asio::co_spawn(scheduler.loop(),
                              journal.open(scratch.file("r.axiscal"), random.header()),
                              [this](std::exception_ptr, Result<void> opened) {
                                  ASSERT_TRUE(opened);
                                  ++commits;
                              });
        scheduler.run_for(1s);
        ASSERT_EQ(commits, 1);
    }
    using Take = std::function<void(const JournalReceipt&)>;
    /// Commits a point of this number and hands its receipt over.
    void store(std::uint16_t sequence, Take take) {
        auto point = random.point(commits);
        point.sequence = sequence;
        const int before = commits;
        boost::asio::co_spawn(scheduler.loop(), commit(std::move(point), std::move(take)),
                              [](const std::exception_ptr& escaped) { ASSERT_FALSE(escaped); });
        scheduler.run_for(1s);
        ASSERT_EQ(commits, before + 1);
    }

    Task<void> commit(PointRecord point, Take take) {
        const auto receipt = co_await journal.commit(std::move(point));
        if (!receipt) co_return;
        take(*receipt);
        ++commits;
    }

    ScratchFolder scratch;
    VirtualScheduler scheduler;
    Journal journal{scheduler, JournalThread::caller};
    RandomRun random{52};
    int commits = 0;
};

TEST_F(ReceiptToCnc, IsTheOnlyWayToMoveDone) {
    TriggerServer server{std::make_unique<SingleRegisterMap>()};
    server.arm();
    const auto done = [&] { return server.image(scheduler.now()).input[0]; };
    server.write(ModbusRequest{modbus_function::write_register, 0, 0, 0, {7}}, scheduler.now());
    EXPECT_EQ(done(), 0);
    store(7, [&](const JournalReceipt& receipt) { server.acknowledge(receipt); });
    EXPECT_EQ(done(), 7) << "the number of the durable point, not a count";
    server.refuse(8, Fault::not_still);
    EXPECT_EQ(done(), 7);
    server.arm();
    EXPECT_EQ(done(), 0);
}

TEST_F(ReceiptToCnc, GivesTheNextHaltTheNextNumber) {
    TriggerConfig config;
    config.shape = TriggerShape::dwell;
    config.hysteresis = mm(0.1);
    DwellTriggerPort port{config};
    RunningPort running{port, scheduler};
    scheduler.run_for(0ns);
    const auto halt_at = [&](double target_mm) {
        PortStatus status;
        status.next_nominal_mm = target_mm;
        port.publish(status);
        for (int reading = 0; reading < 150; ++reading) {
            scheduler.run_for(10ms);
            port.position(scheduler.now(), target_mm);
        }
    };
    const auto acknowledge = [&](const JournalReceipt& receipt) { port.acknowledge(receipt); };
    store(65533, acknowledge); // the last durable point of a resumed run
    halt_at(10);
    store(65534, acknowledge);
    port.position(scheduler.now(), 15);
    halt_at(20);
    ASSERT_EQ(running.sink.events.size(), 2U);
    EXPECT_EQ(running.sink.events[0].sequence, 65534);
    EXPECT_EQ(running.sink.events[1].sequence, 1);
}

} // namespace
} // namespace axiscal::testing::receipt_to_cnc_test
