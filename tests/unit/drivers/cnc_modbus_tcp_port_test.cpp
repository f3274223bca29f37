#include "drivers/trigger/mbap_framer.hpp"
#include "drivers/trigger/modbus_tcp_port.hpp"
#include "drivers/turned_away.hpp"
#include "tests/support/cnc_map_bench.hpp"
#include "tests/support/port_bench.hpp"
#include "tests/support/raw_modbus_client.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <poll.h>
#include <random>

namespace axiscal::cnc_modbus_tcp_port_test {
namespace {

using namespace testing;
using namespace std::chrono_literals;

TriggerConfig any_free_port() {
    TriggerConfig config;
    config.port = 0;
    return config;
}

/// Sockets are real, time is not: deadlines pass only where a test says so.
class ModbusTcp : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(pump_until([&] { return port.bound_port() != 0; }));
    }
    /// Gives the loop and the loopback interface turns; virtual time stands still. The bound on
    /// turns only ends a failing test.
    bool pump_until(const std::function<bool()>& done) {
        for (int turn = 0; turn < 10'000; ++turn) {
            scheduler.run_for(0ns);
            if (done()) return true;
            ::poll(nullptr, 0, 1);
        }
        return false;
    }
    RawModbusClient connect(int receive_buffer = 0) {
        const int before = port.clients();
        RawModbusClient client{port.bound_port(), receive_buffer};
        EXPECT_TRUE(pump_until([&] { return port.clients() == before + 1; }));
        return client;
    }
    bool receives(RawModbusClient& client, std::size_t size) {
        return pump_until([&] {
            client.receive();
            return client.received.size() >= size;
        });
    }
    bool is_hung_up(RawModbusClient& client) {
        return pump_until([&] {
            client.receive();
            return client.hung_up;
        });
    }
    Bytes ask(RawModbusClient& client, const Bytes& pdu, std::size_t answer_size) {
        client.received.clear();
        client.send(framed(7, pdu));
        EXPECT_TRUE(receives(client, 7 + answer_size));
        return client.received.size() < 7
                   ? Bytes{}
                   : Bytes(client.received.begin() + 7, client.received.end());
    }

    VirtualScheduler scheduler;
    ModbusTcpPort port{std::make_unique<Acknowledging<SequenceBlockMap>>(false, false),
                       any_free_port(), ClientPatience{}};
    RunningPort running{port, scheduler};
};

const Bytes read_request_words{3, 0, 0, 0, 3}; // CNC_HEARTBEAT, CMD, CMD_SEQ
const Bytes zero_words{3, 6, 0, 0, 0, 0, 0, 0};

TEST_F(ModbusTcp, CarriesOneRequestFromBlockWriteToAcknowledge) {
    auto cnc = connect();
    EXPECT_EQ(ask(cnc, {16, 0, 1, 0, 2, 4, 0, 2, 0, 1}, 5), (Bytes{16, 0, 1, 0, 2}));
    ASSERT_EQ(running.sink.events.size(), 1U);
    EXPECT_EQ(running.sink.events[0].sequence, 1);
    EXPECT_EQ(running.sink.events[0].at, scheduler.now());
    EXPECT_EQ(ask(cnc, {3, 0, 18, 0, 2}, 6), (Bytes{3, 4, 0, 1, 0, 0})); // ACK_SEQ 1, RESULT 0
    EXPECT_EQ(ask(cnc, {4, 0, 18, 0, 1}, 4), (Bytes{4, 2, 0, 1}));       // the same by FC4
    EXPECT_EQ(ask(cnc, {6, 0, 2, 0, 2}, 5), (Bytes{6, 0, 2, 0, 2}));
    EXPECT_EQ(running.sink.events.size(), 2U);
}

TEST_F(ModbusTcp, WritesBeforeItReadsInOneReadWriteRequest) {
    auto cnc = connect();
    // writes CMD 2 and CMD_SEQ 1, reads words 18 and 19
    EXPECT_EQ(ask(cnc, {23, 0, 18, 0, 2, 0, 1, 0, 2, 4, 0, 2, 0, 1}, 6),
              (Bytes{23, 4, 0, 1, 0, 0}));
}

TEST_F(ModbusTcp, ShowsAHeartbeatOfTheMomentOfReading) {
    auto cnc = connect();
    const auto before = ask(cnc, {3, 0, 16, 0, 1}, 4);
    scheduler.run_for(1s);
    const auto after = ask(cnc, {3, 0, 16, 0, 1}, 4);
    EXPECT_EQ(before[2] * 256 + before[3] + 10, after[2] * 256 + after[3]);
}

