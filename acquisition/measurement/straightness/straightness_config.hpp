#pragma once
// The table [straightness] of the station file: with which optics the straightness of the axis is
// measured, and at which targets.

#include "analysis/quantity/quantity.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/straightness_setup.hpp"
#include "config/section_readers.hpp"
#include "config/station_config.hpp"

#include <any>
#include <string>

namespace axiscal {

/// Deviation that common optics of the short range follow, to either side.
inline constexpr Length usual_range_across = mm(2.5);

struct StraightnessConfig {
    /// Without what only arming knows: a mirror that was turned since, what the laser tells of its
    /// resolution, E_VE of a drift test.
    StraightnessSetup setup;
    RunPlan plan;
    Speed feed;
    Duration dwell{};
    Length range = usual_range_across; ///< deviation that the optics follow, to either side
    /// Drift test that E_VE comes from: its run id, or "latest"; empty: setup.uncertainty.eve
    /// counts.
    std::string eve_run;
    /// Run with the mirror in the other position: its id, or "latest"; empty: none.
    std::string reversal_of;
    InstrumentRecord optics; ///< prism and mirror, and their certificate
};

/// Null: the station file has no such table.
inline const StraightnessConfig* straightness_config_of(const StationConfig& station) {
    return config_of<StraightnessConfig>(TestKind::straightness, station);
}

/// The plan of the table under the pass of a run of this kind: a squareness run is driven alike.
RunPlan plan_of_kind(const StraightnessConfig& config, TestKind kind);

/// As MeasurementKind::read. What the table leaves out [cycle] and [axis] say.
/// @returns nothing where no straightness can be measured by this station, or not live
std::any read_straightness_section(Settings section, const StationConfig& station);

/// What a Wollaston prism that parts its beams by `parting` makes of a displacement of 1 that the
/// laser shows: 1 / (2 sin(parting / 2)).
double factor_of_prism(Angle parting);

} // namespace axiscal
