// Orthogonal least squares by Newton's steps with Levenberg's damping, from Taubin's algebraic
// circle (IEEE PAMI 13 (1991) 1115; Newton's form by N. Chernov, Circular and Linear Regression,
// 2010, section 5.10). With e and v of point_kernels.hpp, one step solves
//
//   (V + B) (x, y) = cov(v, e),   V = cov(v),   inward = mean e - mean v . (x, y)
//
// where the radius is eliminated, so that short arcs keep their digits. B, which makes it Newton's
// own step, is the mean of (e / d) (1 - u u^T).

#include "analysis/circle/circle_fit.hpp"
#include "analysis/circle/circle_start.hpp"
#include "analysis/circle/point_check.hpp"
#include "analysis/circle/seen_circle.hpp"
#include "analysis/linear/length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace axiscal {
namespace {

using namespace circle;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Covariance {
    double xx, xy, yy;
    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
};

Covariance directions_of(const Residuals& r) {
    return {r.vxx - r.vx * r.vx, r.vxy - r.vx * r.vy, r.vyy - r.vy * r.vy};
}

/// Newton's matrix, which takes in how the distances curve; where it allows no minimum, that of
/// Gauss and Newton.
Covariance matrix_of(const Residuals& r, double damping) {
    const Covariance v = directions_of(r);
    Covariance m{v.xx + r.bxx, v.xy + r.bxy, v.yy + r.byy};
    constexpr double safe = 0.1;
    if (!(m.xx > 0 && m.determinant() > safe * v.determinant())) m = v;
    m.xx *= 1 + damping;
    m.yy *= 1 + damping;
    return m;
}

CircleStep step_of(const Residuals& r, double damping) {
    const Covariance m = matrix_of(r, damping);
    const double ex = r.ex - r.e * r.vx, ey = r.ey - r.e * r.vy;
    const double determinant = m.determinant();
    CircleStep step;
    step.x = (ex * m.yy - ey * m.xy) / determinant;
    step.y = (ey * m.xx - ex * m.xy) / determinant;
    step.inward = r.e - r.vx * step.x - r.vy * step.y;
    return step;
}

using Symmetric = std::array<std::array<double, 3>, 3>;

/// Jacobi's rotations; absolute accuracy of a few roundings of the largest.
std::array<double, 3> eigenvalues_of(Symmetric m) {
    constexpr int most_sweeps = 30;
    constexpr std::array<std::array<std::size_t, 3>, 3> corners{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
        for (const auto& [p, q, other] : corners) {
            if (m[p][q] == 0) continue;
            const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
            const double t =
                std::copysign(1 / (std::fabs(theta) + std::sqrt(theta * theta + 1)), theta);
            const double cosine = 1 / std::sqrt(t * t + 1), sine = t * cosine;
            m[p][p] -= t * m[p][q];
            m[q][q] += t * m[p][q];
            m[p][q] = m[q][p] = 0;
            const double at_p = m[other][p], at_q = m[other][q];
            m[other][p] = m[p][other] = cosine * at_p - sine * at_q;
            m[other][q] = m[q][other] = sine * at_p + cosine * at_q;
        }
    std::array<double, 3> values{m[0][0], m[1][1], m[2][2]};
    std::ranges::sort(values);
    return values;
}

/// Of the normal matrix of u (unit vectors from the centre) and 1. Its smallest eigenvalue, where
/// it is small, comes from the determinant, which is that of cov(u) and keeps its digits.
double condition_of(const Residuals& r, const SeenCircle& circle) {
    const Covariance v = directions_of(r);
    const double x = r.vx - circle.a / circle.radius, y = r.vy - circle.b / circle.radius;
    const auto values = eigenvalues_of(
        {{{v.xx + x * x, v.xy + x * y, x}, {v.xy + x * y, v.yy + y * y, y}, {x, y, 1}}});
    constexpr double small = 1e-3;
    const double smallest =
        values[0] > small ? values[0] : v.determinant() / (values[1] * values[2]);
    constexpr double beyond_digits = 1 / (epsilon * epsilon);
    return smallest * beyond_digits > values[2] ? values[2] / smallest : beyond_digits;
}

struct Fit {
    SeenCircle circle;
    Residuals residuals;
};

/// By how much a step changes the distances, as root of the mean square.
double change_by(const CircleStep& step, const Residuals& r) {
    const Covariance v = directions_of(r);
    const double squared =
        v.xx * step.x * step.x + 2 * v.xy * step.x * step.y + v.yy * step.y * step.y;
    return length_in_plane(std::sqrt(std::max(squared, 0.0)), r.e);
}

/// The steps shrink by about the same factor each: what is left after the last is below rounding.
bool is_settled(double change, double previous, double extent) {
    const double rounding = epsilon / 16 * extent;
    if (change <= rounding) return true;
    return change < 0.1 * previous && change * (change / previous) < rounding;
}

/// By how much a mean square can come out too large when each distance is a rounding off.
double rounding_of(double mean_square, double extent) {
    const double rounding = 4 * epsilon * extent;
    return (2 * std::sqrt(mean_square) + rounding) * rounding;
}

/// How distances are summed up: all terms of a short list; of a long one the plain terms, and the
/// curving as a sample of it has it, which changes the number of steps and not their end.
class Summing {
public:
    Summing(Values x, Values y)
        : x_{x}
        , y_{y} {}
    void take_curving(const Residuals& sample) { sample_ = sample; }

    [[nodiscard]] Residuals operator()(const SeenCircle& c) const {
        if (!sample_ || is_far(c)) return residuals_of(x_, y_, c);
        Residuals r = plain_residuals_of(x_, y_, c);
        r.bxx = sample_->bxx;
        r.bxy = sample_->bxy;
        r.byy = sample_->byy;
        return r;
    }

private:
    Values x_, y_;
    std::optional<Residuals> sample_;
};

Fit refined(const Summing& sum_up, const SeenCircle& start, double extent) {
    constexpr int most_steps = 300; // three or four are needed
    const double longest_radius = largest_radius_in_extents * extent;
    Fit fit{start, sum_up(start)};
    double damping = 0, previous = 0;
    for (int i = 0; i < most_steps; ++i) {
        const CircleStep step = step_of(fit.residuals, damping);
        const double change = change_by(step, fit.residuals);
        if (!std::isfinite(step.x + step.y + step.inward)) break;
        Fit next{moved(fit.circle, step, longest_radius), {}};
        if (damping == 0 && is_settled(change, previous, extent)) {
            fit.circle = next.circle;
            break;
        }
        next.residuals = sum_up(next.circle);
        if (next.residuals.ee <= fit.residuals.ee + rounding_of(fit.residuals.ee, extent)) {
            fit = next;
            damping = damping < 1e-4 ? 0 : damping / 10;
            previous = change;
        } else {
            damping = damping == 0 ? 1e-3 : damping * 10;
            if (damping > 1e12) break;
        }
    }
    return fit;
}

constexpr std::size_t long_list = 16384, sample_size = 4096;

/// Where a long list begins: the circle of some of its points. Nothing where these lie on a line.
std::optional<Fit> fit_of_sample(Values x, Values y, const CheckedPoints& points) {
    std::vector<double> sample_x(sample_size), sample_y(sample_size);
    for (std::size_t i = 0; i < sample_size; ++i) {
        sample_x[i] = x[i * x.size() / sample_size];
        sample_y[i] = y[i * x.size() / sample_size];
    }
    const auto start = starting_circle(sample_x, sample_y, points);
    if (!start) return std::nullopt;
    return refined(Summing{sample_x, sample_y}, *start, points.box.extent());
}

Result<Fit> fit_of(Values x, Values y, const CheckedPoints& points) {
    const double extent = points.box.extent();
    Summing sum_up{x, y};
    if (x.size() >= long_list)
        if (const auto sample = fit_of_sample(x, y, points)) {
            sum_up.take_curving(sample->residuals);
            return refined(sum_up, sample->circle, extent);
        }
    AXISCAL_TRY(const SeenCircle start, starting_circle(x, y, points));
    return refined(sum_up, start, extent);
}

} // namespace

Result<LeastSquaresCircle> fit_least_squares_circle(Values x, Values y) {
    AXISCAL_TRY(const CheckedPoints points, check_points(x, y));
    AXISCAL_TRY(const Fit fit, fit_of(x, y, points));
    const double longest_radius = largest_radius_in_extents * points.box.extent();
    // written so that a NaN fails, too
    if (!(fit.circle.radius < 0.999 * longest_radius)) return refuse_line();
    const SeenCircle& c = fit.circle;
    return LeastSquaresCircle{c.origin_x + c.a, c.origin_y + c.b, c.radius,
                              condition_of(fit.residuals, c)};
}

} // namespace axiscal
