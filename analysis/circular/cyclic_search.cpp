// Least squares periodogram of the residual over the position of one axis. For each frequency nu
// the two columns w cos(2 pi nu R w), w sin(2 pi nu R w), w the axis' direction cosine, are fitted;
// what they take from the sum of squares, over the variance that is left, has the chi-square
// distribution with two degrees of freedom where there is noise alone.

#include "analysis/circular/residual_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axiscal::circular {
namespace {

constexpr double oversampling = 6;     ///< steps per 1 / (2 R): refinement starts near enough
constexpr double fewest_periods = 3;   ///< over 2 R; below, the linear causes look alike
constexpr double most_periods = 400;   ///< over 2 R
constexpr double false_alarm = 1e-4;   ///< chance of the whole search
constexpr double least_share = 0.1;    ///< of the residual's sum of squares
constexpr double linear_unknowns = 16; ///< taken from the degrees of freedom

/// A point of the residual and its phasor, turned on from frequency to frequency.
struct Phasor {
    double weight = 0, residual = 0; ///< direction cosine; mm
    double real = 1, imaginary = 0;
    double turn_real = 1, turn_imaginary = 0;
    void turn() {
        const double next = real * turn_real - imaginary * turn_imaginary;
        imaginary = real * turn_imaginary + imaginary * turn_real;
        real = next;
    }
};

struct Peak {
    double taken = 0; ///< from the sum of squares
    double cosine = 0, sine = 0;
};

Peak fit_at(const std::vector<Phasor>& points) {
    double cc = 0, cs = 0, ss = 0, cr = 0, sr = 0;
    for (const Phasor& p : points) {
        const double c = p.weight * p.real, s = p.weight * p.imaginary;
        cc += c * c;
        cs += c * s;
        ss += s * s;
        cr += c * p.residual;
        sr += s * p.residual;
    }
    const double determinant = cc * ss - cs * cs;
    if (!(determinant > 1e-9 * cc * ss)) return {};
    const double a = (ss * cr - cs * sr) / determinant, b = (cc * sr - cs * cr) / determinant;
    return {a * cr + b * sr, a, b};
}

double longest_step(const std::vector<ResidualTrace>& traces) {
    double step = 0;
    for (const ResidualTrace& seen : traces)
        step = std::max(step, seen.trace->step_rad);
    return step;
}

/// Every k-th reading, so that the search stays short: 5000 a trace resolve 400 periods.
std::vector<Phasor> phasors_of(const std::vector<ResidualTrace>& traces,
                               int axis,
                               double first_frequency,
                               double frequency_step,
                               double R) {
    std::vector<Phasor> points;
    for (const ResidualTrace& seen : traces) {
        const std::size_t stride = 1 + seen.residual_mm.size() / 5000;
        for (std::size_t i = 0; i < seen.residual_mm.size(); i += stride) {
            const Aspect& at = seen.trace->points[i].aspect;
            const double w = axis == 0 ? at.cosine : at.sine;
            const double first = 2 * std::numbers::pi * first_frequency * R * w;
            const double turn = 2 * std::numbers::pi * frequency_step * R * w;
            points.push_back({w, seen.residual_mm[i], std::cos(first), std::sin(first),
                              std::cos(turn), std::sin(turn)});
        }
    }
    return points;
}

} // namespace

std::optional<CyclicError> search_cyclic(const std::vector<ResidualTrace>& traces,
                                         int axis,
                                         double nominal_radius_mm,
                                         const ResidualScale& scale) {
    const double R = nominal_radius_mm;
    const double shortest_pitch =
        std::max(4 * longest_step(traces) * R * std::numbers::sqrt2 / 2, 2 * R / most_periods);
    const double first = fewest_periods / (2 * R), last = 1 / shortest_pitch;
    if (!(last > first)) return {};
    const double step = 1 / (2 * R * oversampling);
    const auto count = static_cast<std::size_t>((last - first) / step) + 1;
    std::vector<Phasor> points = phasors_of(traces, axis, first, step, R);
    double total = 0;
    for (const Phasor& p : points)
        total += p.residual * p.residual;
    const double freedom = static_cast<double>(points.size()) - 2 - linear_unknowns;
    if (freedom < 20 || std::sqrt(total / freedom) < scale.negligible_mm) return {};
    Peak best;
    double frequency = 0;
    for (std::size_t k = 0; k < count; ++k) {
        if (const Peak peak = fit_at(points); peak.taken > best.taken) {
            best = peak;
            frequency = first + static_cast<double>(k) * step;
        }
        for (Phasor& p : points)
            p.turn();
    }
    const double left = std::max(total - best.taken, std::numeric_limits<double>::min()) / freedom;
    const double chance = 2 * static_cast<double>(count) * std::exp(-best.taken / left / 2);
    if (!(chance < false_alarm) || best.taken < least_share * total) return {};
    CyclicError found;
    found.axis = axis;
    found.pitch_mm = 1 / frequency;
    found.amplitude_mm = std::hypot(best.cosine, best.sine);
    found.phase_rad = std::atan2(-best.sine, best.cosine);
    return found;
}

} // namespace axiscal::circular
