// Literal answers: the examples of the Modbus application protocol V1.1b3, 6.3, and its exceptions.
#include "drivers/framing/modbus_reply.hpp"

#include <gtest/gtest.h>

namespace axiscal::modbus_reply_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(ModbusReply, TellsHowMuchFollowsItsHeader) {
    const Bytes header{0x15, 0x01, 0, 0, 0, 0x09, 0xFF};
    EXPECT_EQ(modbus_reply_length(header, 0x1501, 0xFF), 8U);
    EXPECT_FALSE(modbus_reply_length(header, 0x1502, 0xFF)); // to a question given up before
    EXPECT_FALSE(modbus_reply_length(header, 0x1501, 1));    // 3.1.3: the unit is given back
    EXPECT_FALSE(modbus_reply_length(Bytes{0x15, 0x01, 0, 1, 0, 0x09, 0xFF}, 0x1501, 0xFF));
    for (const auto& [high, low] : {std::pair{0, 0}, std::pair{0, 2}, std::pair{0, 255},
                                    std::pair{1, 0}, std::pair{255, 255}}) {
        const Bytes wrong{
            0x15, 0x01, 0, 0, static_cast<std::uint8_t>(high), static_cast<std::uint8_t>(low),
            0xFF};
        EXPECT_FALSE(modbus_reply_length(wrong, 0x1501, 0xFF)) << high << " " << low;
    }
}

TEST(ModbusReply, HoldsTheThreeRegistersOfTheProtocolsExample) {
    const Bytes answer{0x03, 0x06, 0x02, 0x2B, 0x00, 0x00, 0x00, 0x64};
    EXPECT_EQ(kind_of_modbus_reply(answer, 3), ModbusReplyKind::answer);
    EXPECT_EQ(registers_of_reply(answer, 3).value(), (std::vector<std::uint16_t>{555, 0, 100}));
    EXPECT_FALSE(registers_of_reply(answer, 2));
    EXPECT_FALSE(registers_of_reply(answer, 4));
    for (std::size_t size = 0; size < answer.size(); ++size)
        EXPECT_FALSE(registers_of_reply(std::span{answer}.first(size), 3)) << size;
}

TEST(ModbusReply, TellsAnExceptionFromWhatIsNoAnswer) {
    EXPECT_EQ(kind_of_modbus_reply(Bytes{0x83, 0x02}, 3), ModbusReplyKind::exception);
    EXPECT_EQ(kind_of_modbus_reply(Bytes{0x90, 0x02}, 3), ModbusReplyKind::other);
    EXPECT_EQ(kind_of_modbus_reply(Bytes{0x03}, 3), ModbusReplyKind::other);
    EXPECT_EQ(kind_of_modbus_reply(Bytes{}, 3), ModbusReplyKind::other);
}

} // namespace
} // namespace axiscal::modbus_reply_test
