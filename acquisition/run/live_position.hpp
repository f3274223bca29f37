#pragma once
// Where the axis stands now, for near checks and screens. Never for a certificate: no dead path, no
// cosine, no material temperature. Pure.

#include "analysis/run_record.hpp"

namespace axiscal {

/// datum.coordinate + sign (reading - datum.reading) / n. `reading` in vacuum wavelengths, sign as
/// counted. Error against the compensated position: some ppm of the distance from the datum.
Length live_position(const LaserSetup& laser,
                     const DatumRecord& datum,
                     Length reading,
                     double refractive_index_minus_1);

} // namespace axiscal
