// Bytes of a Modbus TCP client: frames stay within the protocol's bounds, requests within theirs.

#include "drivers/trigger/modbus_request.hpp"
#include "drivers/trigger/mbap_framer.hpp"
#include "tests/fuzz/judge.hpp"

using namespace axiscal;

namespace {

using Frames = std::vector<std::vector<std::uint8_t>>;

void judge(std::span<const std::uint8_t> pdu) {
    const auto request = parse_modbus_request(pdu);
    if (!request) {
        fuzz::require(request.error() != ModbusException::none, "a refusal has a reason");
        return;
    }
    fuzz::require(request->read_address >= 0 && request->read_address <= 0xFFFF &&
                      request->write_address >= 0 && request->write_address <= 0xFFFF,
                  "addresses are 16 bits");
    fuzz::require(request->read_count >= 0 && request->read_count <= 2000 &&
                      request->values.size() <= 1968,
                  "counts are the protocol's");
    fuzz::require(request->read_count > 0 || !request->values.empty(), "a request asks something");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes{data, size};
    judge(bytes);
    MbapFramer at_once, byte_by_byte;
    Frames whole, split;
    at_once.feed(bytes);
    while (const auto frame = at_once.next())
        whole.push_back(*frame);
    for (const auto& byte : bytes) {
        byte_by_byte.feed({&byte, 1});
        while (const auto frame = byte_by_byte.next())
            split.push_back(*frame);
    }
    fuzz::require(whole == split && at_once.broken() == byte_by_byte.broken(),
                  "reads that split a frame change nothing");
    for (const auto& frame : whole) {
        fuzz::require(frame.size() > mbap_header && frame.size() <= 260, "a frame has its bounds");
        judge(std::span{frame}.subspan(mbap_header));
    }
    return 0;
}