TEST_F(ModbusTcp, AnswersIllegalRequestsWithTheProtocolsExceptions) {
    auto cnc = connect();
    EXPECT_EQ(ask(cnc, {3, 0, 40, 0, 1}, 2), (Bytes{0x83, 2}));
    EXPECT_EQ(ask(cnc, {6, 0, 18, 0, 9}, 2), (Bytes{0x86, 2})) << "ACK_SEQ is ours";
    EXPECT_EQ(ask(cnc, {1, 0, 0, 0, 1}, 2), (Bytes{0x81, 1}));
    EXPECT_EQ(ask(cnc, {3, 0, 0, 0, 0}, 2), (Bytes{0x83, 3}));
    EXPECT_EQ(ask(cnc, {0x2B, 0x0E, 1, 0}, 2), (Bytes{0xAB, 1}));
    EXPECT_EQ(ask(cnc, read_request_words, 8), zero_words) << "nothing was written";
    EXPECT_EQ(port.counters().requests, 6U);
    EXPECT_EQ(port.counters().exceptions, 5U);
}

TEST_F(ModbusTcp, AnswersAFrameThatComesByteByByte) {
    auto cnc = connect();
    for (const auto byte : framed(9, read_request_words)) {
        cnc.send({&byte, 1});
        pump_until([] { return true; });
    }
    ASSERT_TRUE(receives(cnc, 15));
    EXPECT_EQ(Bytes(cnc.received.begin() + 7, cnc.received.end()), zero_words);
}

TEST_F(ModbusTcp, AnswersRequestsSentInOnePieceOneByOne) {
    auto cnc = connect();
    Bytes both = framed(1, read_request_words);
    const Bytes second = framed(2, read_request_words);
    both.insert(both.end(), second.begin(), second.end());
    cnc.send(both);
    ASSERT_TRUE(receives(cnc, 30));
    EXPECT_EQ(cnc.received[1], 1);
    EXPECT_EQ(cnc.received[16], 2);
}

TEST_F(ModbusTcp, HangsUpOnAHeaderThatIsNeverFinishedAndServesTheOther) {
    auto slow = connect();
    auto good = connect();
    slow.send(Bytes{0, 1, 0});
    for (int asked = 0; asked < 20; ++asked)
        EXPECT_EQ(ask(good, read_request_words, 8), zero_words);
    scheduler.run_for(1900ms);
    slow.receive();
    EXPECT_FALSE(slow.hung_up);
    scheduler.run_for(200ms);
    EXPECT_TRUE(is_hung_up(slow));
    EXPECT_EQ(port.counters().hung_up, 1U);
    EXPECT_EQ(ask(good, read_request_words, 8), zero_words);
}

TEST_F(ModbusTcp, HangsUpOnAClientThatDripsOneFrameForTooLong) {
    auto slow = connect();
    for (const auto byte : Bytes{0, 1, 0, 0, 0}) {
        slow.send({&byte, 1});
        pump_until([] { return true; });
        scheduler.run_for(500ms); // each byte in time, the frame not
    }
    EXPECT_TRUE(is_hung_up(slow));
}

TEST_F(ModbusTcp, KeepsAnIdleClientThroughALongDwell) {
    auto cnc = connect();
    EXPECT_EQ(ask(cnc, read_request_words, 8), zero_words);
    scheduler.run_for(9min);
    EXPECT_EQ(ask(cnc, read_request_words, 8), zero_words);
    scheduler.run_for(11min);
    EXPECT_TRUE(is_hung_up(cnc));
}

TEST_F(ModbusTcp, IsNotHeldUpByAClientThatNeverReads) {
    auto deaf = connect(2048);
    auto good = connect();
    const Bytes greedy = framed(3, {3, 0, 0, 0, 33});
    std::size_t offset = 0;
    for (int burst = 0; burst < 20'000 && port.clients() == 2; ++burst) {
        const auto sent = deaf.send(std::span{greedy}.subspan(offset));
        offset = (offset + sent) % greedy.size();
        if (burst % 64 == 0) scheduler.run_for(0ns);
        if (sent == 0) break; // every buffer on the way is full
    }
    const auto before = port.counters().requests;
    for (int asked = 0; asked < 50; ++asked)
        ASSERT_EQ(ask(good, read_request_words, 8), zero_words);
    EXPECT_GE(port.counters().requests, before + 50);
    scheduler.run_for(3s); // nobody takes the answer
    EXPECT_EQ(port.counters().hung_up, 1U);
    EXPECT_EQ(port.clients(), 1);
    EXPECT_EQ(ask(good, read_request_words, 8), zero_words);
}

