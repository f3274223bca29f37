#pragma once
// Where the axis stands now, for near checks and screens. Never for a certificate: no dead path, no
// cosine, temperatures of this moment. Pure.

#include "analysis/record/run_record.hpp"

namespace axiscal {

/// datum.coordinate + sign (reading - datum.reading) / (1 + scale_minus_1), at 20 degC with
/// EnvironmentNow's scale. `reading` in vacuum wavelengths, sign as counted. Error against the
/// compensated position: less than 1 ppm of the distance from the datum in steady air.
Length live_position(const LaserSetup& laser,
                     const DatumRecord& datum,
                     Length reading,
                     double scale_minus_1);

} // namespace axiscal
