#pragma once
// The columns of the harmonic fit and the search of its pitch. For periodic_error.cpp alone.

#include "analysis/linear/dense_fit.hpp"
#include "analysis/positioning/periodic_error.hpp"

namespace axiscal {

/// Positions about their middle, u in [-1, 1]: what keeps the columns well apart.
struct CentredPoints {
    double middle = 0, half_span = 0;
    std::size_t distinct = 0;  ///< positions
    std::vector<double> steps; ///< x - middle
    const std::vector<double>* deviations = nullptr;
    [[nodiscard]] double span() const { return 2 * half_span; }
    [[nodiscard]] double mean_step() const {
        return span() / static_cast<double>(distinct - 1); // distinct >= 2
    }
};

/// Columns 1, u, then cos and sin of each harmonic of the frequency (1 / pitch) about the middle.
std::vector<std::vector<double>>
harmonic_columns(const CentredPoints& points, double frequency, int harmonics);

struct Peak {
    double frequency = 0;
    PitchRange range; ///< that was searched
};

/// Default range: from least_points_of_a_wave points a wave of the highest harmonic to half of the
/// span. Grid of ten steps for each 1/span.
Result<Peak> search_pitch(const CentredPoints& points, const PeriodicQuestion& question);

/// What one wave at the frequency explains, and how easily noise would.
PitchSearch weigh_peak(const CentredPoints& points, double frequency, PitchRange range);

} // namespace axiscal
