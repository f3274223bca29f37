#pragma once
// Pure.

#include "scenario.hpp"

#include <cmath>

namespace axiscal::simulate {

/// Least count of the laser, um of its displacement.
inline double count_um(const LaserScenario& laser) {
    if (laser.kind == "ids3010") return 1e-6; // it tells picometres
    if (laser.kind == "hpi-3d") return 1e-4;  // steps of 100 pm
    if (laser.resolution_um) return *laser.resolution_um;
    const double count = laser.wavelength_nm * 1e-3 / (laser.fold * laser.counts_per_cycle);
    const bool heterodyne = laser.kind == "umd1" || laser.kind == "umd2-heterodyne";
    return heterodyne ? count / std::pow(2.0, laser.phase_bits) : count;
}

} // namespace axiscal::simulate
