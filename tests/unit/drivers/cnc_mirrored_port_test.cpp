#include "drivers/trigger/mirrored_port.hpp"
#include "drivers/trigger/modbus_tcp_port.hpp"
#include "tests/support/cnc_map_bench.hpp"
#include "tests/support/port_bench.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <poll.h>

namespace axiscal::cnc_mirrored_port_test {
namespace {

using namespace testing;
using namespace std::chrono_literals;

/// The CNC's own registers: everybody writes everywhere, and each request is written down.
class CncRegisters final : public RegisterMap {
public:
    explicit CncRegisters(std::vector<ModbusRequest>& requests)
        : requests_{requests} {
        image_.space = AddressSpace{0, 0, largest_table, largest_table, largest_table};
    }
    [[nodiscard]] AddressSpace space() const override { return image_.space; }
    [[nodiscard]] RegisterImage image() const override {
        if (after_read) after_read();
        return image_;
    }
    MapNews write(const ModbusRequest& request, MonotonicTime) override {
        requests_.push_back(request);
        for (std::size_t word = 0; word < request.values.size(); ++word)
            at(request.write_address + static_cast<int>(word)) = request.values[word];
        return {};
    }
    MapNews tick(MonotonicTime) override { return {}; }
    void arm() override {}
    void end_run(RunEnd) override {}
    void refuse(std::uint16_t, Fault) override {}
    void show(const PortStatus&) override {}
    std::uint16_t& at(int word) { return image_.holding[static_cast<std::size_t>(word)]; }

    std::function<void()> after_read; ///< as a PLC that goes on writing meanwhile

protected:
    void finish(std::uint16_t) override {}

private:
    RegisterImage image_;
    std::vector<ModbusRequest>& requests_;
};

class Mirrored : public ::testing::Test {
protected:
    void SetUp() override {
        auto registers = std::make_unique<CncRegisters>(writes);
        plc = registers.get();
        TriggerConfig listening;
        listening.port = 0;
        server = std::make_unique<ModbusTcpPort>(std::move(registers), listening, ClientPatience{});
        server_run = std::make_unique<RunningPort>(*server, scheduler);
        ASSERT_TRUE(pump_until([&] { return server->bound_port() != 0; }));
        TriggerConfig config;
        config.transport = TriggerTransport::tcp_client;
        config.port = server->bound_port();
        config.watch_heartbeat = true;
        port = std::make_unique<MirroredPort>(
            std::make_unique<Acknowledging<SequenceBlockMap>>(false, true), config);
    }
    void connect() {
        running = std::make_unique<RunningPort>(*port, scheduler);
        ASSERT_TRUE(pump_until([&] { return !writes.empty(); }));
    }
    /// Virtual time goes in small steps, so that bytes on the loopback interface keep up.
    bool pump_until(const std::function<bool()>& done) {
        for (int turn = 0; turn < 10'000; ++turn) {
            scheduler.run_for(5ms);
            if (done()) return true;
            if (turn % 10 == 9) ::poll(nullptr, 0, 1);
        }
        return false;
    }
    void pump(int polls) {
        const auto goal = port->counters().requests + static_cast<std::uint64_t>(2 * polls);
        EXPECT_TRUE(pump_until([&] { return port->counters().requests >= goal; }));
    }
    void request(std::uint16_t sequence) {
        plc->at(1) = 2;
        plc->at(2) = sequence;
    }

