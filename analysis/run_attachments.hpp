#pragma once
// What a run file holds beside the measured readings: how the beam was aligned, what kind of test
// it is where it is no positioning run, where a figure of the budget came from. Pure data, beside
// RunRecord.

#include "analysis/alignment/alignment_record.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/time.hpp"

#include <optional>
#include <string>

namespace axiscal {

/// A drift test: every channel read at an interval while the axis rests. The readings stand in
/// RunRecord::environment, those of the laser in vacuum wavelengths.
struct DriftSetup {
    Duration duration{}, interval{};
    Length place; ///< coordinate at which the axis rests
};

struct RunAttachments {
    std::optional<AlignmentRecord> alignment; ///< of the beam, where it was watched
    std::optional<DriftSetup> drift;          ///< the run is a drift test: it has no points
    std::string
        eve_source; ///< id of the drift test that UncertaintySetup::eve comes from, or empty
};

} // namespace axiscal
