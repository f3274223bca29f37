#pragma once
// How much of a reading is doubtful because the time of its samples is: the speed at that moment
// times the uncertainty of the time. Pure.

#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Of one accepted capture.
struct Synchronisation {
    Duration time_uncertainty{}; ///< u(t), standard: the largest of the window's samples; > 0
    /// |slope of the window| * u(t), >= 0, of the reading; synchronisation_unit_of() tells it.
    double error_um = 0;
};

/// @param uncertainty u(t); empty or 0 where the instrument's clock tells none: then nothing is
///        stated, for 0 would claim that the time is known exactly.
std::optional<Synchronisation> synchronisation_of(double slope_um_per_s,
                                                  std::optional<Duration> uncertainty);

/// In what an error of this run is told: {"um", 1}, or {"arcsec", 3.6} where an autocollimator
/// reads a polygon: of its reading a millimetre stands for a degree.
struct SynchronisationUnit {
    std::string_view name;
    double per_um = 1; ///< times Synchronisation::error_um
};
SynchronisationUnit synchronisation_unit_of(const RunRecord& run);

/// As the run file keeps it, beside the point or the datum.
struct SynchronisationRecord {
    int step = -1;                         ///< PointRecord::step; -1: the tying of the datum itself
    std::string datum_id;                  ///< DatumRecord::id; of a point the one it refers to
    std::optional<Synchronisation> stated; ///< empty: not stated
};

/// Over the datums and the points that count.
struct SynchronisationSummary {
    int captures = 0, stated = 0;
    std::optional<SynchronisationRecord> largest; ///< by error; empty where none is stated
};
SynchronisationSummary summarize_synchronisation(const RunRecord& run,
                                                 const std::vector<SynchronisationRecord>& records);

/// The record of one point; nullptr where the file keeps none.
const SynchronisationRecord*
synchronisation_of_step(const std::vector<SynchronisationRecord>& records, int step);

} // namespace axiscal
