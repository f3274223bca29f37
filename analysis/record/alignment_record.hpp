#pragma once
// What aligning the laser beam showed along the travel, as recorded. Pure data.

#include "analysis/quantity/quantity.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Strength of the signal over one stretch of the travel.
struct AlignmentPlace {
    Length begin, end; ///< distance from the reading nearest to the interferometer
    int readings = 0;  ///< good ones for which the instrument told a strength
    double weakest_percent = 0, mean_percent = 0, last_percent = 0;
};

/// The latest rest of the axis at its far end, while the beam was steered there. Readings are
/// means over blocks of 0.2 s, as read: vacuum wavelengths, rising away from the interferometer.
struct FarRest {
    Length distance;      ///< of the highest reading from the nearest one
    Length highest, last; ///< readings: the highest one is kept, the last one stands
    Length scatter;       ///< largest difference of two readings in the block of either
    int blocks = 0;
    /// The readings rose to the highest and fell again, each by more than twice the scatter: the
    /// beam was steered through the best alignment and beyond.
    bool passed_maximum = false;
};

/// An alignment from its begin to its end; its last state is what a run is measured with.
struct AlignmentRecord {
    std::int64_t began_utc_ns = 0, ended_utc_ns = 0;
    std::string instrument, serial; ///< of the laser
    Length travel;                  ///< of the axis, as the station file states it
    Length reached;                 ///< farthest reading from the nearest one
    int readings = 0;               ///< good ones
    int lost = 0;                   ///< readings without a good signal
    int restarts = 0; ///< how often the counter lost its zero: what was seen before was given up
    std::optional<FarRest> far;         ///< none: the axis did not stand far away
    std::optional<Length> spot_offset;  ///< typed: walk of the return spot over `reached`
    std::vector<AlignmentPlace> places; ///< near to far; empty where the strength is not told
};

} // namespace axiscal
