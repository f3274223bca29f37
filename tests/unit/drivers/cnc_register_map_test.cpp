#include "tests/support/cnc_map_bench.hpp"

#include <gtest/gtest.h>

#include <random>

namespace axiscal::cnc_register_map_test {
namespace {

using testing::MapBench;
using namespace std::chrono_literals;
using BlockBench = MapBench<SequenceBlockMap>;
using SingleBench = MapBench<SingleRegisterMap>;
using CoilBench = MapBench<CoilAndIndexMap>;

constexpr MonotonicTime begin = monotonic_from_ns(5'000'000'000);

ModbusException verdict(const AddressSpace& space, std::initializer_list<std::uint8_t> pdu) {
    const auto request = parse_modbus_request(std::vector<std::uint8_t>(pdu));
    return request ? space.check(*request) : request.error();
}

// The rule of the counter: 65534 is followed by 1, 0 is idle, 65535 is no request.
TEST(Sequence, GoesFrom65534To1) {
    EXPECT_EQ(next_sequence(0), 1);
    EXPECT_EQ(next_sequence(1), 2);
    EXPECT_EQ(next_sequence(65533), 65534);
    EXPECT_EQ(next_sequence(65534), 1);
}

TEST(NoRun, IsShownAs65535ByEveryShapeBeforeTheFirstArmAndAfterARunThatWasBrokenOff) {
    BlockBench block{false, false};
    SingleBench single;
    CoilBench coil{50ms};
    const auto expect_done = [&](std::uint16_t done) {
        EXPECT_EQ(block.word(18), done);
        EXPECT_EQ(single.image().input[0], done);
        EXPECT_EQ(coil.image().input[0], done);
    };
    expect_done(65535);
    block.arm(), single.arm(), coil.arm();
    expect_done(0);
    block.write_word(2, 1), single.write_word(0, 1);
    coil.write_word(0, 1), coil.write_coil(true);
    block.finish(1), single.finish(1), coil.finish(1);
    expect_done(1);
    EXPECT_EQ(coil.image().discrete_inputs[0], 1);
    block.end_run(RunEnd::at_once), single.end_run(RunEnd::at_once), coil.end_run(RunEnd::at_once);
    expect_done(65535);
    EXPECT_EQ(coil.image().discrete_inputs[0], 0);
    block.arm(), single.arm(), coil.arm();
    expect_done(0);
}

TEST(NoRun, LetsTheCncReadTheAnswerToTheRequestThatEndedIt) {
    BlockBench map{false, false};
    map.arm();
    map.write_words(1, {5, 7});
    map.finish(7);
    map.end_run(RunEnd::once_answered);
    EXPECT_EQ(map.word(18), 7);
    map.write_words(1, {5, 7});
    EXPECT_EQ(map.word(18), 7) << "the same number written again";
    map.write_word(2, 0);
    EXPECT_EQ(map.word(18), 65535);
}

TEST(SequenceBlock, SaysThatASkippedRequestHasNoPoint) {
    BlockBench map{false, false};
    map.arm();
    map.write_words(1, {3, 1});
    map.finish_skip(1);
    EXPECT_EQ(map.word(18), 1);
    EXPECT_EQ(map.word(19), 13);
    EXPECT_EQ(map.word(32), 0);
    map.write_words(1, {2, 2});
    EXPECT_EQ(map.word(19), 0) << "withdrawn by the next request";
}

// Bytes of the examples in the Modbus application protocol V1.1b3, sections 6.3, 6.6, 6.11, 6.12,
// 6.17.
TEST(ModbusRequest, ReadsTheProtocolsOwnExamples) {
    const std::vector<std::uint8_t> read{0x03, 0x00, 0x6B, 0x00, 0x03};
    const auto read_request = parse_modbus_request(read);
    ASSERT_TRUE(read_request);
    EXPECT_EQ(read_request->read_address, 0x6B);
    EXPECT_EQ(read_request->read_count, 3);

    const std::vector<std::uint8_t> single{0x06, 0x00, 0x01, 0x00, 0x03};
    EXPECT_EQ(parse_modbus_request(single)->values, std::vector<std::uint16_t>{3});

    const std::vector<std::uint8_t> coils{0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0x01};
    EXPECT_EQ(parse_modbus_request(coils)->values,
              (std::vector<std::uint16_t>{1, 0, 1, 1, 0, 0, 1, 1, 1, 0}));

    const std::vector<std::uint8_t> words{0x10, 0x00, 0x01, 0x00, 0x02,
                                          0x04, 0x00, 0x0A, 0x01, 0x02};
    EXPECT_EQ(parse_modbus_request(words)->values, (std::vector<std::uint16_t>{0x000A, 0x0102}));

    const std::vector<std::uint8_t> both{0x17, 0x00, 0x03, 0x00, 0x06, 0x00, 0x0E, 0x00,
                                         0x03, 0x06, 0x00, 0xFF, 0x00, 0xFF, 0x00, 0xFF};
    const auto both_request = parse_modbus_request(both);
    ASSERT_TRUE(both_request);
    EXPECT_EQ(both_request->read_address, 3);
    EXPECT_EQ(both_request->read_count, 6);
    EXPECT_EQ(both_request->write_address, 14);
    EXPECT_EQ(both_request->values, (std::vector<std::uint16_t>{255, 255, 255}));
}

TEST(ModbusRequest, RefusesCountsAndLengthsTheProtocolForbids) {
    const AddressSpace space{2000, 0, 200, 200, 200};
    EXPECT_EQ(verdict(space, {0x03, 0, 0, 0, 0}), ModbusException::illegal_value);
    EXPECT_EQ(verdict(space, {0x03, 0, 0, 0, 126}), ModbusException::illegal_value);
    EXPECT_EQ(verdict(space, {0x03, 0, 0, 0}), ModbusException::illegal_value);
    EXPECT_EQ(verdict(space, {0x05, 0, 0, 0x12, 0x34}), ModbusException::illegal_value);
    EXPECT_EQ(verdict(space, {0x10, 0, 0, 0, 2, 4, 0, 1}), ModbusException::illegal_value);
    EXPECT_EQ(verdict(space, {0x10, 0, 0, 0, 1, 4, 0, 1}), ModbusException::illegal_value);
    EXPECT_EQ(verdict(space, {0x2B, 0x0E, 1, 0}), ModbusException::illegal_function);
}

TEST(ModbusRequest, NeverReadsBeyondWhatItGot) {
    std::mt19937 random{20261121};
    for (int trial = 0; trial < 20000; ++trial) {
        std::vector<std::uint8_t> pdu(random() % 20);
        for (auto& byte : pdu)
            byte = static_cast<std::uint8_t>(random());
        if (!pdu.empty()) pdu[0] = static_cast<std::uint8_t>(random() % 24);
        const auto request = parse_modbus_request(pdu);
        if (!request || request->writes_coils()) continue;
        EXPECT_LE(2 * request->values.size(), pdu.size());
    }
}

TEST(AddressSpace, LetsTheCncWriteItsTenWordsAndReadAll) {
    const auto space = BlockBench{false, false}.space();
    EXPECT_EQ(verdict(space, {0x03, 0, 0, 0, 33}), ModbusException::none);
    EXPECT_EQ(verdict(space, {0x04, 0, 16, 0, 17}), ModbusException::none);
    EXPECT_EQ(verdict(space, {0x03, 0, 0, 0, 34}), ModbusException::illegal_address);
    EXPECT_EQ(verdict(space, {0x06, 0, 9, 0, 1}), ModbusException::none);
    EXPECT_EQ(verdict(space, {0x06, 0, 10, 0, 1}), ModbusException::illegal_address);
    EXPECT_EQ(verdict(space, {0x06, 0, 18, 0, 1}), ModbusException::illegal_address);
    EXPECT_EQ(verdict(space, {0x10, 0, 9, 0, 2, 4, 0, 1, 0, 1}), ModbusException::illegal_address);
    EXPECT_EQ(verdict(space, {0x01, 0, 0, 0, 1}), ModbusException::illegal_function);
    EXPECT_EQ(verdict(space, {0x17, 0, 30, 0, 4, 0, 0, 0, 1, 2, 0, 1}),
              ModbusException::illegal_address);
}

TEST(AddressSpace, OfTheSmallShapesHasOneAddressATable) {
    const auto single = SingleBench{}.space();
    EXPECT_EQ(verdict(single, {0x06, 0, 0, 0, 1}), ModbusException::none);
    EXPECT_EQ(verdict(single, {0x10, 0, 0, 0, 1, 2, 0, 1}), ModbusException::none);
    EXPECT_EQ(verdict(single, {0x03, 0, 0, 0, 1}), ModbusException::none);
    EXPECT_EQ(verdict(single, {0x04, 0, 0, 0, 1}), ModbusException::none);
    EXPECT_EQ(verdict(single, {0x06, 0, 1, 0, 1}), ModbusException::illegal_address);
    EXPECT_EQ(verdict(single, {0x05, 0, 0, 0xFF, 0}), ModbusException::illegal_function);
    EXPECT_EQ(verdict(single, {0x02, 0, 0, 0, 1}), ModbusException::illegal_function);
    const auto coil = CoilBench{50ms}.space();
    EXPECT_EQ(verdict(coil, {0x05, 0, 0, 0xFF, 0}), ModbusException::none);
    EXPECT_EQ(verdict(coil, {0x0F, 0, 0, 0, 1, 1, 1}), ModbusException::none);
    EXPECT_EQ(verdict(coil, {0x02, 0, 0, 0, 1}), ModbusException::none);
    EXPECT_EQ(verdict(coil, {0x05, 0, 1, 0xFF, 0}), ModbusException::illegal_address);
}

TEST(SequenceBlock, TurnsOneBlockWriteIntoOneClaim) {
    BlockBench map{false, false};
    map.arm();
    EXPECT_TRUE(map.write_word(2, 0).events.empty());
    // capture, request 1, target 3, from the negative side, -25.4 mm = -254000 = FFFC 1FD0,
    // approach 2, 1200 mm/min
    const auto news = map.write_words(1, {2, 1, 3, 2, 0xFFFC, 0x1FD0, 2, 0, 1200}, begin);
    ASSERT_EQ(news.events.size(), 1U);
    const TriggerEvent& event = news.events[0];
    EXPECT_EQ(event.command, TriggerCommand::capture);
    EXPECT_EQ(event.sequence, 1);
    EXPECT_EQ(event.target_index, 3);
    EXPECT_EQ(event.direction, Direction::negative);
    EXPECT_EQ(event.nominal_counts, -254000);
    EXPECT_EQ(event.run_index, 2);
    EXPECT_EQ(event.at, begin);
    EXPECT_FALSE(event.standing);
    EXPECT_TRUE(map.write_words(1, {2, 1, 3, 2, 0xFFFC, 0x1FD0, 2, 0, 1200}).events.empty())
        << "a repeated CMD_SEQ is the same command";
}

TEST(SequenceBlock, WaitsForTheSequenceWhenWordsComeOneByOne) {
    BlockBench map{true, false};
    map.arm();
    EXPECT_TRUE(map.write_word(1, 2).events.empty());
    EXPECT_TRUE(map.write_word(5, 0x1FD0).events.empty()); // low word first
    EXPECT_TRUE(map.write_word(6, 0xFFFC).events.empty());
    const auto news = map.write_word(2, 1);
    ASSERT_EQ(news.events.size(), 1U);
    EXPECT_EQ(news.events[0].nominal_counts, -254000);
    EXPECT_EQ(news.events[0].direction, std::nullopt);
}

TEST(SequenceBlock, KnowsFiveCommandsAndRefusesTheOthers) {
    const std::array known{TriggerCommand::prepare, TriggerCommand::capture, TriggerCommand::skip,
                           TriggerCommand::abort, TriggerCommand::end};
    for (std::uint16_t word = 0; word < 9; ++word) {
        BlockBench map{false, false};
        map.arm();
        const auto news = map.write_words(1, {word, 7});
        if (word >= 1 && word <= 5) {
            ASSERT_EQ(news.events.size(), 1U) << word;
            EXPECT_EQ(news.events[0].command, known[word - 1U]);
            continue;
        }
        EXPECT_TRUE(news.events.empty()) << word;
        EXPECT_EQ(map.word(19), 5) << "RESULT bad command";
        EXPECT_EQ(map.word(32), 7) << "FAULT_SEQ";
        EXPECT_EQ(map.word(18), 0) << "ACK_SEQ stays";
        EXPECT_EQ(news.notes.size(), 1U);
    }
}

TEST(SequenceBlock, ShowsAFaultWithoutMovingDoneAndWithdrawsItWithTheNextRequest) {
    BlockBench map{false, false};
    map.arm();
    map.write_words(1, {2, 1});
    map.finish(1);
    map.write_words(1, {2, 2});
    map.refuse(2, Fault::wrong_target);
    EXPECT_EQ(map.word(18), 1);
    EXPECT_EQ(map.word(19), 9);
    EXPECT_EQ(map.word(32), 2);
    map.write_word(2, 0); // back to idle, then the same request again
    EXPECT_EQ(map.word(32), 2);
    EXPECT_EQ(map.write_words(1, {2, 2}).events.size(), 1U);
    EXPECT_EQ(map.word(19), 0);
    EXPECT_EQ(map.word(32), 0);
    map.finish(2);
    EXPECT_EQ(map.word(18), 2);
}

TEST(SequenceBlock, PublishesZeroWhenARunIsArmed) {
    BlockBench map{false, false};
    map.write_words(1, {2, 110});
    map.finish(110);
    map.refuse(110, Fault::beam_lost);
    map.arm();
    EXPECT_EQ(map.word(18), 0);
    EXPECT_EQ(map.word(19), 0);
    EXPECT_EQ(map.word(32), 0);
    EXPECT_TRUE(map.write_words(1, {2, 110}).events.empty())
        << "the old request still stands there";
}

TEST(SequenceBlock, ShowsTheStationInItsUnits) {
    BlockBench map{false, false};
    PortStatus status;
    status.state = PortState::settling;
    status.measured_mm = -25.4; // -254000 = FFFC 1FD0
    status.deviation_um = -1.5; // -150 = FFFF FF6A
    status.next_target = 4;
    status.next_nominal_mm = 100.00005; // 1000001 (rounded from 1000000.5) = 000F 4241
    status.run_complete = true;
    status.air_degC = 22.995;
    status.pressure_Pa = 101325;
    status.humidity_percent = 45.04;
    map.show(status);
    const std::vector<std::pair<int, int>> expected{
        {17, 3},      {20, 0xFFFC}, {21, 0x1FD0}, {22, 0xFFFF}, {23, 0xFF6A}, {24, 4},
        {25, 0x000F}, {26, 0x4241}, {27, 0b101},  {29, 10133},  {30, 450},    {31, 0x8000}};
    for (const auto& [address, value] : expected)
        EXPECT_EQ(map.word(address), value) << address;
    EXPECT_NEAR(map.word(28), 2299.5, 0.5);
    EXPECT_EQ(map.image().input, map.image().holding) << "FC4 mirrors FC3";
}

TEST(SequenceBlock, CountsARotaryAxisInHundredThousandthsOfADegree) {
    BlockBench map{false, false};
    PortStatus status;
    status.axis_kind = AxisKind::rotary;
    status.measured_mm = 90.0; // 90 degrees = 9000000 = 0089 5440
    status.deviation_um = 0.5; // 0.5 thousandth of a degree = 500 millionths
    map.show(status);
    EXPECT_EQ(map.word(20), 0x0089);
    EXPECT_EQ(map.word(21), 0x5440);
    EXPECT_EQ(map.word(23), 500);
}

TEST(SequenceBlock, BeatsOnceEachTenthOfASecondWhenRead) {
    BlockBench map{false, false};
    const auto beat_at = [&](Duration after) {
        auto image = map.image();
        image.stamp(begin + after);
        EXPECT_EQ(image.input[16], image.holding[16]);
        return image.holding[16];
    };
    EXPECT_EQ(beat_at(0ms), beat_at(99ms));
    EXPECT_EQ(static_cast<std::uint16_t>(beat_at(0ms) + 1), beat_at(100ms));
    EXPECT_EQ(static_cast<std::uint16_t>(beat_at(0ms) + 20), beat_at(2s));
}

TEST(SequenceBlock, TellsWhenTheCncFallsSilentAndIsHeardAgain) {
    BlockBench map{false, true};
    EXPECT_FALSE(map.tick(begin).silent) << "never heard: nothing to lose";
    map.write_word(0, 1, begin);
    EXPECT_FALSE(map.tick(begin + 2s).silent);
    map.write_word(0, 1, begin + 1s); // the same beat is no beat
    EXPECT_EQ(map.tick(begin + 2001ms).silent, true);
    EXPECT_FALSE(map.tick(begin + 3s).silent) << "told once";
    EXPECT_EQ(map.write_word(0, 2, begin + 4s).silent, false);
}

TEST(FirstValue, IsTheBaselineUnlessARunIsArmed) {
    BlockBench fresh{false, false};
    EXPECT_TRUE(fresh.write_words(1, {2, 37}).events.at(0).standing);
    EXPECT_FALSE(fresh.write_words(1, {2, 38}).events.at(0).standing);
    SingleBench single;
    EXPECT_TRUE(single.write_word(0, 37).events.at(0).standing);
    SingleBench armed;
    armed.arm();
    EXPECT_FALSE(armed.write_word(0, 1).events.at(0).standing);
    SingleBench idle;
    EXPECT_TRUE(idle.write_word(0, 0).events.empty());
    EXPECT_FALSE(idle.write_word(0, 1).events.at(0).standing) << "0 was the baseline";
}

TEST(SingleRegister, EchoesOnlyWhatIsFinished) {
    SingleBench map;
    map.arm();
    map.write_word(0, 0);
    EXPECT_EQ(map.write_word(0, 1).events.at(0).sequence, 1);
    EXPECT_EQ(map.image().input[0], 0);
    EXPECT_TRUE(map.write_word(0, 1).events.empty());
    map.finish(1);
    EXPECT_EQ(map.image().input[0], 1);
    EXPECT_EQ(map.write_word(0, 2).events.at(0).sequence, 2);
    map.refuse(2, Fault::not_still);
    EXPECT_EQ(map.image().input[0], 1) << "a refused request holds";
    EXPECT_EQ(map.image().holding[0], 2);
}

TEST(SingleRegister, DeliversADoubledRequestAfterIdle) {
    SingleBench map;
    map.arm();
    map.write_word(0, 5);
    map.write_word(0, 0);
    EXPECT_EQ(map.write_word(0, 5).events.at(0).sequence, 5);
}

class CoilAndIndex : public ::testing::Test {
protected:
    void finish_request(std::uint16_t sequence) {
        map.write_word(0, sequence, begin);
        ASSERT_EQ(map.write_coil(true, begin).events.size(), 1U);
        map.finish(sequence);
        map.write_coil(false, begin);
    }
    [[nodiscard]] int acknowledge() const { return map.image().discrete_inputs[0]; }
    CoilBench map{50ms};
};

TEST_F(CoilAndIndex, AcknowledgesBetweenReceiptAndFallingCoil) {
    map.arm();
    map.write_word(0, 1, begin);
    const auto news = map.write_coil(true, begin + 100ms);
    ASSERT_EQ(news.events.size(), 1U);
    EXPECT_EQ(news.events[0].sequence, 1);
    EXPECT_EQ(news.events[0].at, begin + 100ms);
    EXPECT_EQ(acknowledge(), 0);
    EXPECT_TRUE(map.write_coil(true, begin + 105ms).events.empty()) << "a level is no edge";
    map.finish(1);
    EXPECT_EQ(acknowledge(), 1);
    EXPECT_EQ(map.image().input[0], 1) << "the sequence, not a count";
    map.write_coil(false, begin + 200ms);
    EXPECT_EQ(acknowledge(), 0);
    EXPECT_EQ(map.image().input[0], 1);
}

TEST_F(CoilAndIndex, WaitsForAnIndexThatComesAfterItsCoil) {
    map.arm();
    finish_request(1);
    EXPECT_TRUE(map.write_coil(true, begin + 1s).events.empty()) << "index 1 is the previous one";
    EXPECT_TRUE(map.tick(begin + 1s + 20ms).events.empty());
    const auto news = map.write_word(0, 2, begin + 1s + 25ms);
    ASSERT_EQ(news.events.size(), 1U);
    EXPECT_EQ(news.events[0].sequence, 2);
    EXPECT_EQ(news.events[0].at, begin + 1s) << "the coil is the trigger";
    EXPECT_EQ(news.late_indices, 1);
    EXPECT_TRUE(map.tick(begin + 2s).events.empty());
}

TEST_F(CoilAndIndex, TakesAnUnchangedIndexForADoubledRequestAfterTheGrace) {
    map.arm();
    finish_request(1);
    map.write_coil(true, begin + 1s);
    map.write_word(0, 1, begin + 1s + 10ms); // the client writes all registers every pass
    EXPECT_TRUE(map.tick(begin + 1s + 49ms).events.empty());
    const auto news = map.tick(begin + 1s + 50ms);
    ASSERT_EQ(news.events.size(), 1U);
    EXPECT_EQ(news.events[0].sequence, 1);
    map.finish(1); // the station acknowledges again
    EXPECT_EQ(acknowledge(), 1);
}

TEST_F(CoilAndIndex, NeverTriggersWithTheIdleIndex) {
    map.arm();
    map.write_word(0, 0, begin);
    EXPECT_TRUE(map.write_coil(true, begin).events.empty());
    EXPECT_TRUE(map.tick(begin + 10s).events.empty());
    EXPECT_EQ(map.write_word(0, 1, begin + 11s).events.at(0).sequence, 1);
    map.write_coil(false, begin + 12s);
    map.write_word(0, 0, begin + 13s);
    map.write_coil(true, begin + 13s);
    const auto news = map.write_coil(false, begin + 14s);
    EXPECT_TRUE(news.events.empty());
    EXPECT_EQ(news.notes.size(), 1U) << "a lost trigger is named";
}

TEST_F(CoilAndIndex, DoesNotAcknowledgeACoilThatHasFallen) {
    map.arm();
    map.write_word(0, 1, begin);
    map.write_coil(true, begin);
    map.write_coil(false, begin + 10s); // the program timed out
    map.finish(1);
    EXPECT_EQ(acknowledge(), 0);
    EXPECT_EQ(map.image().input[0], 1);
}

TEST_F(CoilAndIndex, ReportsACoilThatIsHighAtStartAsStanding) {
    map.finish(6); // the station publishes the last durable sequence of its open run
    EXPECT_TRUE(map.write_coil(true, begin).events.empty()) << "no index yet";
    const auto news = map.write_word(0, 7, begin + 5ms);
    ASSERT_EQ(news.events.size(), 1U);
    EXPECT_EQ(news.events[0].sequence, 7);
    EXPECT_TRUE(news.events[0].standing);
}

TEST_F(CoilAndIndex, SuspectsTheLastDoneIndexAfterARestart) {
    map.finish(6);
    map.write_word(0, 6, begin);
    map.write_coil(false, begin);
    EXPECT_TRUE(map.write_coil(true, begin + 1s).events.empty());
    EXPECT_EQ(map.write_word(0, 7, begin + 1s + 5ms).events.at(0).sequence, 7);
}

// The law behind the race: whatever order coil and index arrive in, each request is reported once,
// with its own number.
TEST_F(CoilAndIndex, ReportsEachRequestOnceWhateverOrderTheWritesArriveIn) {
    std::mt19937 random{110};
    map.arm();
    map.write_word(0, 0, begin);
    MonotonicTime now = begin;
    for (std::uint16_t sequence = 1; sequence <= 500; ++sequence) {
        std::vector<std::uint16_t> seen;
        const auto note = [&](const MapNews& news) {
            for (const auto& event : news.events)
                seen.push_back(event.sequence);
        };
        const bool coil_first = random() % 2 == 0;
        if (!coil_first) note(map.write_word(0, sequence, now));
        note(map.write_coil(true, now += 1ms));
        note(map.tick(now += Duration{random() % 40'000'000}));
        for (int pass = 0; pass < 3; ++pass)
            note(map.write_word(0, sequence, now += 1ms));
        note(map.tick(now += 60ms));
        ASSERT_EQ(seen, std::vector<std::uint16_t>{sequence});
        map.finish(sequence);
        ASSERT_EQ(acknowledge(), 1);
        note(map.write_coil(false, now += 5ms));
    }
}

} // namespace
} // namespace axiscal::cnc_register_map_test