TEST_F(ModbusTcp, HangsUpOnWhatIsNotModbus) {
    const std::vector<Bytes> garbage{
        {'G', 'E', 'T', ' ', '/', ' ', 'H', 'T', 'T', 'P'}, // protocol not 0
        {0, 1, 0, 0, 0, 255, 1, 3},                         // longer than a frame may be
        {0, 1, 0, 0, 0xFF, 0xFF, 1, 3},                     // oversized
        {0, 1, 0, 0, 0, 1, 1},                              // no room for a function
        {0, 1, 0, 0, 0, 6, 1, 0x83, 0, 0, 0, 1},            // an answer, not a request
        {0, 1, 0, 0, 0, 6, 1, 0, 0, 0, 0, 1},               // function 0
    };
    auto good = connect();
    for (const auto& bytes : garbage) {
        auto rude = connect();
        rude.send(bytes);
        EXPECT_TRUE(is_hung_up(rude)) << ::testing::PrintToString(bytes);
        EXPECT_TRUE(rude.received.empty());
    }
    EXPECT_EQ(port.counters().hung_up, garbage.size());
    EXPECT_EQ(ask(good, read_request_words, 8), zero_words);
}

TEST_F(ModbusTcp, SurvivesRandomBytes) {
    std::mt19937 random{42};
    for (int trial = 0; trial < 200; ++trial) {
        std::optional<RawModbusClient> rude{connect()};
        Bytes noise(1 + random() % 300);
        for (auto& byte : noise)
            byte = static_cast<std::uint8_t>(random());
        if (trial % 2 == 0 && noise.size() > 5) noise[2] = noise[3] = noise[4] = 0; // looks right
        rude->send(noise);
        scheduler.run_for(3s);
        rude.reset();
        ASSERT_TRUE(pump_until([&] { return port.clients() == 0; }));
    }
    auto good = connect();
    EXPECT_EQ(ask(good, {3, 0, 18, 0, 1}, 4).size(), 4U);
}

// MODBUS Messaging on TCP/IP V1.0b, 4.2: of the connections without priority the one unused longest.
TEST_F(ModbusTcp, TheLongestIdleConnectionGivesWayToTheNinth) {
    std::vector<RawModbusClient> vanished;
    for (int taken = 0; taken < 8; ++taken) {
        vanished.push_back(connect());
        EXPECT_EQ(ask(vanished.back(), read_request_words, 8), zero_words);
        scheduler.run_for(1s);
    }
    EXPECT_EQ(ask(vanished[0], read_request_words, 8), zero_words); // now [1] is idle longest
    RawModbusClient ninth{port.bound_port()};
    EXPECT_EQ(ask(ninth, read_request_words, 8), zero_words);
    EXPECT_TRUE(is_hung_up(vanished[1]));
    EXPECT_EQ(port.counters().refused, 1U);
    for (const std::size_t i : {0, 2, 3, 4, 5, 6, 7})
        EXPECT_EQ(ask(vanished[i], read_request_words, 8), zero_words) << i;
    ASSERT_TRUE(pump_until([&] { return port.clients() == 8; }));
}

TEST_F(ModbusTcp, AHundredAbandonedConnectionsKeepNobodyOut) {
    auto cnc = connect();
    std::vector<RawModbusClient> abandoned;
    for (int i = 0; i < 100; ++i) {
        abandoned.emplace_back(port.bound_port());
        scheduler.run_for(10ms);
        ASSERT_EQ(ask(cnc, read_request_words, 8), zero_words) << "the CNC asks now and then";
    }
    ASSERT_TRUE(pump_until([&] { return port.clients() <= 8; }));
    EXPECT_EQ(ask(cnc, read_request_words, 8), zero_words);
}

