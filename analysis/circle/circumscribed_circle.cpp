// The smallest circle around all points stands on two or three of them. The point that lies
// furthest outside joins the circle's own; the smallest circle of those (four at most) is the next:
// radii only grow, so that no set comes twice (E. Welzl's problem, solved by pivots as B. Gaertner
// does, Fast and robust smallest enclosing balls, 1999). What is told reaches to the furthest
// point.

#include "analysis/circle/candidate_kernels.hpp"
#include "analysis/circle/circle_fit.hpp"
#include "analysis/circle/circle_start.hpp"
#include "analysis/circle/point_check.hpp"
#include "analysis/linear/length.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using namespace circle;

struct Place {
    double x, y;
};

struct Around {
    PlainCircle circle;
    std::vector<Place> support;
};

double distance(const PlainCircle& c, const Place& p) {
    return length_in_plane(p.x - c.x, p.y - c.y);
}

PlainCircle through(const Place& p, const Place& q) {
    return {(p.x + q.x) / 2, (p.y + q.y) / 2, length_in_plane(q.x - p.x, q.y - p.y) / 2};
}

/// Not finite for three on a line.
PlainCircle through(const Place& p, const Place& q, const Place& r) {
    const double bx = q.x - p.x, by = q.y - p.y, cx = r.x - p.x, cy = r.y - p.y;
    const double twice = 2 * (bx * cy - by * cx), b = bx * bx + by * by, c = cx * cx + cy * cy;
    const double x = (cy * b - by * c) / twice, y = (bx * c - cx * b) / twice;
    return {p.x + x, p.y + y, length_in_plane(x, y)};
}

bool holds(const PlainCircle& circle, const std::vector<Place>& support) {
    constexpr double rounding = 1e-14;
    for (const Place& p : support)
        if (!(distance(circle, p) <= circle.radius * (1 + rounding))) return false;
    return true;
}

/// The smallest circle around the support and the new point, which it stands on.
Around grown(const std::vector<Place>& support, const Place& added) {
    Around best{{0, 0, std::numeric_limits<double>::infinity()}, {}};
    const auto consider = [&](const PlainCircle& circle, std::vector<Place> stands_on) {
        if (circle.radius < best.circle.radius && holds(circle, support))
            best = {circle, std::move(stands_on)};
    };
    for (std::size_t i = 0; i < support.size(); ++i) {
        consider(through(added, support[i]), {added, support[i]});
        for (std::size_t j = 0; j < i; ++j)
            consider(through(added, support[i], support[j]), {added, support[i], support[j]});
    }
    return best;
}

/// A point aside of a diameter moves the centre by d and the radius by d^2 / (2 R) only, which may
/// be below the last digit of R: that many pivots may leave the radius as it is.
constexpr int most_still = 30;

} // namespace

Result<PlainCircle> fit_minimum_circumscribed_circle(Values x, Values y) {
    AXISCAL_TRY(const CheckedPoints points, check_points(x, y));
    AXISCAL_CHECK(starting_circle(x, y, points));
    const double origin_x = points.mean_x, origin_y = points.mean_y;
    const auto furthest_from = [&](const PlainCircle& c) {
        const std::size_t i = find_furthest({x, y, origin_x + c.x, origin_y + c.y});
        return Place{x[i] - origin_x, y[i] - origin_y};
    };
    const Place first = furthest_from({});
    const Place second = furthest_from({first.x, first.y, 0});
    Around now{through(first, second), {first, second}};
    PlainCircle best{0, 0, std::numeric_limits<double>::infinity()};
    constexpr int most_pivots = 1000; // about ten are needed
    for (int pivot = 0, still = 0; pivot < most_pivots && still < most_still; ++pivot) {
        const Place outside = furthest_from(now.circle);
        const double reach = distance(now.circle, outside);
        if (reach < best.radius) best = {now.circle.x, now.circle.y, reach};
        if (reach <= now.circle.radius) break;
        Around next = grown(now.support, outside);
        if (next.support.empty()) break;
        still = next.circle.radius > now.circle.radius ? 0 : still + 1;
        now = std::move(next);
    }
    return PlainCircle{origin_x + best.x, origin_y + best.y, best.radius};
}

} // namespace axiscal
