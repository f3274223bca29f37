#include "acquisition/run/live_position.hpp"

namespace axiscal {

Length live_position(const LaserSetup& laser,
                     const DatumRecord& datum,
                     Length reading,
                     double scale_minus_1) {
    const auto travelled = (reading - datum.reading) / (1.0 + scale_minus_1);
    return datum.coordinate + travelled * laser.sign;
}

} // namespace axiscal
