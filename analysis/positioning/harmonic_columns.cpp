#include "analysis/positioning/harmonic_columns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal {
namespace {

constexpr double steps_of_a_line_width = 10;
/// About two seconds of search.
constexpr double most_steps = 5e8;

/// Running cos and sin of each point's phase, turned by one grid step at a time.
class Phases {
public:
    Phases(const std::vector<double>& steps, double first, double grid) {
        const double turn = 2 * std::numbers::pi;
        for (const double x : steps) {
            cosine_.push_back(std::cos(turn * first * x));
            sine_.push_back(std::sin(turn * first * x));
            turn_cosine_.push_back(std::cos(turn * grid * x));
            turn_sine_.push_back(std::sin(turn * grid * x));
        }
    }
    void advance() {
        for (std::size_t i = 0; i < cosine_.size(); ++i) {
            const double c = cosine_[i], s = sine_[i];
            cosine_[i] = c * turn_cosine_[i] - s * turn_sine_[i];
            sine_[i] = s * turn_cosine_[i] + c * turn_sine_[i];
        }
    }
    [[nodiscard]] const std::vector<double>& cosine() const { return cosine_; }
    [[nodiscard]] const std::vector<double>& sine() const { return sine_; }

private:
    std::vector<double> cosine_, sine_, turn_cosine_, turn_sine_;
};

double product(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// An orthonormal pair that spans the constant and the slope, and what they leave of the
/// deviations.
struct WithoutLine {
    std::vector<double> constant, slope, rest;
    double squares = 0; ///< of the rest
};

WithoutLine without_line(const CentredPoints& points) {
    const double count = static_cast<double>(points.steps.size());
    WithoutLine line;
    line.constant.assign(points.steps.size(), 1 / std::sqrt(count));
    line.slope = points.steps;
    const double mean = product(line.constant, line.slope);
    for (std::size_t i = 0; i < line.slope.size(); ++i)
        line.slope[i] -= mean * line.constant[i];
    const double length = std::sqrt(product(line.slope, line.slope));
    for (double& value : line.slope)
        value /= length;
    line.rest = fit_columns({line.constant, line.slope}, *points.deviations).residuals;
    line.squares = product(line.rest, line.rest);
    return line;
}

/// Squares that one wave takes from the rest, the wave made free of constant and slope.
double squares_taken(const WithoutLine& line, const Phases& phases) {
    const auto& c = phases.cosine();
    const auto& s = phases.sine();
    const double c0 = product(line.constant, c), c1 = product(line.slope, c);
    const double s0 = product(line.constant, s), s1 = product(line.slope, s);
    const double cc = product(c, c) - c0 * c0 - c1 * c1;
    const double ss = product(s, s) - s0 * s0 - s1 * s1;
    const double cs = product(c, s) - c0 * s0 - c1 * s1;
    const double yc = product(line.rest, c), ys = product(line.rest, s);
    const double determinant = cc * ss - cs * cs;
    if (determinant <= 1e-10 * cc * ss) return 0;
    return (yc * yc * ss - 2 * yc * ys * cs + ys * ys * cc) / determinant;
}

Result<PitchRange> range_of(const CentredPoints& points, const PeriodicQuestion& question) {
    const double least = least_points_of_a_wave * question.harmonics * points.mean_step();
    const auto range = question.pitch_range.value_or(PitchRange{least, points.span() / 2});
    if (!(range.low < range.high) || range.low <= 0)
        return refuse(Fault::bad_case, question.pitch_range ? "pitch_range" : "positions",
                      question.pitch_range
                          ? "must rise from a pitch greater than 0"
                          : "are too few to search a pitch of two periods and four points a wave");
    if (range.low < least * (1 - 1e-9))
        return refuse(Fault::bad_case, "pitch_range",
                      "begins where a wave of the highest harmonic has fewer than 4 points");
    if (range.high > points.span() * (1 + 1e-9))
        return refuse(Fault::bad_case, "pitch_range", "ends beyond the length that was measured");
    return range;
}

/// Gamma(n/2) / Gamma((n-1)/2), n >= 2, from Gamma(1) / Gamma(1/2) on.
double gamma_ratio(double n) {
    double ratio = std::numbers::inv_sqrtpi;
    for (double k = 2; k < n; ++k)
        ratio = (k - 1) / 2 / ratio;
    return ratio;
}

/// That white noise leaves a peak of this share anywhere in the range. Baluev, "Assessing the
/// statistical significance of periodogram peaks", MNRAS 385 (2008) 1279, formulas 6 and 9 and its
/// table 1 (variance unknown), with a line in place of the constant as what is always fitted.
/// Independent frequencies counted as span times bandwidth give two to four times too little.
double false_alarm(const CentredPoints& points, double share, PitchRange range) {
    const double count = static_cast<double>(points.steps.size());
    const double without_wave = count - 2, with_wave = count - 4; // degrees of freedom
    double mean = 0, square = 0;
    for (const double x : points.steps) {
        mean += x / count;
        square += x * x / count;
    }
    const double band =
        (1 / range.low - 1 / range.high) * std::sqrt(4 * std::numbers::pi * (square - mean * mean));
    const double gamma = std::sqrt(2 / without_wave) * gamma_ratio(without_wave);
    const double left = std::max(0.0, 1 - share);
    const double at_one_frequency = std::pow(left, with_wave / 2);
    const double peaks =
        gamma * band * std::pow(left, (with_wave - 1) / 2) * std::sqrt(without_wave * share / 2);
    return at_one_frequency < 1 ? -std::expm1(std::log1p(-at_one_frequency) - peaks) : 1;
}

double squares_of(const std::vector<double>& residuals) {
    return product(residuals, residuals);
}

} // namespace

std::vector<std::vector<double>>
harmonic_columns(const CentredPoints& points, double frequency, int harmonics) {
    std::vector<std::vector<double>> columns(2 + 2 * static_cast<std::size_t>(harmonics));
    for (const double x : points.steps) {
        columns[0].push_back(1);
        columns[1].push_back(x / points.half_span);
        for (int h = 1; h <= harmonics; ++h) {
            const double phase = 2 * std::numbers::pi * h * (frequency * x);
            const std::size_t k = 2 * static_cast<std::size_t>(h);
            columns[k].push_back(std::cos(phase));
            columns[k + 1].push_back(std::sin(phase));
        }
    }
    return columns;
}

Result<Peak> search_pitch(const CentredPoints& points, const PeriodicQuestion& question) {
    AXISCAL_TRY(const PitchRange range, range_of(points, question));
    const double lowest = 1 / range.high, highest = 1 / range.low;
    const double grid = 1 / (steps_of_a_line_width * points.span());
    const double steps = std::ceil((highest - lowest) / grid);
    if (steps * static_cast<double>(points.steps.size()) > most_steps)
        return refuse(Fault::bad_case, "pitch_range",
                      "leaves too long a search: narrow it, or state the pitch");
    const WithoutLine line = without_line(points);
    if (line.squares <= 1e-28 * squares_of(*points.deviations))
        return refuse(Fault::bad_case, "deviations", "are a straight line: no period to be found");
    Phases phases{points.steps, lowest, grid};
    Peak peak{lowest, range};
    double most = 0;
    const auto last = static_cast<std::size_t>(steps);
    for (std::size_t k = 0; k <= last; ++k, phases.advance()) {
        const double taken = squares_taken(line, phases);
        if (taken <= most) continue;
        most = taken;
        peak.frequency = std::min(lowest + static_cast<double>(k) * grid, highest);
    }
    return peak;
}

PitchSearch weigh_peak(const CentredPoints& points, double frequency, PitchRange range) {
    // The fit of all harmonics may settle a little outside; the chance is that of the range.
    const double inside = std::clamp(frequency, 1 / range.high, 1 / range.low);
    const auto columns = harmonic_columns(points, inside, 1);
    const double line =
        squares_of(fit_columns({columns[0], columns[1]}, *points.deviations).residuals);
    const double wave = squares_of(fit_columns(columns, *points.deviations).residuals);
    const double share = std::clamp(1 - wave / line, 0.0, 1.0);
    return {range, share, false_alarm(points, share, range)};
}

} // namespace axiscal
