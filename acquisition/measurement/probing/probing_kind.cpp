// A station opens no probing test: a file of one that lies there is held against the axis.
#include "acquisition/measurement/measurement_kind.hpp"

#include "acquisition/measurement/positioning/take_over_positioning.hpp"

namespace axiscal {

extern constinit const MeasurementKind probing_kind{
    .take_over = take_over_positioning,
    .take_over_closed = take_over_closed_positioning,
};

} // namespace axiscal
