// Literal bytes. Modbus over serial line V1.02; Messaging on TCP/IP V1.0b; application protocol
// V1.1b3. The checksums were reckoned apart, by the bits of the polynomial.
#include "drivers/framing/modbus_answers.hpp"

#include "drivers/framing/byte_order.hpp"

#include <gtest/gtest.h>

namespace axiscal::modbus_answers_test {
namespace {

using Kind = ModbusAnswer::Kind;
using Words = std::vector<std::uint16_t>;

constexpr ModbusQuestion first_input{1, 4, 0, 1};

std::optional<ModbusAnswer> on_a_line(std::initializer_list<int> bytes,
                                      ModbusQuestion question = first_input) {
    RtuAnswer answer{question};
    answer.feed(bytes_of(bytes));
    return answer.take();
}

std::optional<ModbusAnswer> on_a_connection(std::initializer_list<int> bytes,
                                            ModbusQuestion question = first_input) {
    TcpAnswers answers;
    answers.feed(bytes_of(bytes));
    return answers.take(question, 0x0102);
}

TEST(ModbusRequest, BearsItsUnitAndChecksumOnALine) {
    EXPECT_EQ(rtu_request(first_input), bytes_of({0x01, 0x04, 0, 0, 0, 1, 0x31, 0xCA}));
    EXPECT_EQ(rtu_request({250, 4, 0, 1})[0], std::byte{250});
}

TEST(ModbusRequest, BearsItsTransactionAndUnitOnAConnection) {
    EXPECT_EQ(tcp_request({17, 3, 0x6B, 3}, 0x1501),
              bytes_of({0x15, 0x01, 0, 0, 0, 6, 17, 3, 0, 0x6B, 0, 3}));
}

TEST(RtuAnswer, HoldsTheWordsThatWereAskedFor) {
    const auto answer = on_a_line({0x01, 0x04, 0x02, 0x00, 0xE7, 0xF9, 0x7A});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->kind, Kind::words);
    EXPECT_EQ(answer->words, Words{231}); // 23.1 degC
}

TEST(RtuAnswer, IsWaitedForByteAfterByte) {
    RtuAnswer answer{first_input};
    for (const int byte : {0x01, 0x04, 0x02, 0x00, 0xE7, 0xF9}) {
        answer.feed(bytes_of({byte}));
        EXPECT_FALSE(answer.take());
    }
    answer.feed(bytes_of({0x7A}));
    EXPECT_EQ(answer.take()->words, Words{231});
}

// V1.1b3, 6.1: outputs 20 to 38, whose states are CD 6B 05, the first the lowest bit of CD.
TEST(RtuAnswer, HoldsTheBitsThatWereAskedFor) {
    const ModbusQuestion outputs{0x11, 1, 0x13, 0x13};
    EXPECT_EQ(rtu_request(outputs), bytes_of({0x11, 1, 0, 0x13, 0, 0x13, 0x8E, 0x92}));
    const auto answer = on_a_line({0x11, 1, 3, 0xCD, 0x6B, 5, 0x40, 0x12}, outputs);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->kind, Kind::words);
    EXPECT_EQ(answer->words, (Words{1, 0, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1}));
    EXPECT_EQ(on_a_line({0x11, 1, 2, 0xCD, 0x6B}, outputs)->kind, Kind::another);
}

TEST(TcpAnswers, HoldsTheBitsThatWereAskedFor) {
    const auto answer = on_a_connection({1, 2, 0, 0, 0, 4, 0x11, 1, 1, 2}, {0x11, 1, 266, 2});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->words, (Words{0, 1}));
}

TEST(RtuAnswer, OfAnotherUnitIsPassedOver) {
    EXPECT_FALSE(on_a_line({0x02, 0x04, 0x02, 0x01, 0xC8, 0xFD, 0x36}));
    const auto answer = on_a_line({0x02, 0x04, 0x02, 0x01, 0xC8, 0xFD, 0x36, //
                                   0x01, 0x04, 0x02, 0x00, 0xE7, 0xF9, 0x7A});
    EXPECT_EQ(answer->words, Words{231});
}

