#pragma once
// One channel at its full rate, cut into chunks that have no hole. Loop-bound.

#include "analysis/record/stream_record.hpp"
#include "drivers/sample.hpp"

#include <optional>

namespace axiscal {

class StreamChunker {
public:
    static constexpr std::size_t most_samples = 16'384; ///< 256 kB: 0.33 s of 50 kHz
    static constexpr Duration longest = std::chrono::seconds{1};

    explicit StreamChunker(int stream)
        : stream_{stream} {}
    /// Goes on behind the last block of a record that was interrupted: the next chunk has the hole
    /// "interrupted" before it. `numbers_ran_on`: the instrument's numbering is the same as then,
    /// so what is missing can be counted.
    StreamChunker(const StreamBlock& last, bool numbers_ran_on);

    /// Takes one sample; hands over a chunk when it is full, old enough, or ended by a hole: a
    /// sample that is not good, a number that the instrument left out, a new epoch.
    std::optional<StreamChunk> push(const Sample& sample);
    /// What is left, at the end.
    std::optional<StreamChunk> finish();

    [[nodiscard]] std::uint64_t samples() const { return samples_; }
    [[nodiscard]] std::uint64_t gaps() const { return gaps_; }
    [[nodiscard]] std::uint64_t missing() const { return missing_; }
    [[nodiscard]] std::uint64_t disordered() const { return disordered_; }

private:
    void look_for_hole(const Sample& sample);
    [[nodiscard]] bool wanted(const Sample& sample);

    int stream_;
    std::int64_t next_index_ = 0;
    StreamChunk chunk_;
    std::optional<Sample> last_; ///< the last good one
    bool interrupted_ = false;   ///< between it and the next one
    std::string before_;         ///< of the next chunk
    std::uint64_t missing_before_ = 0;
    std::uint64_t samples_ = 0, gaps_ = 0, missing_ = 0, disordered_ = 0;
};

} // namespace axiscal
