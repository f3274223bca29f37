// Blocks of a stream in a run file that was handed over. Input: how many samples (1 to 64), eight
// bytes of index, eight bytes a sample for its value, then changes of the packed bytes (offset 2,
// value). What was packed comes back bit for bit; what was changed is refused or is a stream.

#include "acquisition/runfile/stream_packing.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

using namespace axiscal;

namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint64_t take_word(Bytes& rest) {
    std::uint64_t word = 0;
    const std::size_t length = std::min(rest.size(), sizeof word);
    std::memcpy(&word, rest.data(), length);
    rest = rest.subspan(length);
    return word;
}

StreamChunk chunk_of(Bytes& rest) {
    StreamChunk chunk;
    const int samples = 1 + rest[0] % 64;
    rest = rest.subspan(1);
    chunk.head.index = static_cast<std::int64_t>(take_word(rest));
    for (int i = 0; i < samples; ++i) {
        const auto value = std::bit_cast<double>(take_word(rest));
        chunk.value.push_back(std::isfinite(value) ? value : 0);
        chunk.at.push_back(monotonic_from_ns(1'000'000'000 + 1'000'000 * std::int64_t{i} + i % 3));
    }
    return chunk;
}

bool same_bits(const StreamChunk& one, const StreamChunk& other) {
    const auto bits = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    return one.at == other.at && std::ranges::equal(one.value, other.value, bits);
}

void judge(const StreamBlock& block) {
    const auto chunk = unpacked(block);
    if (!chunk) {
        fuzz::require(!chunk.error().detail.empty(), "a refused block has a reason");
        return;
    }
    fuzz::require(chunk->value.size() == static_cast<std::size_t>(block.samples) &&
                      chunk->at.size() == chunk->value.size(),
                  "a block holds what it tells");
    fuzz::require(std::ranges::all_of(chunk->value, [](double v) { return std::isfinite(v); }),
                  "every value is a number");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes rest{data, size};
    if (rest.empty()) return 0;
    const StreamChunk chunk = chunk_of(rest);
    const StreamBlock good = packed(chunk);
    const auto back = unpacked(good);
    fuzz::require(back && same_bits(chunk, *back), "every bit comes back");
    StreamBlock changed = good;
    for (; rest.size() >= 3; rest = rest.subspan(3))
        changed.packed[(256U * rest[0] + rest[1]) % changed.packed.size()] =
            static_cast<char>(rest[2]);
    judge(changed);
    StreamBlock next = good;
    next.index = static_cast<std::int64_t>(static_cast<std::uint64_t>(good.index) + 1);
    for (const auto& blocks : {std::vector{good, changed}, std::vector{good, next}})
        if (const auto joined = samples_of(blocks, good.stream); !joined)
            fuzz::require(!joined.error().detail.empty(), "a refused stream has a reason");
    return 0;
}
