#pragma once
// Monte Carlo trials (GUM supplement 1) of one circular test. Pure: the seed makes the draws.

#include "analysis/circular/circular_parameters.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace axiscal::circular {

/// Standard uncertainties and full widths of what is drawn, in millimetres and kelvins.
struct Disturbances {
    double device_width_mm = 0, calibration_u_mm = 0, repeatability_mm = 0, eve_mm = 0;
    double centre_width_mm = 0;
    double machine_temperature_width_K = 0, bar_temperature_width_K = 0;
    double machine_alpha_width_per_K = 0, bar_alpha_width_per_K = 0;
    int runs = 1;
};

/// Standard deviation of each figure over the trials, by its contract key.
/// @errors those of evaluate_circular
Result<std::map<std::string, double>> try_circular(const CircularTest& test,
                                                   RadialCentre f_centre,
                                                   const std::optional<BarExpansion>& bar,
                                                   const Disturbances& disturbances,
                                                   int trials,
                                                   std::uint64_t seed);

/// Every figure by its contract key: "G_ccw" ... "D", as far as it was evaluated.
std::map<std::string, double> figures_by_key(const CircularParameters& parameters);

} // namespace axiscal::circular
