#pragma once
// The table [squareness] of the station file: through which optical square the second of two axes
// is measured, and with which earlier runs. Prism, mirror and plan stand in [straightness].

#include "analysis/record/run_record.hpp"
#include "analysis/record/squareness_setup.hpp"
#include "config/section_readers.hpp"
#include "config/station_config.hpp"

#include <any>
#include <string>

namespace axiscal {

struct SquarenessConfig {
    SquarePosition square = SquarePosition::normal;
    SquareStatement stated;
    /// The straightness run of the other axis: its run id, or "latest".
    std::string first = "latest";
    /// The squareness run of this axis with the square in the other position: its run id, or
    /// "latest"; empty: the square's error is not parted.
    std::string reversal_of;
    InstrumentRecord artefact; ///< the optical square, and its certificate
};

/// Null: the station file has no such table.
inline const SquarenessConfig* squareness_config_of(const StationConfig& station) {
    return config_of<SquarenessConfig>(TestKind::squareness, station);
}

/// As MeasurementKind::read, behind [straightness], whose reader comes first (TestKind's order).
/// @returns nothing where this station measures no straightness
std::any read_squareness_section(Settings section, const StationConfig& station);

} // namespace axiscal
