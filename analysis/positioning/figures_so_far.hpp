#pragma once
// What the points of a positioning run would give if it ended now, as they are shown at the
// machine. Neither a result nor a verdict: no certificate uses any of it. Pure.

#include "analysis/positioning/styles.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/record/run_record.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

// Of a rotary axis "mm" stands for degrees and "um" for 0.001 deg, as everywhere.

/// A durable point that counts: of its place in the plan the last one, and not left out.
struct ShownReading {
    PlannedPoint planned;
    Length deviation; ///< as shown at the machine
};

/// The points of one target that were reached in one direction.
struct SideSoFar {
    int points = 0;
    std::optional<double> mean_um;         ///< of one point or more
    std::optional<double> low_um, high_um; ///< mean - 2 s and mean + 2 s, of two points or more
};
struct TargetSoFar {
    double nominal_mm = 0;
    SideSoFar positive, negative;
};

enum class Standing : std::uint8_t { inside, outside, not_judged };
std::string_view name_of(Standing standing); ///< "inside" | "outside" | "not judged"

/// A figure beside the limit that was agreed on. The bare numbers: no U, no decision rule.
struct LimitSoFar {
    std::string parameter;
    std::optional<double> limit_um; ///< empty: no band of the limits holds the travel
    std::optional<double> value_um;
    Standing standing = Standing::not_judged;
    std::string sentence; ///< "A 14.2 of 12.0 um so far", in the unit of the limits
};

struct FiguresSoFar {
    std::vector<TargetSoFar> targets;         ///< every one of the plan, in its order
    int points_per_target = 0;                ///< fewest, of any target and direction of the plan
    std::optional<double> deviation_range_um; ///< largest - smallest deviation of any point
    std::optional<double> reversal_max_um;    ///< of targets with points in both directions
    std::string standard;                     ///< of `figures`
    /// Of ISO 230-2 and what other standards the run names, um. Empty until each target has two
    /// points in each direction of the plan, or the one that was planned.
    NamedFigures figures;
    std::vector<LimitSoFar> limits;           ///< none: none was agreed on
    Standing standing = Standing::not_judged; ///< inside only where every figure is
    std::string sentence;
    std::string basis; ///< what the deviations are, and what they lack
};

/// @param header    a positioning run's, linear or rotary; its plan, limits, standards and how it
///                  was measured are read
/// @param readings  at most one for each point of the plan
FiguresSoFar figures_so_far(const RunRecord& header, const std::vector<ShownReading>& readings);

} // namespace axiscal