/// The allow-list names others than this PC.
class ModbusTcpForOthers : public ModbusTcp {
protected:
    static TriggerConfig config_for(const std::string& allowed) {
        TriggerConfig config = any_free_port();
        config.allowed_clients.push_back(*parse_address_range(allowed));
        return config;
    }
    ModbusTcpPort others{std::make_unique<Acknowledging<SequenceBlockMap>>(false, false),
                         config_for("192.168.10.0/24"), ClientPatience{}};
    RunningPort running_for_others{others, scheduler};
    ModbusTcpPort here{std::make_unique<Acknowledging<SequenceBlockMap>>(false, false),
                       config_for("127.0.0.0/8"), ClientPatience{}};
    RunningPort running_here{here, scheduler};
};

TEST_F(ModbusTcpForOthers, TurnsAwayWhomTheListDoesNotNameAndSaysSoOnce) {
    ASSERT_TRUE(pump_until([&] { return others.bound_port() != 0 && here.bound_port() != 0; }));
    for (int tries = 0; tries < 3; ++tries) {
        RawModbusClient stranger{others.bound_port()};
        EXPECT_TRUE(is_hung_up(stranger));
    }
    EXPECT_EQ(others.counters().strangers, 3U);
    ASSERT_EQ(running_for_others.sink.notes.size(), 1U);
    EXPECT_NE(running_for_others.sink.notes[0].second.find("127.0.0.1"), std::string::npos);
    RawModbusClient named{here.bound_port()};
    named.send(framed(7, read_request_words));
    EXPECT_TRUE(receives(named, 15));
    EXPECT_EQ(here.counters().strangers, 0U);
}

// Two monitors that knock in turn filled the status with their notes.
TEST(TurnedAway, NamesAnAddressOnceADayAndFourOfADay) {
    TurnedAway turned_away;
    MonotonicTime now{};
    int told = 0;
    for (int i = 0; i < 1000; ++i, now += 1s)
        for (const char* address : {"127.0.0.2", "127.0.0.3"})
            told += turned_away.take(address, now) ? 1 : 0;
    EXPECT_EQ(told, 2);
    for (int i = 4; i < 200; ++i)
        told += turned_away.take("127.0.0." + std::to_string(i), now) ? 1 : 0;
    EXPECT_EQ(told, 4);
    EXPECT_FALSE(turned_away.take("", now)) << "it has hung up already";
    EXPECT_EQ(turned_away.take("127.0.0.2", now + 24h), "127.0.0.2 away");
}

TEST_F(ModbusTcp, EndsWithoutExceptionWhenCancelled) {
    auto cnc = connect();
    running.cancel();
    EXPECT_TRUE(pump_until([&] { return running.result.has_value(); }));
    EXPECT_FALSE(running.threw);
    EXPECT_TRUE(is_hung_up(cnc));
    EXPECT_TRUE(pump_until([&] { return port.clients() == 0; }));
}

TEST_F(ModbusTcp, SaysThatItsAddressIsTaken) {
    TriggerConfig config;
    config.port = port.bound_port();
    ModbusTcpPort second{std::make_unique<SingleRegisterMap>(), config, ClientPatience{}};
    RunningPort ended{second, scheduler};
    ASSERT_TRUE(pump_until([&] { return ended.result.has_value(); }));
    ASSERT_FALSE(ended.result->has_value());
    EXPECT_EQ(ended.result->error().fault, Fault::io);
    EXPECT_NE(ended.result->error().detail.find(std::to_string(config.port)), std::string::npos);
}

TEST(MbapFramer, GivesTheSameFramesHoweverTheBytesAreCut) {
    Bytes stream;
    for (std::uint16_t transaction = 0; transaction < 50; ++transaction) {
        const auto frame = framed(transaction, Bytes(1U + transaction, 3));
        stream.insert(stream.end(), frame.begin(), frame.end());
    }
    std::mt19937 random{5};
    for (int trial = 0; trial < 50; ++trial) {
        MbapFramer framer;
        std::uint16_t next = 0;
        for (std::size_t at = 0; at < stream.size();) {
            const auto piece = std::min<std::size_t>(1 + random() % 40, stream.size() - at);
            framer.feed(std::span{stream}.subspan(at, piece));
            at += piece;
            while (const auto frame = framer.next()) {
                EXPECT_EQ(*frame, framed(next, Bytes(1U + next, 3)));
                ++next;
            }
        }
        EXPECT_EQ(next, 50);
        EXPECT_FALSE(framer.in_frame());
    }
}

} // namespace
} // namespace axiscal::cnc_modbus_tcp_port_test
