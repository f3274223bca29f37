#pragma once
// How many targets a test needs and how they must lie (ISO 230-2:2014, 4.3). Pure.
//
// Lengths are mm of a linear axis, degrees of a rotary one.

#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Up to these travels every target is approached n = 5 times; a longer axis once a direction.
inline constexpr double short_linear_travel = 2000, short_rotary_travel = 360;
/// Largest mean interval of a longer axis; of a rotary axis at any travel.
inline constexpr double long_linear_interval = 250, rotary_interval = 45;
/// P_i = (i - 1) p + r with r within this share of p.
inline constexpr double random_part_of_interval = 0.3;

/// What the clause asks for at a travel.
struct TargetRule {
    bool long_axis = false;
    /// Linear up to 2000 mm: max(5, ceil(5 L / 1000)); rotary: 3 up to 90, 5 up to 180, 8 up to 360
    /// degrees. Longer axes: 2, ruled by the mean interval.
    int least_targets = 2;
    std::optional<double> largest_mean_interval;
    int approaches = 5; ///< 1 on a long axis
};
/// A travel within 1e-6 above a limit still belongs to it: it is written in decimals.
TargetRule target_rule_for(AxisKind kind, double travel);

/// Evenest grid behind the targets: interval p and the share max|r| / p, the smallest that any grid
/// (begin, p) gives. A stated p leaves only the begin open.
struct TargetGrid {
    double interval = 0;
    double random_share = 0; ///< exact to 1e-12 of it for a stated p, to 1e-9 for a found one
};
/// Needs two ascending targets or more; two have share 0 of their own distance.
TargetGrid grid_of(const std::vector<double>& ascending, std::optional<double> stated_interval);

struct TargetQuestion {
    AxisKind kind = AxisKind::linear;
    std::vector<double> targets;    ///< in any order, none twice
    std::optional<double> travel;   ///< absent: from the lowest to the highest target
    std::optional<double> interval; ///< p, where it is known
    int approaches = 5;             ///< n
};

struct TargetFinding {
    TargetRule rule;
    double travel = 0,
           mean_interval = 0;          ///< mean interval: (highest - lowest) / (m - 1); 0 if m = 1
    std::optional<TargetGrid> grid;    ///< 3 <= m <= 100000
    std::vector<std::string> breaches; ///< against the clause
    std::vector<std::string> remarks;  ///< what a reader should weigh
    [[nodiscard]] bool kept() const { return breaches.empty(); }
};

/// Counts, mean interval, random part; on a rotary axis up to 360 degrees also 0, 90, 180, 270 as
/// far as the targets reach over them.
/// @errors Fault::bad_case: field "travel" when the targets reach over it, "interval" when <= 0.
Result<TargetFinding> judge_targets(const TargetQuestion& question);

} // namespace axiscal
