// Recorded bytes as text.

#include "drivers/recording/tape_link.hpp"
#include "tests/fuzz/judge.hpp"

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto tape = parse_tape(fuzz::as_text(data, size));
    if (!tape) {
        fuzz::require(!tape.error().detail.empty(), "a refused tape has a reason");
        return 0;
    }
    fuzz::require(tape->header.contains("origin"), "a tape has an origin");
    Duration last{};
    for (const auto& entry : tape->entries) {
        fuzz::require(entry.offset >= last, "offsets never go back");
        last = entry.offset;
    }
    return 0;
}
