// What a Modbus TCP server answers to the mirrored trigger port: how many registers were asked for,
// the number of the transaction in two bytes, then header and PDU.

#include "drivers/cnc/modbus_reply.hpp"
#include "drivers/cnc/mbap_framer.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <span>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t head = 3;
    if (size < head + mbap_header) return 0;
    const int count = 1 + data[0] % 125;
    const auto transaction = static_cast<std::uint16_t>(data[1] << 8 | data[2]);
    const std::span<const std::uint8_t> answer{data + head, size - head};
    const auto length = modbus_reply_length(answer.first(mbap_header), transaction);
    fuzz::require(!length || (*length >= 2 && *length <= 253), "a PDU has its bounds");
    // Read with and without a header that fits: it is no wall against this search.
    const auto rest = answer.subspan(mbap_header);
    const auto pdu = rest.first(std::min(length.value_or(rest.size()), rest.size()));
    constexpr std::uint8_t read_holding_registers = 3;
    const auto kind = kind_of_modbus_reply(pdu, read_holding_registers);
    fuzz::require(kind != ModbusReplyKind::exception || pdu.size() >= 2, "an exception has a code");
    const auto words = registers_of_reply(pdu, count);
    fuzz::require(!words || words->size() == static_cast<std::size_t>(count),
                  "as many words as were asked for");
    return 0;
}
