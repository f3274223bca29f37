// Literal PDOs, mappings, heartbeats and emergencies: CiA 301, 404, 406 and the makers' manuals.
#include "drivers/ballbar/cia406_position.hpp"
#include "drivers/canopen/node_guard.hpp"
#include "drivers/canopen/node_messages.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/environment/cia404_input.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace axiscal::canopen_message_test {
namespace {

/// JUMO 902910, TPDO1: INT32 0x9130:1, UINT8 0x6150:1.
PdoLayout jumo() {
    return pdo_layout(1, 0x1FD, {0x91300120, 0x61500108}).value();
}
/// Temposonics E-series, TPDO1: INT32 0x6020:1, INT16 0x6030:1, UINT8 0x6400:1.
PdoLayout temposonics() {
    return pdo_layout(1, 0x1FF, {0x60200120, 0x60300110, 0x64000108}).value();
}
Cia404Input jumo_input(int digits = 2) {
    auto input = find_cia404_input({jumo()}, 1).value();
    input.digits = digits;
    return input;
}
Cia406Position transducer(double metres_per_step) {
    auto where = find_cia406_position({temposonics()}).value();
    where.metres_per_step = metres_per_step;
    return where;
}

TEST(PdoLayout, IsReadFromTheDevicesWords) {
    const PdoLayout layout = temposonics();
    ASSERT_EQ(layout.entries.size(), 3U);
    EXPECT_EQ(layout.entries[1].object, (ObjectKey{0x6030, 1}));
    EXPECT_EQ(layout.bits_of({0x6030, 1}), 16);
    EXPECT_EQ(layout.bits_of({0x6030, 2}), 0);
    EXPECT_FALSE(pdo_layout(1, 0x1FF, {0x60200120, 0x60200220, 0x64000108}));
    EXPECT_FALSE(pdo_layout(1, 0x1FF, {0x60200100}));
    EXPECT_FALSE(pdo_layout(1, 0x1FF, {0x60200141}));
}

TEST(PdoLayout, FindsAFieldBehindAnyOther) {
    const auto layout = pdo_layout(1, 0x181, {0x20000004, 0x2001000C, 0x20020008}).value();
    const CanFrame frame = plain_frame(0x181, {0xA5, 0x3C, 0x7E});
    EXPECT_EQ(layout.field(frame, {0x2000, 0}), 0x5U);
    EXPECT_EQ(layout.field(frame, {0x2001, 0}), 0x3CAU);
    EXPECT_EQ(layout.field(frame, {0x2002, 0}), 0x7EU);
    EXPECT_EQ(layout.field(plain_frame(0x181, {0xA5, 0x3C}), {0x2002, 0}), std::nullopt);
    const auto whole = pdo_layout(1, 0x181, {0x20000040}).value();
    EXPECT_EQ(whole.field(plain_frame(0x181, {1, 2, 3, 4, 5, 6, 7, 8}), {0x2000, 0}),
              0x0807060504030201U);
}

TEST(PdoLayout, ExtendsTheSign) {
    EXPECT_EQ(sign_extended(0xFFFB, 16), -5);
    EXPECT_EQ(sign_extended(0x7FFF, 16), 32767);
    EXPECT_EQ(sign_extended(0x80000000, 32), -2147483648LL);
    EXPECT_EQ(sign_extended(~std::uint64_t{0}, 64), -1);
}

TEST(Cia406, ReadsPositionsOfTheLowByteFirst) {
    const PdoLayout layout = temposonics();
    const Cia406Position where = transducer(1e-6);
    // 123456 steps of 1 um, velocity -5
    const auto far = read_cia406_position(
        where, layout, plain_frame(0x1FF, {0x40, 0xE2, 0x01, 0x00, 0xFB, 0xFF, 0x00}));
    EXPECT_DOUBLE_EQ(far.metres.value(), 0.123456);
    EXPECT_EQ(
        layout.field(plain_frame(0x1FF, {0x40, 0xE2, 0x01, 0x00, 0xFB, 0xFF, 0x00}), {0x6030, 1}),
        0xFFFBU);
    const auto back =
        read_cia406_position(where, layout, plain_frame(0x1FF, {0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0}));
    EXPECT_DOUBLE_EQ(back.metres.value(), -1e-6);
}

TEST(Cia406, ReadsTheShortFrameOfTheManualWithoutAStatus) {
    const auto reading = read_cia406_position(
        transducer(5e-6), temposonics(), plain_frame(0x1FF, {0x40, 0xE2, 0x01, 0x00, 0xFB, 0xFF}));
    EXPECT_DOUBLE_EQ(reading.metres.value(), 0.61728);
}

TEST(Cia406, HasNoNumberOutsideOfTheWorkAreaNorInACutFrame) {
    auto where = transducer(1e-6);
    for (const unsigned bit : {1U, 2U, 4U}) {
        const auto outside = read_cia406_position(
            where, temposonics(), plain_frame(0x1FF, {0x40, 0xE2, 0x01, 0, 0, 0, bit}));
        EXPECT_EQ(outside.metres, std::nullopt);
        EXPECT_EQ(outside.why, Cia406Reading::Why::outside);
    }
    EXPECT_EQ(
        read_cia406_position(where, temposonics(), plain_frame(0x1FF, {0x40, 0xE2, 0x01})).why,
        Cia406Reading::Why::short_frame);
    where.heed_area = false;
    EXPECT_TRUE(
        read_cia406_position(where, temposonics(), plain_frame(0x1FF, {1, 0, 0, 0, 0, 0, 1}))
            .metres);
}

TEST(Cia406, TakesTheSinglePositionWhereThatIsMapped) {
    const std::vector<PdoLayout> layouts{pdo_layout(1, 0x185, {0x60040020}).value()};
    EXPECT_EQ(find_cia406_position(layouts)->position, (ObjectKey{0x6004, 0}));
    EXPECT_FALSE(find_cia406_position({jumo()}));
    EXPECT_TRUE(is_rotary_encoder(0x00020196));
    EXPECT_FALSE(is_rotary_encoder(0x00080196));
}

TEST(Cia404, ReadsHundredthsOfADegree) {
    const auto reading =
        read_cia404_input(jumo_input(), jumo(), plain_frame(0x1FD, {0xDF, 0x07, 0x00, 0x00, 0x00}));
    EXPECT_DOUBLE_EQ(reading.celsius.value(), 20.15);
    const auto cold =
        read_cia404_input(jumo_input(), jumo(), plain_frame(0x1FD, {0x0C, 0xFE, 0xFF, 0xFF, 0x00}));
    EXPECT_DOUBLE_EQ(cold.celsius.value(), -5);
}

TEST(Cia404, HasNoNumberFromABrokenSensorOrOutOfRange) {
    using Why = Cia404Reading::Why;
    const auto why = [](unsigned status) {
        return read_cia404_input(jumo_input(), jumo(),
                                 plain_frame(0x1FD, {0xDF, 0x07, 0x00, 0x00, status}))
            .why;
    };
    EXPECT_EQ(why(1), Why::sensor_faulty);
    EXPECT_EQ(why(2), Why::out_of_range);
    EXPECT_EQ(why(4), Why::out_of_range);
    const auto cut =
        read_cia404_input(jumo_input(), jumo(), plain_frame(0x1FD, {0xDF, 0x07, 0x00, 0x00}));
    EXPECT_EQ(cut.why, Why::short_frame);
    EXPECT_EQ(cut.celsius, std::nullopt);
    // 0x7FFFFFFF hundredths are 21 million degrees
    EXPECT_EQ(
        read_cia404_input(jumo_input(), jumo(), plain_frame(0x1FD, {0xFF, 0xFF, 0xFF, 0x7F, 0x00}))
            .why,
        Why::out_of_range);
}

TEST(Cia404, ReadsFloatsAndSixteenBitsOfOtherMakers) {
    // 20.0 as float: 41A00000
    const auto floats = pdo_layout(2, 0x2A5, {0x61300120, 0x61300220}).value();
    const auto second = find_cia404_input({jumo(), floats}, 2).value();
    EXPECT_EQ(second.layout, 1U);
    EXPECT_FALSE(second.has_status);
    const CanFrame frame = plain_frame(0x2A5, {0, 0, 0xC0, 0x7F, 0x00, 0x00, 0xA0, 0x41});
    EXPECT_DOUBLE_EQ(read_cia404_input(second, floats, frame).celsius.value(), 20);
    const auto first = find_cia404_input({floats}, 1).value();
    EXPECT_EQ(read_cia404_input(first, floats, frame).celsius, std::nullopt) << "a NaN";
    const auto words = pdo_layout(1, 0x1A5, {0x71300110}).value();
    auto word = find_cia404_input({words}, 1).value();
    word.digits = 1;
    EXPECT_DOUBLE_EQ(
        read_cia404_input(word, words, plain_frame(0x1A5, {0xC9, 0x00})).celsius.value(), 20.1);
    EXPECT_EQ(find_cia404_input({words}, 3).error().fault, Fault::bad_configuration);
}

TEST(Cia404, KnowsThreeUnitsAndNoOther) {
    EXPECT_EQ(cia404_unit(0x002D0000), Cia404Unit::in_celsius);
    EXPECT_EQ(cia404_unit(0x00050000), Cia404Unit::in_kelvin);
    EXPECT_EQ(cia404_unit(0x00AC0000), Cia404Unit::in_fahrenheit);
    EXPECT_EQ(cia404_unit(0x00280000), std::nullopt) << "ohm";
    EXPECT_EQ(cia404_unit(0xFD2D0000), std::nullopt) << "a prefix";
    auto input = jumo_input(0);
    input.unit = Cia404Unit::in_fahrenheit;
    const CanFrame warm = plain_frame(0x1FD, {68, 0, 0, 0, 0});
    EXPECT_DOUBLE_EQ(read_cia404_input(input, jumo(), warm).celsius.value(), 20);
    input.unit = Cia404Unit::in_kelvin;
    EXPECT_NEAR(read_cia404_input(input, jumo(), warm).celsius.value(), -205.15, 1e-12);
}

TEST(NodeMessages, CommandsOneNode) {
    EXPECT_EQ(nmt_frame(NmtCommand::start, 125), plain_frame(0, {0x01, 0x7D}));
    EXPECT_EQ(nmt_frame(NmtCommand::reset_communication, 127), plain_frame(0, {0x82, 0x7F}));
}

TEST(NodeMessages, TellBootUpAndHeartbeat) {
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x00}), 125), NodeState::boot_up);
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x05}), 125), NodeState::operational);
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x7F}), 125), NodeState::pre_operational);
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x04}), 125), NodeState::stopped);
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77F, {0x05}), 125), std::nullopt);
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x09}), 125), std::nullopt);
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x05, 0x00}), 125), std::nullopt);
}

