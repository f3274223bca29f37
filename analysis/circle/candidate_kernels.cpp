#include "analysis/circle/candidate_kernels.hpp"

#include "analysis/circle/wide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axiscal::circle {
namespace {

/// Squared distances of one block of neighbouring points.
struct Extremes {
    double lowest = 0, highest = 0;
};

constexpr Extremes nothing{std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()};

void include(Extremes& range, double value) {
    range.lowest = std::min(range.lowest, value);
    range.highest = std::max(range.highest, value);
}

double squared_distance(const Target& t, std::size_t i) {
    const double dx = t.x[i] - t.center_x, dy = t.y[i] - t.center_y;
    return dx * dx + dy * dy;
}

Extremes extremes_of(const Target& t, std::size_t begin, std::size_t end) {
    using Lanes = Four;
    const Lanes center_x{t.center_x}, center_y{t.center_y};
    Lanes low{nothing.lowest}, high{nothing.highest};
    std::size_t i = begin;
    for (; i + Lanes::lanes <= end; i += Lanes::lanes) {
        const Lanes dx = Lanes::load(&t.x[i]) - center_x, dy = Lanes::load(&t.y[i]) - center_y;
        const Lanes squared = dx * dx + dy * dy;
        low = smaller(squared, low);
        high = larger(squared, high);
    }
    Extremes range = nothing;
    for (std::size_t lane = 0; lane < Lanes::lanes; ++lane) {
        range.lowest = std::min(range.lowest, low[lane]);
        range.highest = std::max(range.highest, high[lane]);
    }
    for (; i < end; ++i)
        include(range, squared_distance(t, i));
    return range;
}

/// Small lists are cut finer, so that looking a block through again costs little.
std::size_t block_for(std::size_t points) {
    return points < 16384 ? 64 : 512;
}

struct Blocks {
    std::size_t length;
    std::vector<Extremes> extremes;
};

Blocks blocks_of(const Target& t) {
    const std::size_t length = block_for(t.x.size());
    Blocks blocks{length, std::vector<Extremes>((t.x.size() + length - 1) / length)};
    for (std::size_t i = 0, begin = 0; i < blocks.extremes.size(); ++i, begin += length)
        blocks.extremes[i] = extremes_of(t, begin, std::min(begin + length, t.x.size()));
    return blocks;
}

std::size_t index_of(const Target& t, double squared, std::size_t begin, std::size_t block) {
    const std::size_t end = std::min(begin + block, t.x.size());
    for (std::size_t i = begin; i < end; ++i)
        if (squared_distance(t, i) == squared) return i;
    return begin; // not reached: the block holds its extremes
}

} // namespace

std::vector<std::size_t> find_outside(const Target& target, const Ring& ring) {
    constexpr std::size_t stretches = 32;
    const auto [length, extremes] = blocks_of(target);
    const std::size_t stretch = (extremes.size() + stretches - 1) / stretches;
    std::vector<std::size_t> found;
    for (std::size_t first = 0; first < extremes.size(); first += stretch) {
        const std::size_t last = std::min(first + stretch, extremes.size());
        std::size_t lowest = first, highest = first;
        for (std::size_t i = first + 1; i < last; ++i) {
            if (extremes[i].lowest < extremes[lowest].lowest) lowest = i;
            if (extremes[i].highest > extremes[highest].highest) highest = i;
        }
        if (const double squared = extremes[highest].highest; squared > ring.outer)
            found.push_back(index_of(target, squared, highest * length, length));
        if (const double squared = extremes[lowest].lowest; squared < ring.inner)
            found.push_back(index_of(target, squared, lowest * length, length));
    }
    return found;
}

std::size_t find_furthest(const Target& target) {
    const auto [length, extremes] = blocks_of(target);
    const auto furthest = std::ranges::max_element(extremes, {}, &Extremes::highest);
    const auto block = static_cast<std::size_t>(furthest - extremes.begin());
    return index_of(target, furthest->highest, block * length, length);
}

} // namespace axiscal::circle
