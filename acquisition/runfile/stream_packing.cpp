#include "acquisition/runfile/stream_packing.hpp"

#include "acquisition/runfile/folding.hpp"
#include "acquisition/runfile/row.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <zstd.h>

namespace axiscal {
namespace {

constexpr int level = 3; ///< zstd's usual one: 300 MB/s and more
/// Of a stream in a file: a thousand a second for thirty years.
constexpr std::int64_t most_blocks = 1'000'000'000'000;
constexpr char values_as_they_are = 1, values_as_differences = 2;

/// Byte k of every word, then byte k + 1: equal bytes come to stand together.
void put_planes(std::string& bytes, const std::vector<std::uint64_t>& words) {
    for (unsigned shift = 0; shift < 64; shift += 8)
        for (const std::uint64_t word : words)
            bytes += static_cast<char>(static_cast<unsigned char>(word >> shift));
}

std::vector<std::uint64_t> planes_at(std::string_view bytes, std::size_t count) {
    std::vector<std::uint64_t> words(count, 0);
    for (std::size_t plane = 0; plane < 8; ++plane)
        for (std::size_t i = 0; i < count; ++i)
            words[i] |= std::uint64_t{static_cast<unsigned char>(bytes[plane * count + i])}
                        << (8 * plane);
    return words;
}

std::vector<std::uint64_t> differences(const std::vector<std::uint64_t>& words) {
    std::vector<std::uint64_t> steps;
    steps.reserve(words.size());
    std::uint64_t last = 0;
    for (const std::uint64_t word : words)
        steps.push_back(word - std::exchange(last, word));
    return steps;
}

std::vector<std::uint64_t> sums(std::vector<std::uint64_t> steps) {
    std::uint64_t sum = 0;
    for (std::uint64_t& step : steps)
        step = sum += step;
    return steps;
}

std::vector<std::uint64_t> all_folded(std::vector<std::uint64_t> words) {
    for (std::uint64_t& word : words)
        word = folded(word);
    return words;
}

std::string compressed(const std::string& bytes) {
    std::string frame(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size =
        ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), level);
    frame.resize(ZSTD_isError(size) != 0 ? 0 : size); // cannot fail: the bound was given
    return frame;
}

std::string form_of(const StreamChunk& chunk, char form) {
    std::vector<std::uint64_t> times, values;
    times.reserve(chunk.at.size());
    values.reserve(chunk.at.size());
    for (const MonotonicTime at : chunk.at)
        times.push_back(static_cast<std::uint64_t>(nanoseconds_of(at)));
    for (const double value : chunk.value)
        values.push_back(std::bit_cast<std::uint64_t>(value));
    std::string bytes;
    bytes.reserve(chunk.at.size() * 16);
    put_planes(bytes, all_folded(differences(differences(times))));
    if (form == values_as_differences)
        put_planes(bytes, all_folded(differences(values)));
    else
        for (const std::uint64_t word : values)
            put_u64(bytes, word);
    return form + compressed(bytes);
}

tl::unexpected<Error> bad(const StreamBlock& block, const std::string& why) {
    return fail(Fault::bad_run_file, "block " + std::to_string(block.index) + " of stream " +
                                         std::to_string(block.stream) + " " + why);
}

Result<void> check_chunk(const StreamChunk& chunk) {
    const StreamBlock& block = chunk.head;
    const auto not_later = [](MonotonicTime a, MonotonicTime b) { return b <= a; };
    if (std::ranges::adjacent_find(chunk.at, not_later) != chunk.at.end())
        return bad(block, "holds times that do not ascend");
    if (!std::ranges::all_of(chunk.value, [](double value) { return std::isfinite(value); }))
        return bad(block, "holds a value that is no number");
    if (chunk.at.front() != block.begin || chunk.at.back() != block.end)
        return bad(block, "begins or ends at another time than stated");
    return {};
}

/// Written once more, because the disk failed without telling whether it had kept it.
bool stands_before(std::span<const StreamBlock> blocks, const StreamBlock& again) {
    return std::ranges::any_of(blocks, [&](const StreamBlock& block) {
        return &block < &again && block.stream == again.stream && block.index == again.index &&
               block.packed == again.packed;
    });
}

} // namespace

StreamBlock packed(const StreamChunk& chunk) {
    StreamBlock block = chunk.head;
    block.samples = static_cast<int>(chunk.value.size());
    block.packed.clear();
    if (chunk.value.empty()) return block;
    block.begin = chunk.at.front();
    block.end = chunk.at.back();
    const auto [low, high] = std::ranges::minmax(chunk.value);
    block.low = low;
    block.high = high;
    std::string plain = form_of(chunk, values_as_they_are);
    std::string steps = form_of(chunk, values_as_differences);
    block.packed = std::move(steps.size() <= plain.size() ? steps : plain);
    return block;
}

Result<StreamChunk> unpacked(const StreamBlock& block) {
    if (block.samples < 1 || static_cast<std::size_t>(block.samples) > most_samples_a_block)
        return bad(block, "states an impossible number of samples");
    const auto count = static_cast<std::size_t>(block.samples);
    std::string bytes(count * 16, '\0');
    const char form = block.packed.empty() ? '\0' : block.packed.front();
    if (form != values_as_they_are && form != values_as_differences)
        return bad(block, "is packed in a form that is not known");
    const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), block.packed.data() + 1,
                                             block.packed.size() - 1);
    if (ZSTD_isError(size) != 0 || size != bytes.size())
        return bad(block, "does not hold the samples that it states");
    StreamChunk chunk{block, {}, {}};
    chunk.head.packed.clear();
    const std::string_view all = bytes;
    const auto unfold = [](std::vector<std::uint64_t> words) {
        std::ranges::transform(words, words.begin(), unfolded);
        return words;
    };
    for (const std::uint64_t ns : sums(sums(unfold(planes_at(all, count)))))
        chunk.at.push_back(monotonic_from_ns(static_cast<std::int64_t>(ns)));
    const std::string_view rest = all.substr(count * 8);
    if (form == values_as_differences)
        for (const std::uint64_t word : sums(unfold(planes_at(rest, count))))
            chunk.value.push_back(std::bit_cast<double>(word));
    else
        for (std::size_t i = 0; i < count; ++i)
            chunk.value.push_back(std::bit_cast<double>(get_u64(rest.substr(i * 8))));
    AXISCAL_CHECK(check_chunk(chunk));
    return chunk;
}

Result<StreamSamples> samples_of(std::span<const StreamBlock> blocks, int stream) {
    StreamSamples samples;
    std::int64_t next = 0;
    for (const StreamBlock& block : blocks) {
        if (block.stream != stream) continue;
        if (block.index > most_blocks) return bad(block, "states an impossible place");
        if (block.index < next && stands_before(blocks, block)) continue;
        AXISCAL_TRY(StreamChunk chunk, unpacked(block));
        if (block.index < next) return bad(block, "comes out of order");
        if (!samples.at.empty() && chunk.at.front() <= samples.at.back())
            return bad(block, "begins before the one before it ends");
        const std::int64_t dropped = block.index - std::exchange(next, block.index + 1);
        samples.dropped_blocks += static_cast<std::uint64_t>(dropped);
        if (dropped > 0 || !block.before.empty())
            samples.gaps.push_back(
                {samples.at.size(), block.missing, dropped > 0 ? "dropped" : block.before});
        samples.times.push_back({samples.at.size(), block.time_uncertainty});
        samples.at.insert(samples.at.end(), chunk.at.begin(), chunk.at.end());
        samples.value.insert(samples.value.end(), chunk.value.begin(), chunk.value.end());
    }
    return samples;
}

} // namespace axiscal