TEST(RtuAnswer, WithAnotherFunctionOrCountIsNone) {
    EXPECT_EQ(on_a_line({0x01, 0x03, 0x02, 0x00, 0xE7, 0xF8, 0x0E})->kind, Kind::another);
    EXPECT_EQ(on_a_line({0x01, 0x04, 0x04})->kind, Kind::another);
    EXPECT_EQ(on_a_line({0x01, 0x06, 0x00})->kind, Kind::another);
}

TEST(RtuAnswer, ThatIsFollowedByMoreIsNone) { // 2.5.1.1: 3.5 characters lie between frames
    EXPECT_EQ(on_a_line({0x01, 0x04, 0x02, 0x01, 0xC8, 0xB9, 0x36, //
                         0x01, 0x04, 0x02, 0x00, 0xE7, 0xF9, 0x7A})
                  ->kind,
              Kind::another);
}

TEST(RtuAnswer, WithABitTurnedIsDamaged) {
    EXPECT_EQ(on_a_line({0x01, 0x04, 0x02, 0x00, 0xE6, 0xF9, 0x7A})->kind, Kind::damaged);
    EXPECT_EQ(on_a_line({0x03, 0x04, 0x02, 0x00, 0xE7, 0xF9, 0x7A})->kind, Kind::damaged);
}

TEST(RtuAnswer, MayBeAnException) {
    const auto answer = on_a_line({0x01, 0x84, 0x02, 0xC2, 0xC1});
    EXPECT_EQ(answer->kind, Kind::exception);
    EXPECT_EQ(answer->exception, 2);
}

TEST(TcpAnswers, OfAnotherUnitAreNone) { // 3.1.3: the unit is given back
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 5, 1, 4, 2, 0, 0xC8})->words, Words{200});
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 5, 1, 4, 2, 0, 0xC8}, {2, 4, 0, 1})->kind,
              Kind::another);
}

TEST(TcpAnswers, OfAnotherTransactionArePassedOver) {
    EXPECT_FALSE(on_a_connection({1, 1, 0, 0, 0, 5, 1, 4, 2, 0, 0x63}));
    const auto answer = on_a_connection({1, 1, 0, 0, 0, 5, 1, 4, 2, 0, 0x63, //
                                         1, 2, 0, 0, 0, 5, 1, 4, 2, 0, 0xC8});
    EXPECT_EQ(answer->words, Words{200});
}

TEST(TcpAnswers, ThatAreCutGoOnWithTheNextBytes) {
    TcpAnswers answers;
    answers.feed(bytes_of({1, 1, 0, 0, 0, 5, 1, 4}));
    EXPECT_FALSE(answers.take(first_input, 0x0101)); // timed out here
    answers.feed(bytes_of({2, 0, 0x63, 1, 2, 0, 0, 0, 5, 1, 4, 2, 0, 0xC8}));
    EXPECT_EQ(answers.take(first_input, 0x0102)->words, Words{200});
}

TEST(TcpAnswers, WithAnotherProtocolOrLengthAreOutOfStep) {
    EXPECT_EQ(on_a_connection({1, 2, 0, 1, 0, 5, 1})->kind, Kind::out_of_step);
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 2, 1})->kind, Kind::out_of_step);
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 255, 1})->kind, Kind::out_of_step);
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 1, 5, 1})->kind, Kind::out_of_step);
    EXPECT_FALSE(on_a_connection({1, 2, 0, 0, 0, 254, 1}));
}

TEST(TcpAnswers, WithAnotherLengthThanTheirCountAreNone) {
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 6, 1, 4, 2, 0, 0xC8, 0})->kind, Kind::another);
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 5, 1, 4, 4, 0, 0xC8})->kind, Kind::another);
    EXPECT_EQ(on_a_connection({1, 2, 0, 0, 0, 7, 1, 4, 4, 0, 0xC8, 0, 1})->kind, Kind::another);
}

TEST(TcpAnswers, MayBeAGatewaysException) {
    const auto answer = on_a_connection({1, 2, 0, 0, 0, 3, 2, 0x84, 0x0B}, {2, 4, 0, 1});
    EXPECT_EQ(answer->kind, Kind::exception);
    EXPECT_EQ(answer->exception, 11);
}

} // namespace
} // namespace axiscal::modbus_answers_test
