#pragma once
// One pass of a job: where its targets come from and the rules they must keep (ISO 230-2:2014,
// 4.3). Pure. Used by cycle_plan alone.

#include "acquisition/run/target_positions.hpp"
#include "config/station_config.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

inline constexpr Length long_axis = 2000.0_mm, long_interval = 250.0_mm;
/// 1 mm stands for 1 degree.
inline constexpr Length full_turn = 360.0_mm, turn_interval = 45.0_mm;
/// Travel is written in decimals: a nanometre of binary rounding is no target outside.
inline constexpr Length rounding = 1.0_nm;

/// The configuration as it applies to this pass, and where its targets may lie.
struct Pass {
    CycleConfig config;
    std::string name = "whole", remark;
    Length begin, end; ///< of the stretch that is measured
    std::uint64_t seed = 0;
};

struct PassTargets {
    std::vector<Length> positions;
    Length interval;
    std::optional<std::uint64_t> seed;
};

/// Fewest targets by analysis/positioning/target_rule.hpp; longer axes are ruled by their mean
/// interval (250 mm, 45 degrees): 2.
int least_targets(AxisKind kind, Length travel);

/// Beyond 2000 mm, or beyond one turn between the overruns of a rotary axis, one approach each way
/// is what the standard asks for.
bool is_long_travel(const CycleConfig& config, Length travel);

/// "12.5 mm" | "12.5 degree".
std::string in_unit(const CycleConfig& config, Length length);
tl::unexpected<Error> refuse_plan(std::string field, std::string reason);
Length whole_steps_below(Length length);

/// Between these every target must lie: in the measured stretch and an overrun inside the travel.
Length lowest(const Pass& pass);
Length highest(const Pass& pass);

/// The list, or P_i = (i-1) p + r; in range, spaced for the overrun, enough for the standard.
/// @errors Fault::bad_configuration
Result<PassTargets> targets_of(const Pass& pass);

} // namespace axiscal
