#pragma once
// What a run file holds beside the measured readings: how the beam was aligned, what kind of test
// it is where it is no positioning run, where a figure of the budget came from, what the uncertain
// time of the samples adds to each capture. Pure data, beside
// RunRecord.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/alignment_record.hpp"
#include "analysis/record/probing_record.hpp"
#include "analysis/record/synchronisation.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// A drift test: every channel read at an interval while the axis rests. The readings stand in
/// RunRecord::environment, those of the laser in vacuum wavelengths.
struct DriftSetup {
    Duration duration{}, interval{};
    Length place; ///< coordinate at which the axis rests; 0 for a ballbar, which has none
    /// Of the ballbar at rest: LaserSetup names its instrument and says nothing else.
    bool of_bar = false;
};

struct RunAttachments {
    std::optional<AlignmentRecord> alignment; ///< of the beam, where it was watched
    std::optional<DriftSetup> drift;          ///< the run is a drift test: it has no points
    std::optional<ProbingRecord> probing; ///< the run is a probing test: it has no points either
    /// Id of the drift test that UncertaintySetup::eve comes from, of a circular test
    /// CircularUncertaintyStatement::eve_um; or empty.
    std::string eve_source;
    std::vector<SynchronisationRecord> synchronisation; ///< of datums and points, as they came
};

} // namespace axiscal
