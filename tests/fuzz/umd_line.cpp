// Bytes of a uMD counter: whatever comes, a record has 1 or 3 axes and comes from a plain line.

#include "drivers/framing/line_framer.hpp"
#include "drivers/laser/umd_facts.hpp"
#include "drivers/laser/umd_record.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace axiscal;

namespace {

/// What the low-speed slots of all records say together.
void judge_facts(UmdFacts& facts, const UmdRecord& record) {
    facts.learn(record.low_speed_code, record.low_speed_data);
    (void)facts.missing();
    (void)facts.contradiction();
    fuzz::require(!facts.model().empty(), "an instrument has a name");
    (void)facts.firmware();
    if (!facts.complete()) return;
    fuzz::require(facts.metres_per_count() > 0, "a count has a length");
    const auto position =
        umd_position(record.axes[0].displacement, record.axes[0].phase, *facts.phase());
    fuzz::require(!position || std::isfinite(*position), "no NaN leaves the decoder");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span{data, size});
    std::string whole, split;
    UmdSetup setup;
    setup.wavelength = nm(632.991354);
    UmdFacts facts{setup};
    const auto judge = [&facts](std::string_view line, std::string& seen) {
        seen.append(line).push_back('\n');
        const auto record = decode_umd_record(line);
        if (!record) return;
        judge_facts(facts, *record);
        fuzz::require(record->axis_count == 1 || record->axis_count == 3, "1 or 3 axes");
        const auto plain = [](char c) {
            return c == ' ' || c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9');
        };
        fuzz::require(std::all_of(line.begin(), line.end(), plain), "only numbers make a record");
    };
    LineFramer at_once{200}, byte_by_byte{200};
    const auto oversized = at_once.feed(bytes, [&](std::string_view line) { judge(line, whole); });
    std::uint64_t oversized_split = 0;
    for (const auto& byte : bytes)
        oversized_split +=
            byte_by_byte.feed({&byte, 1}, [&](std::string_view line) { judge(line, split); });
    fuzz::require(whole == split, "reads that split a line change nothing");
    fuzz::require(oversized == oversized_split, "oversized lines are counted");
    return 0;
}
