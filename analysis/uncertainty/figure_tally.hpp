#pragma once
// Counts the figures of simulated sessions, and reads coverage intervals from the counts: JCGM 101
// (GUM supplement 1), 7.5 to 7.7, without keeping the samples. Pure.

#include "analysis/uncertainty/session_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace axiscal {

struct Interval {
    double low = 0, high = 0;
    bool operator==(const Interval&) const = default;
};

struct CoverageIntervals {
    Interval symmetric; ///< as much probability below as above
    Interval shortest;  ///< of least width; the lowest of equals
};

/// Sums and a histogram of every figure.
class FigureTally {
public:
    static constexpr std::size_t buckets = 8192;

    /// evaluated: what the sums count from, so that no digits are lost. pilot: sessions whose
    /// range, half as much again to either side, becomes that of the histogram; not counted yet.
    FigureTally(const std::array<double, figure_count>& evaluated,
                const std::vector<Figures>& pilot);

    /// Counts eight sessions; a value beyond the range counts in the bucket at that end.
    void add(const Figures& sessions, LaneCode code);

    [[nodiscard]] double trials() const { return static_cast<double>(groups_ * lanes); }
    [[nodiscard]] double mean(std::size_t figure) const;
    [[nodiscard]] double standard_deviation(std::size_t figure) const;
    /// Probability taken as spread evenly in each bucket (about a thousandth of the deviation
    /// wide): far below the sampling error. A figure that never changes has intervals of no width.
    [[nodiscard]] CoverageIntervals intervals(std::size_t figure, double coverage = 0.95) const;

private:
    friend struct TallyKernel;
    using OfLanes = std::array<double, lanes>;
    std::array<double, figure_count> evaluated_{}, low_{}, scale_{};
    std::array<OfLanes, figure_count> sum_{}, squares_{}; ///< of value - evaluated
    std::vector<std::uint32_t> counts_;                   ///< [figure][bucket]
    std::size_t groups_ = 0;
};

/// `groups` times eight sessions of `simulation`, whose next() makes the figures of eight.
template <class Simulation>
FigureTally tally_of(Simulation& simulation,
                     std::size_t groups,
                     const std::array<double, figure_count>& evaluated) {
    constexpr std::size_t most_pilots = 512; // 4096 sessions show the range
    const LaneCode code = fastest_lane_code();
    std::vector<Figures> pilot(std::min(groups, most_pilots));
    for (Figures& figures : pilot)
        figures = simulation.next();
    FigureTally tally{evaluated, pilot};
    for (const Figures& figures : pilot)
        tally.add(figures, code);
    for (std::size_t g = pilot.size(); g < groups; ++g)
        tally.add(simulation.next(), code);
    return tally;
}

} // namespace axiscal