TEST(NodeMessages, GuardANodeByARemoteFrameForOneByte) {
    CanFrame question = plain_frame(0x77D, {0x00});
    question.remote = true;
    EXPECT_EQ(guard_request(125), question);
    EXPECT_EQ(decode_heartbeat(question, 125), std::nullopt) << "a question is no answer";
    // 0x05 and 0x85 in turn while operational, 0x7F and 0xFF before it is started
    for (const auto& [byte, state, toggle] : {std::tuple{0x05U, NodeState::operational, false},
                                              std::tuple{0x85U, NodeState::operational, true},
                                              std::tuple{0x7FU, NodeState::pre_operational, false},
                                              std::tuple{0xFFU, NodeState::pre_operational, true},
                                              std::tuple{0x84U, NodeState::stopped, true}}) {
        const CanFrame answer = plain_frame(0x77D, {byte});
        EXPECT_EQ(decode_heartbeat(answer, 125), state);
        EXPECT_EQ(toggle_of(answer), toggle);
    }
    EXPECT_EQ(decode_heartbeat(plain_frame(0x77D, {0x80}), 125), std::nullopt)
        << "a boot-up has no toggle bit";
}

TEST(NodeGuard, AsksOnceASecondAndKnowsTheSilenceAfterTwoAndAHalf) {
    using namespace std::chrono_literals;
    const auto at = [](Duration since) { return monotonic_from_ns(0) + since; };
    NodeGuard guard;
    EXPECT_FALSE(guard.asks(at(0s)));
    guard.begin(at(1s));
    EXPECT_TRUE(guard.asks(at(1s)));
    EXPECT_FALSE(guard.asks(at(1900ms)));
    EXPECT_EQ(guard.silent_from(), std::nullopt) << "it never answered: perhaps it cannot";
    EXPECT_TRUE(guard.take(false, at(1010ms)));
    EXPECT_EQ(guard.silent_from(), at(3510ms));
    EXPECT_TRUE(guard.asks(at(2s)));
    EXPECT_FALSE(guard.take(false, at(2010ms))) << "the toggle bit did not change";
    EXPECT_EQ(guard.silent_from(), at(3510ms));
    EXPECT_TRUE(guard.asks(at(3s)));
    EXPECT_TRUE(guard.take(true, at(3010ms)));
    EXPECT_EQ(guard.silent_from(), at(5510ms));
}

