#pragma once
// Straightness of the motion of a linear axis from repeated runs in one or both directions (ISO
// 230-1). Pure.

#include "analysis/geometry/straightness.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace axiscal {

/// What a captured run gave: m targets along the axis, at each the deviations across it of every
/// approach. Positive towards the + direction of the measured axis. `backward_um` empty: one
/// direction.
struct StraightnessReadings {
    std::vector<double> targets_mm;                           ///< m, rising
    std::vector<std::vector<double>> forward_um, backward_um; ///< m rows of n
};

/// The line against which a straightness is given.
enum class LineReference : std::uint8_t { end_points, least_squares, minimum_zone };
std::string_view name_of(LineReference reference); ///< "end_points" ...

/// A mean line and what it is against each reference; positions and deviations in um.
struct StraightnessLine {
    MeasuredLine line;
    Straightness against;
    /// Straightness error in um: largest minus smallest residual.
    [[nodiscard]] double straightness_um(LineReference reference) const;
};

struct StraightnessRow {
    double target_mm = 0;
    double mean_forward_um = 0;
    std::optional<double> mean_backward_um, mean_um;   ///< of both directions
    std::optional<double> reversal_um;                 ///< B_i: forward mean minus backward mean
    std::optional<double> s_forward_um, s_backward_um; ///< n >= 2
};

struct StraightnessFigures {
    int approaches = 0; ///< n, the fewest of a target and direction
    int runs = 1;       ///< that the means are of: 2 where the mirror stood in both positions
    std::vector<StraightnessRow> rows;
    StraightnessLine forward;
    std::optional<StraightnessLine> backward;
    StraightnessLine mean; ///< of both directions; of one-way readings the forward line
    std::optional<double> reversal_um, mean_reversal_um; ///< largest |B_i| and the mean of B_i
    /// Largest of 4 s_i and of |B_i| with both s_i, by the formula of ISO 230-2 for R. ISO 230-1
    /// names no such figure.
    std::optional<double> repeatability_um;
    std::optional<double> pooled_s_um; ///< root mean square of all s_i, weighted by n - 1
    /// Readings in each mean of one direction: n of each run.
    [[nodiscard]] int readings_of_direction() const { return runs * approaches; }
    /// Readings in each mean of `mean`: these, or twice as many where both directions count.
    [[nodiscard]] int readings_a_mean() const;
};

/// Means of the readings by target and direction, then the three references of each mean line; the
/// bidirectional mean is the main figure. A constant and a slope of all readings change no
/// straightness. ISO 230-1:2012, 3.4 (straightness deviation, reference straight line, straightness
/// error). Accuracy: rounding of the means, a few 1e-16 of the largest reading; positions count as
/// um, so the minimum zone is perpendicular to its line.
/// @param rows  whether every row has the same number of readings
/// @errors Fault::bad_case naming "targets", "forward[2][1]" and the like for other counts, NaN,
/// infinities; "targets" for fewer than two positions or such that do not rise.
Result<StraightnessFigures> evaluate_straightness(const StraightnessReadings& readings,
                                                  RowLengths rows = RowLengths::equal);

/// The lines `forward`, `backward` and `mean` of the means that stand in `figures.rows`.
/// @errors those of straightness_of().
Result<void> draw_lines(StraightnessFigures& figures);

} // namespace axiscal
