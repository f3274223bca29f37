// Least squares periodogram of the residual over the position of one axis. For each frequency nu
// the two columns w cos(2 pi nu R w), w sin(2 pi nu R w), w the axis' direction cosine, are fitted;
// what they take from the sum of squares, over the variance that is left, has the chi-square
// distribution with two degrees of freedom where there is noise alone.

#include "analysis/circular/residual_features.hpp"

#include "analysis/linear/length.hpp"

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

/// Phasors that start at `first` and turn by `turn`, times what `place` makes of a point, and weigh
/// what `weight` does. Every k-th reading, so that the search stays short: 5000 a trace resolve 400
/// periods.
template <class Place, class Weight>
std::vector<Phasor> phasors_of(const std::vector<ResidualTrace>& traces,
                               double first,
                               double turn,
                               Place place,
                               Weight weight) {
    std::vector<Phasor> points;
    for (const ResidualTrace& seen : traces) {
        const std::size_t stride = 1 + seen.residual_mm.size() / 5000;
        for (std::size_t i = 0; i < seen.residual_mm.size(); i += stride) {
            const SeenPoint& point = seen.trace->points[i];
            const double at = place(point);
            points.push_back({weight(point), seen.residual_mm[i], std::cos(first * at),
                              std::sin(first * at), std::cos(turn * at), std::sin(turn * at)});
        }
    }
    return points;
}

struct Search {
    Peak best;
    std::size_t step = 0; ///< of the best
    double total = 0;     ///< sum of squares before
    bool significant = false;
};

Search search(std::vector<Phasor>& points, std::size_t count, const ResidualScale& scale) {
    Search out;
    for (const Phasor& p : points)
        out.total += p.residual * p.residual;
    const double freedom = static_cast<double>(points.size()) - 2 - linear_unknowns;
    if (freedom < 20 || std::sqrt(out.total / freedom) < scale.negligible_mm) return out;
    for (std::size_t k = 0; k < count; ++k) {
        if (const Peak peak = fit_at(points); peak.taken > out.best.taken) {
            out.best = peak;
            out.step = k;
        }
        for (Phasor& p : points)
            p.turn();
    }
    const double left =
        std::max(out.total - out.best.taken, std::numeric_limits<double>::min()) / freedom;
    const double chance = 2 * static_cast<double>(count) * std::exp(-out.best.taken / left / 2);
    out.significant = chance < false_alarm && out.best.taken >= least_share * out.total;
    return out;
}

constexpr std::size_t fewest_lobes = 4; ///< below, the linear causes hold them

/// Harmonics of the angle itself.
Search search_lobes(const std::vector<ResidualTrace>& traces, const ResidualScale& scale) {
    const double step = std::max(longest_step(traces), 1e-6);
    const double most = std::min(400.0, std::numbers::pi / (2 * step)); // four readings a lobe
    if (most < static_cast<double>(fewest_lobes)) return {};
    std::vector<Phasor> points = phasors_of(
        traces, static_cast<double>(fewest_lobes), 1,
        [](const SeenPoint& point) { return point.angle_rad; },
        [](const SeenPoint&) { return 1.0; });
    return search(points, static_cast<std::size_t>(most) - fewest_lobes + 1, scale);
}

} // namespace

std::optional<CyclicError> search_cyclic(const std::vector<ResidualTrace>& traces,
                                         int axis,
                                         double nominal_radius_mm,
                                         const ResidualScale& scale) {
    const double radius = nominal_radius_mm;
    const double shortest_pitch = std::max(
        4 * longest_step(traces) * radius * std::numbers::sqrt2 / 2, 2 * radius / most_periods);
    const double first = fewest_periods / (2 * radius), last = 1 / shortest_pitch;
    if (!(last > first)) return {};
    const double step = 1 / (2 * radius * oversampling);
    const auto count = static_cast<std::size_t>((last - first) / step) + 1;
    const auto along = [axis](const SeenPoint& point) {
        return axis == 0 ? point.aspect.cosine : point.aspect.sine;
    };
    constexpr double turn = 2 * std::numbers::pi;
    std::vector<Phasor> points =
        phasors_of(traces, turn * first * radius, turn * step * radius, along, along);
    const Search seen = search(points, count, scale);
    // lobes that are even in angle, not in the axis' travel, are no error of the axis
    if (!seen.significant || search_lobes(traces, scale).best.taken >= seen.best.taken) return {};
    const double frequency = first + static_cast<double>(seen.step) * step;
    CyclicError found;
    found.axis = axis;
    found.pitch_mm = 1 / frequency;
    found.amplitude_mm = length_in_plane(seen.best.cosine, seen.best.sine);
    found.phase_rad = std::atan2(-seen.best.sine, seen.best.cosine);
    return found;
}

std::optional<Lobes> find_lobes(const std::vector<ResidualTrace>& traces,
                                const ResidualScale& scale) {
    const Search seen = search_lobes(traces, scale);
    if (!seen.significant) return {};
    return Lobes{static_cast<int>(seen.step + fewest_lobes),
                 length_in_plane(seen.best.cosine, seen.best.sine)};
}

} // namespace axiscal::circular