TEST(NodeGuard, LeavesANodeThatDoesNotKnowItAfterThreeQuestions) {
    using namespace std::chrono_literals;
    NodeGuard guard;
    guard.begin(monotonic_from_ns(0));
    int asked = 0;
    for (MonotonicTime now = monotonic_from_ns(0); now < monotonic_from_ns(0) + 10s; now += 100ms)
        asked += guard.asks(now) ? 1 : 0;
    EXPECT_EQ(asked, NodeGuard::questions_to_a_stranger);
    EXPECT_EQ(guard.next_question(), std::nullopt);
    EXPECT_EQ(guard.silent_from(), std::nullopt);
}

TEST(NodeMessages, TellAnEmergencyAndItsEnd) {
    // JUMO: 0x5030, channel 0, cause 1 (break)
    const auto broken =
        decode_emergency(plain_frame(0x0FD, {0x30, 0x50, 0x01, 0x00, 0x01, 0, 0, 0}), 125);
    ASSERT_TRUE(broken);
    EXPECT_FALSE(broken->is_over());
    EXPECT_EQ(broken->describe(), "0x5030 (hardware of the device), 00 01 00 00 00");
    const auto over = decode_emergency(plain_frame(0x0FD, {0, 0, 0, 0, 0, 0, 0, 0}), 125);
    EXPECT_TRUE(over->is_over());
    const auto passive =
        decode_emergency(plain_frame(0x0FD, {0x20, 0x81, 0x11, 0, 0, 0, 0, 0}), 125);
    EXPECT_TRUE(passive->is_of_communication());
    // One that is cut is an emergency all the same.
    for (const auto& cut : {plain_frame(0x0FD, {0x30, 0x50, 0x01}), plain_frame(0x0FD, {})}) {
        const auto emergency = decode_emergency(cut, 125);
        ASSERT_TRUE(emergency);
        EXPECT_FALSE(emergency->is_over());
        EXPECT_FALSE(emergency->is_of_communication());
    }
}

} // namespace
} // namespace axiscal::canopen_message_test
