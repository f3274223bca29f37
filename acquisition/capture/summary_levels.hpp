#pragma once
// Summaries of blocks of 64, 4096 and 262144 samples of a history, kept while it grows and forgets.

#include "acquisition/capture/sample_summary.hpp"

#include <array>
#include <cstddef>
#include <deque>

namespace axiscal {

/// Samples are told by their number since the first push(). A block begins at a multiple of its
/// size. push() costs a constant time a sample in the mean; a look needs some hundred blocks at
/// most, however many samples lie between.
class SummaryLevels {
public:
    static constexpr std::size_t count = 3, factor = 64;

    struct Block {
        const SampleSummary* summary = nullptr; ///< null: no whole block is there
        std::size_t level = 0;
    };

    void push(const Sample& sample);
    /// Blocks that begin before this number can no longer be had.
    void forget_before(std::size_t number);

    /// The largest block of less than `levels` levels that begins at `begin` and ends at `end` or
    /// before.
    [[nodiscard]] Block
    beginning_at(std::size_t begin, std::size_t end, std::size_t levels = count) const;
    /// The same of one that ends at `end` and begins at `begin` or after.
    [[nodiscard]] Block
    ending_at(std::size_t begin, std::size_t end, std::size_t levels = count) const;

private:
    struct Level {
        std::deque<SampleSummary> blocks;
        std::size_t forgotten = 0; ///< blocks before the first
        SampleSummary open;        ///< not yet a whole block
    };
    [[nodiscard]] const SampleSummary* find(std::size_t level, std::size_t begin) const;

    std::array<Level, count> levels_;
};

} // namespace axiscal
