#include "acquisition/capture/summary_levels.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr std::array<std::size_t, SummaryLevels::count> block_sizes{
    SummaryLevels::factor, SummaryLevels::factor* SummaryLevels::factor,
    SummaryLevels::factor* SummaryLevels::factor* SummaryLevels::factor};

} // namespace

void SummaryLevels::push(const Sample& sample) {
    SampleSummary part{sample};
    for (std::size_t i = 0; i < count; ++i) {
        Level& level = levels_[i];
        level.open.append(part);
        if (level.open.n < block_sizes[i]) return;
        part = std::exchange(level.open, {});
        level.blocks.push_back(part);
    }
}

void SummaryLevels::forget_before(std::size_t number) {
    for (std::size_t i = 0; i < count; ++i) {
        Level& level = levels_[i];
        while (!level.blocks.empty() && level.forgotten * block_sizes[i] < number) {
            level.blocks.pop_front();
            ++level.forgotten;
        }
    }
}

const SampleSummary* SummaryLevels::find(std::size_t level, std::size_t begin) const {
    const auto& [blocks, forgotten, open] = levels_[level];
    const std::size_t block = begin / block_sizes[level];
    const bool there =
        begin % block_sizes[level] == 0 && block >= forgotten && block - forgotten < blocks.size();
    return there ? &blocks[block - forgotten] : nullptr;
}

SummaryLevels::Block
SummaryLevels::beginning_at(std::size_t begin, std::size_t end, std::size_t levels) const {
    for (std::size_t level = levels; level-- > 0;)
        if (begin + block_sizes[level] <= end)
            if (const SampleSummary* found = find(level, begin)) return {found, level};
    return {};
}

SummaryLevels::Block
SummaryLevels::ending_at(std::size_t begin, std::size_t end, std::size_t levels) const {
    for (std::size_t level = levels; level-- > 0;)
        if (begin + block_sizes[level] <= end)
            if (const SampleSummary* found = find(level, end - block_sizes[level]))
                return {found, level};
    return {};
}

} // namespace axiscal
