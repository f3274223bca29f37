// Bytes of a uMD counter: whatever comes, a record has 1 or 3 axes and comes from a plain line.

#include "drivers/framing/line_framer.hpp"
#include "drivers/laser/umd_record.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <string>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span{data, size});
    std::string whole, split;
    const auto judge = [](std::string_view line, std::string& seen) {
        seen.append(line).push_back('\n');
        const auto record = decode_umd_record(line);
        if (!record) return;
        fuzz::require(record->axis_count == 1 || record->axis_count == 3, "1 or 3 axes");
        const auto plain = [](char c) {
            return c == ' ' || c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9');
        };
        fuzz::require(std::all_of(line.begin(), line.end(), plain), "only numbers make a record");
    };
    LineFramer at_once{200}, byte_by_byte{200};
    at_once.feed(bytes, [&](std::string_view line) { judge(line, whole); });
    for (const auto& byte : bytes)
        byte_by_byte.feed({&byte, 1}, [&](std::string_view line) { judge(line, split); });
    fuzz::require(whole == split, "reads that split a line change nothing");
    fuzz::require(at_once.oversized() == byte_by_byte.oversized(), "oversized lines are counted");
    return 0;
}
