// What a Modbus server answers: how many registers were asked for, the number of the transaction in
// two bytes, then header and PDU. The same bytes are taken for those of an RTU line, with their
// right checksum behind them, and both are fed in two pieces.

#include "drivers/framing/modbus_reply.hpp"
#include "drivers/framing/checksum.hpp"
#include "drivers/framing/modbus_answers.hpp"
#include "drivers/trigger/mbap_framer.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <span>

using namespace axiscal;

namespace {

using Bytes = std::span<const std::uint8_t>;
constexpr std::uint8_t read_coils = 1, read_holding_registers = 3;

void judge(const std::optional<ModbusAnswer>& answer, int count) {
    if (!answer) return;
    const bool has_words = answer->kind == ModbusAnswer::Kind::words;
    fuzz::require(answer->words.size() == (has_words ? static_cast<std::size_t>(count) : 0U),
                  "as many words as were asked for, or none");
}

void find_answers(Bytes answer, std::uint8_t function, int count, std::uint16_t transaction) {
    const ModbusQuestion question{answer[6], function, 0, count};
    const auto half = std::as_bytes(answer.first(answer.size() / 2));
    const auto rest = std::as_bytes(answer.subspan(answer.size() / 2));
    TcpAnswers connection;
    connection.feed(half);
    judge(connection.take(question, transaction), count);
    connection.feed(rest);
    judge(connection.take(question, transaction), count);
    const Bytes frame = answer.subspan(6); // from the unit on
    const unsigned sum = crc16_modbus(frame);
    const std::uint8_t checksum[] = {static_cast<std::uint8_t>(sum),
                                     static_cast<std::uint8_t>(sum >> 8U)};
    RtuAnswer line{question};
    line.feed(std::as_bytes(frame));
    judge(line.take(), count);
    line.feed(std::as_bytes(std::span{checksum}));
    judge(line.take(), count);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t head = 3;
    if (size < head + mbap_header) return 0;
    const int count = 1 + data[0] % 125;
    const auto transaction = static_cast<std::uint16_t>(data[1] << 8 | data[2]);
    const Bytes answer{data + head, size - head};
    const auto length = modbus_reply_length(answer.first(mbap_header), transaction, answer[6]);
    fuzz::require(!length || (*length >= 2 && *length <= 253), "a PDU has its bounds");
    // Read with and without a header that fits: it is no wall against this search.
    const auto rest = answer.subspan(mbap_header);
    const auto pdu = rest.first(std::min(length.value_or(rest.size()), rest.size()));
    const auto kind = kind_of_modbus_reply(pdu, read_holding_registers);
    fuzz::require(kind != ModbusReplyKind::exception || pdu.size() >= 2, "an exception has a code");
    const auto words = registers_of_reply(pdu, count);
    fuzz::require(!words || words->size() == static_cast<std::size_t>(count),
                  "as many words as were asked for");
    const auto bits = bits_of_reply(pdu, count);
    fuzz::require(!bits || bits->size() == static_cast<std::size_t>(count),
                  "as many bits as were asked for");
    for (const std::uint8_t function : {read_coils, read_holding_registers})
        find_answers(answer, function, count, transaction);
    return 0;
}
