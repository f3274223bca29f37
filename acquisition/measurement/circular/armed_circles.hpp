#pragma once
// What a circular test begins with: its order held against the station, and the header of its file.
// Reads the numbers of certificates, and what is stored for the run's id; no more I/O than that.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct ArmedCircles {
    RunRecord header;
    CircularSetup setup;
    std::string eve_source; ///< id of the drift test that setup.uncertainty.eve_um is of; or empty
    std::vector<PreflightRecord> checks; ///< as they were judged
};

/// For a station with the tables [ballbar] and [circular].
/// @param parts    of TestKind::circular
/// @param rate_hz  readings of the ballbar a second; 0: not known yet
/// @param eve      of the drift test that the station file points to, if it does
/// @returns the test with no checks
/// @errors those of make_run_header; Fault::refused for the number of another run's certificate.
Result<ArmedCircles> armed_circles(const RunHeaderParts& parts,
                                   const ArmRequest& request,
                                   double rate_hz,
                                   const std::optional<FoundEve>& eve);

} // namespace axiscal
