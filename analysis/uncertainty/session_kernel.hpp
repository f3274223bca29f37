#pragma once
// ISO 230-2 over eight simulated sessions at once: the inner loop of the Monte Carlo evaluation.
// Pure. Lanes stay apart and each is summed in a fixed order: same bits with every LaneCode.

#include "analysis/uncertainty/random_lanes.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace axiscal {

/// In the order of uncertain_parameters().
inline constexpr std::size_t figure_count = 12;
/// [figure][lane]
using Figures = std::array<std::array<double, lanes>, figure_count>;

/// A session as measured, and how its readings may be wrong. Rows: the forward targets, then the
/// backward ones (for a test from one side, the forward ones again).
struct SessionModel {
    std::size_t targets = 0, approaches = 0;
    double cover_factor = 2;
    std::vector<double> residual; ///< reading - mean of its row, row after row
    std::vector<double> mean;     ///< of each row
    std::vector<double> shape;    ///< per target: share of an error that grows over the length
    double environment = 0;       ///< factor of a reading's own draw
    [[nodiscard]] std::size_t readings() const { return residual.size(); }
};

/// Room for one group of eight sessions, used again for the next.
struct SessionScratch {
    explicit SessionScratch(const SessionModel& model);
    std::vector<double> mean, spread; ///< [row][lane]
};

/// Figures [figure][lane] of eight sessions: reading r of lane l is off by its own draw
/// draws[r * 8 + l] times model.environment, and by common[l] times the shape of its target. With
/// one approach the figures that need a spread are zero-spread ones, to be left aside.
void evaluate_sessions(const SessionModel& model,
                       const double* draws,
                       const std::array<double, lanes>& common,
                       SessionScratch& scratch,
                       Figures& figures,
                       LaneCode code);

} // namespace axiscal
