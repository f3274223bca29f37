#pragma once
// Samples of a stream as few bytes, and back, bit for bit. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/stream_record.hpp"

#include <span>

namespace axiscal {

/// The chunk's head with `samples`, `begin`, `end`, `low`, `high` and `packed` filled in. Bytes of
/// `packed` (docs/run-file.md): one byte for the form of the values, then a zstd frame of 16 bytes
/// a sample: times as second differences, values as differences or as they are, whichever is
/// shorter; both shuffled into planes of equal bytes.
StreamBlock packed(const StreamChunk& chunk);

/// @errors Fault::bad_run_file for bytes that are no block, another number of samples than told,
/// times that do not ascend, a value that is no number.
Result<StreamChunk> unpacked(const StreamBlock& block);

/// The blocks of one stream in order, joined; holes are kept as gaps.
/// @errors those of `unpacked`, and for blocks that do not follow each other.
Result<StreamSamples> samples_of(std::span<const StreamBlock> blocks, int stream);

inline constexpr std::size_t most_samples_a_block = 65'536;

} // namespace axiscal
