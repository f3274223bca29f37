#pragma once
// Periodic error of a feedback or a drive by harmonic fit (the idea of ISO 230-2:2014, annex C,
// from memory; the formulas are plain least squares). Pure.

#include "analysis/quantity/result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// At least this many points a period of the highest harmonic; fewer are refused.
inline constexpr double least_points_of_a_wave = 4;
/// Fewer points a period than this, or fewer periods than two, are told in the remarks.
inline constexpr double good_points_of_a_period = 20, good_periods = 2;

struct PitchRange {
    double low = 0, high = 0;
};

struct PeriodicQuestion {
    std::vector<double> positions, deviations; ///< equally many; positions in any order
    int harmonics = 2;                         ///< H, 1..50
    std::optional<double> pitch;               ///< p; absent: it is searched
    std::optional<PitchRange> pitch_range;     ///< of the search; default: see search_pitch
};

/// amplitude cos(2 pi order x / p - phase), x the coordinate itself.
struct Harmonic {
    int order = 1;
    double amplitude = 0, phase_rad = 0; ///< phase in (-pi, pi]
    [[nodiscard]] double peak_to_valley() const { return 2 * amplitude; }
};

struct PitchSearch {
    PitchRange range;
    /// Of the squares that the line leaves, by one wave at the found pitch.
    double explained_share = 0;
    /// That white noise alone shows such a peak anywhere in the range (Baluev, MNRAS 385 (2008)
    /// 1279): right within a fifth of itself, tried on 20 to 200 points.
    double false_alarm_probability = 1;
};

struct PeriodicError {
    double pitch = 0;
    double offset = 0, slope = 0; ///< a + b x
    std::vector<Harmonic> harmonics;
    double peak_to_valley = 0;              ///< of the sum of all harmonics over one period
    double residual_rms = 0;                ///< sqrt(sum r^2 / N)
    double residual_standard_deviation = 0; ///< sqrt(sum r^2 / (N - fitted)); 0 if none is free
    double points_per_period = 0, periods = 0;
    double condition = 1; ///< of the columns, see ColumnFit
    std::optional<PitchSearch> search;
    std::vector<std::string> remarks;
};

/// Least squares fit of a + b x + sum_h amplitude_h cos(2 pi h x / p - phase_h). An unknown p is
/// the highest peak of a Lomb-Scargle periodogram (one wave beside offset and slope), refined by
/// Gauss-Newton over all harmonics to rounding. A known p: amplitudes to 1e-15 times condition.
/// points_per_period counts distinct positions.
/// @errors Fault::bad_case: lengths, fewer points than unknowns, less than one period, too few
/// points a period, a pitch that the points do not separate (condition > 1e8), a straight line, a
/// search beyond 5e8 steps.
Result<PeriodicError> fit_periodic_error(const PeriodicQuestion& question);

} // namespace axiscal