    VirtualScheduler scheduler;
    std::vector<ModbusRequest> writes;
    CncRegisters* plc = nullptr;
    std::unique_ptr<ModbusTcpPort> server;
    std::unique_ptr<RunningPort> server_run;
    std::unique_ptr<MirroredPort> port;
    std::unique_ptr<RunningPort> running;
};

TEST_F(Mirrored, SeesTheRequestAndWritesTheAnswerIntoTheCnc) {
    port->publish_armed();
    connect();
    plc->at(5) = 0xFFFC;
    plc->at(6) = 0x1FD0;
    request(1);
    ASSERT_TRUE(pump_until([&] { return plc->at(18) == 1; }));
    ASSERT_EQ(running->sink.events.size(), 1U);
    EXPECT_EQ(running->sink.events[0].sequence, 1);
    EXPECT_EQ(running->sink.events[0].nominal_counts, -254000);
    EXPECT_FALSE(running->sink.events[0].standing);
    pump(10);
    EXPECT_EQ(running->sink.events.size(), 1U);
}

TEST_F(Mirrored, StateIsZeroUntilTheStationHasWritten) {
    namespace words = sequence_block;
    EXPECT_EQ(plc->at(words::state), 0);
    EXPECT_EQ(plc->at(words::permit), 0) << "nobody grants anything yet";
    connect();
    EXPECT_EQ(plc->at(words::state), 1);
    EXPECT_EQ(plc->at(words::permit), 1);
}

TEST_F(Mirrored, WritesOnlyWholeBlocksOfItsOwnWords) {
    connect();
    pump(20);
    EXPECT_GT(writes.size(), 3U) << "the heartbeat goes on";
    for (const auto& write : writes) {
        EXPECT_EQ(write.function, modbus_function::write_registers) << "some CNCs have no FC6";
        EXPECT_EQ(write.write_address, 16);
        EXPECT_EQ(write.values.size(), 17U);
    }
}

TEST_F(Mirrored, UsesABlockOnlyWhenBothReadingsAgree) {
    port->publish_armed();
    connect();
    request(1);
    int readings = 0;
    plc->after_read = [&] { // TARGET_INDEX is still being written during the first readings
        if (++readings <= 5) ++plc->at(3);
    };
    ASSERT_TRUE(pump_until([&] { return !running->sink.events.empty(); }));
    EXPECT_GE(port->counters().torn_reads, 1U);
    EXPECT_EQ(running->sink.events[0].target_index, 5);
}

TEST_F(Mirrored, TakesARequestThatStandsThereAtStartAsStanding) {
    request(37);
    connect();
    ASSERT_TRUE(pump_until([&] { return !running->sink.events.empty(); }));
    EXPECT_TRUE(running->sink.events[0].standing);
}

TEST_F(Mirrored, NoticesAFrozenCnc) {
    connect();
    plc->at(0) = 1;
    pump(3);
    EXPECT_TRUE(running->sink.silences.empty());
    ASSERT_TRUE(pump_until([&] { return !running->sink.silences.empty(); }));
    EXPECT_TRUE(running->sink.silences[0]);
    plc->at(0) = 2;
    ASSERT_TRUE(pump_until([&] { return running->sink.silences.size() == 2; }));
    EXPECT_FALSE(running->sink.silences[1]);
}

TEST_F(Mirrored, ConnectsAgainWhenTheCncComesBack) {
    port->publish_armed();
    connect();
    server_run->cancel();
    ASSERT_TRUE(pump_until([&] { return !running->sink.notes.empty(); }));
    EXPECT_EQ(running->sink.notes[0].first, Fault::link_closed);
    TriggerConfig same;
    same.port = port->describe().empty()
                    ? 0
                    : std::stoi(port->describe().substr(port->describe().rfind(':') + 1));
    auto registers = std::make_unique<CncRegisters>(writes);
    plc = registers.get();
    request(1);
    server = std::make_unique<ModbusTcpPort>(std::move(registers), same, ClientPatience{});
    server_run = std::make_unique<RunningPort>(*server, scheduler);
    ASSERT_TRUE(pump_until([&] { return plc->at(18) == 1; }));
    EXPECT_EQ(running->sink.events.size(), 1U);
    EXPECT_EQ(port->counters().reconnects, 1U);
    running->cancel();
    EXPECT_TRUE(pump_until([&] { return running->result.has_value(); }));
    EXPECT_FALSE(running->threw);
}

TEST_F(Mirrored, SaysWhatTheCncsExceptionMeans) {
    TriggerConfig config;
    config.transport = TriggerTransport::tcp_client;
    config.port = server->bound_port();
    config.base_address = 1000;
    MirroredPort astray{std::make_unique<SequenceBlockMap>(false, false), config};
    RunningPort its_run{astray, scheduler};
    ASSERT_TRUE(pump_until([&] { return !its_run.sink.notes.empty(); }));
    EXPECT_EQ(its_run.sink.notes[0].first, Fault::refused);
    EXPECT_NE(its_run.sink.notes[0].second.find("base_address"), std::string::npos);
}

} // namespace
} // namespace axiscal::cnc_mirrored_port_test
