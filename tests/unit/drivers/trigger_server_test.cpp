// The server keeps the time of its map and sleeps otherwise; virtual time, every waking counted.
#include "drivers/loop/spawn.hpp"
#include "drivers/loop/virtual_scheduler.hpp"
#include "drivers/trigger/trigger_server.hpp"
#include "tests/support/port_bench.hpp"

#include <gtest/gtest.h>

namespace axiscal::trigger_server_test {
namespace {

using namespace std::chrono_literals;
using testing::RecordingSink;

class DeskOnTime {
public:
    explicit DeskOnTime(const TriggerConfig& config)
        : server{make_register_map(config)} {
        const TriggerContext context{&scheduler, &sink};
        server.attach(context);
        spawn(scheduler, server.keep_time(&scheduler));
        scheduler.run_for(1s);
    }
    void write_word(int address, std::uint16_t value) {
        const ModbusRequest request{modbus_function::write_register, 0, 0, address, {value}};
        server.write(request, scheduler.now());
    }
    void write_coil(bool high) {
        const std::uint16_t value = high ? 1 : 0;
        const ModbusRequest request{modbus_function::write_coil, 0, 0, 0, {value}};
        server.write(request, scheduler.now());
    }
    VirtualScheduler scheduler;
    RecordingSink sink;
    TriggerServer server;
};

TriggerConfig watched_block() {
    TriggerConfig config;
    config.watch_heartbeat = true;
    return config;
}

TEST(TriggerServer, WithoutACncTimeWakesNobody) {
    for (const TriggerShape shape : {TriggerShape::sequence_block, TriggerShape::single_register,
                                     TriggerShape::coil_and_index}) {
        TriggerConfig config = watched_block();
        config.shape = shape;
        DeskOnTime bench{config};
        bench.scheduler.run_for(1h);
        EXPECT_EQ(bench.scheduler.wakeups(), 0U);
    }
}

TEST(TriggerServer, AHeartbeatThatStopsIsToldAfterTwoSecondsAndOnce) {
    DeskOnTime bench{watched_block()};
    for (std::uint16_t beat = 1; beat <= 100; ++beat) {
        bench.write_word(0, beat);
        bench.scheduler.run_for(500ms);
    }
    EXPECT_TRUE(bench.sink.silences.empty());
    bench.write_word(0, 101);
    bench.scheduler.run_for(2s);
    EXPECT_TRUE(bench.sink.silences.empty()) << "2 s are allowed";
    bench.scheduler.run_for(1ms);
    EXPECT_EQ(bench.sink.silences, std::vector{true});
    const auto before = bench.scheduler.wakeups();
    EXPECT_LE(before, 28U) << "once in two seconds of the fifty";
    bench.scheduler.run_for(1h);
    EXPECT_EQ(bench.scheduler.wakeups(), before);
    bench.write_word(0, 102);
    EXPECT_EQ(bench.sink.silences, (std::vector{true, false}));
    bench.scheduler.run_for(3s);
    EXPECT_EQ(bench.sink.silences, (std::vector{true, false, true}));
}

TEST(TriggerServer, AnEdgeThatWaitsForItsIndexIsDecidedAtTheEndOfItsGrace) {
    TriggerConfig config;
    config.shape = TriggerShape::coil_and_index;
    config.index_grace = 50ms;
    DeskOnTime bench{config};
    bench.write_word(0, 1);
    bench.write_coil(true);
    ASSERT_EQ(bench.sink.events.size(), 1U);
    bench.write_coil(false);
    bench.write_coil(true); // over the number of the request before
    bench.scheduler.run_for(49ms);
    EXPECT_EQ(bench.sink.events.size(), 1U);
    bench.scheduler.run_for(1ms);
    EXPECT_EQ(bench.sink.events.size(), 2U);
    EXPECT_EQ(bench.scheduler.wakeups(), 1U);
}

} // namespace
} // namespace axiscal::trigger_server_test
