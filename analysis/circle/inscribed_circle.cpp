// The largest circle that holds no point: greatest min d over the centres c, d the distance of each
// point. Since d is convex, d(c + step) >= d - u . step, so that the linear problem
//
//   greatest r such that d - u . step >= r for every point of the working set
//
// never promises too much, and each step ends with a larger circle. Its optimum stands on three
// points that surround the centre (weights w >= 0, sum w u = 0); where one of three far-away
// helpers has a weight, the points do not surround it.

#include "analysis/circle/arc_of_points.hpp"
#include "analysis/circle/candidate_kernels.hpp"
#include "analysis/circle/circle_fit.hpp"
#include "analysis/circle/every_center.hpp"
#include "analysis/circle/point_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace axiscal {
namespace {

using namespace circle;

/// Direction from the centre, and distance.
struct Sight {
    double ux, uy, d;
};

struct Touching {
    std::array<std::size_t, 3> places{};
    double radius = std::numeric_limits<double>::infinity();
    double step_x = 0, step_y = 0;
    bool is_surrounded = false; ///< no helper has a weight
};

constexpr std::size_t helpers = 3;

/// The three constraints met with equality; nothing if they do not surround the centre.
std::optional<Touching> touch(const std::vector<Sight>& all,
                              const std::array<std::size_t, 3>& places) {
    const Sight &p = all[places[0]], &q = all[places[1]], &r = all[places[2]];
    const std::array<double, 3> weights{q.ux * r.uy - q.uy * r.ux, r.ux * p.uy - r.uy * p.ux,
                                        p.ux * q.uy - p.uy * q.ux};
    const double total = weights[0] + weights[1] + weights[2];
    if (total == 0) return std::nullopt;
    for (const double weight : weights)
        if (weight / total < 0) return std::nullopt;
    Touching out;
    out.places = places;
    out.radius = (weights[0] * p.d + weights[1] * q.d + weights[2] * r.d) / total;
    // u . step = d - radius, from the differences of two pairs: the determinant is the total
    const double dq = q.d - p.d, dr = r.d - p.d;
    out.step_x = (dq * (r.uy - p.uy) - dr * (q.uy - p.uy)) / total;
    out.step_y = (dr * (q.ux - p.ux) - dq * (r.ux - p.ux)) / total;
    out.is_surrounded = true;
    for (std::size_t k = 0; k < 3; ++k)
        out.is_surrounded = out.is_surrounded && (places[k] >= helpers || weights[k] == 0);
    return out;
}

/// Dual simplex: the point that is cut into most replaces one of the three.
Touching largest_circle(const std::vector<Sight>& all) {
    Touching now = touch(all, {0, 1, 2}).value_or(Touching{});
    constexpr int most_exchanges = 1000;
    for (int i = 0; i < most_exchanges; ++i) {
        std::size_t worst = 0;
        double cut = 0;
        for (std::size_t k = helpers; k < all.size(); ++k) {
            const double left =
                all[k].d - all[k].ux * now.step_x - all[k].uy * now.step_y - now.radius;
            if (left < cut) {
                cut = left;
                worst = k;
            }
        }
        if (worst == 0) break;
        Touching next;
        for (std::size_t k = 0; k < 3; ++k) {
            auto places = now.places;
            places[k] = worst;
            const auto tried = touch(all, places);
            if (tried && tried->radius < next.radius) next = *tried;
        }
        if (!(next.radius < now.radius)) break;
        now = next;
    }
    return now;
}

class Inscribed {
public:
    Inscribed(Values x, Values y, double extent, const LeastSquaresCircle& start)
        : x_{x}
        , y_{y}
        , extent_{extent}
        , start_radius_{start.radius}
        , center_{start.x, start.y, 0} {}

    Result<PlainCircle> fit() {
        const WidestGap gap = widest_gap(x_, y_, center_.x, center_.y);
        const bool open = gap.angle_rad >= std::numbers::pi;
        if (open && is_arc()) return not_surrounded();
        set_ = nearest_of_sectors(x_, y_, center_.x, center_.y);
        set_.insert(set_.end(), {gap.before, gap.after});
        center_.radius = nearest_to(center_);
        const bool surrounded = !open && climb();
        if (!climb_elsewhere(surrounded ? center_.radius : 0) && !surrounded)
            return not_surrounded();
        return center_;
    }

private:
    static constexpr std::size_t few = 40;

    /// Points that lie near the circle of least squares, and not scattered about. Of few points
    /// every circle is tried: there is nothing to be guessed.
    [[nodiscard]] bool is_arc() const {
        constexpr double near = 0.05;
        if (x_.size() <= few) return false;
        double squares = 0;
        for (std::size_t i = 0; i < x_.size(); ++i)
            squares += std::pow(distance(center_, i) / start_radius_ - 1, 2);
        return squares < near * near * static_cast<double>(x_.size());
    }

    /// To the largest circle next to this centre. False: the points surround it no longer.
    bool climb() {
        constexpr int most_rounds = 500; // about six are needed
        for (int round = 0; round < most_rounds; ++round) {
            const Touching best = largest_circle(sights());
            const double better = best.radius - center_.radius;
            if (!best.is_surrounded) return false;
            if (!(better > std::numeric_limits<double>::epsilon() / 4 * extent_)) return true;
            const std::size_t size = set_.size();
            PlainCircle next{center_.x + best.step_x, center_.y + best.step_y, 0};
            next.radius = nearest_to(next);
            if (next.radius > center_.radius)
                center_ = next;
            else if (set_.size() == size)
                return true; // rounding
        }
        return true;
    }

    /// There may be larger circles than `radius`, next to the start or, where the points lie
    /// scattered, anywhere: of all circles on three of the points nearest to the centre, one in
    /// each direction, or of all points where they are few, the largest empty one is tried.
    bool climb_elsewhere(double radius) {
        std::vector<double> x, y;
        std::vector<std::size_t> tried(x_.size());
        std::iota(tried.begin(), tried.end(), std::size_t{0});
        if (x_.size() <= few)
            set_ = tried;
        else
            tried = nearest_of_sectors(x_, y_, center_.x, center_.y);
        // The centre of least squares may lie far away from points that are nearly in line.
        const double origin_x = x_[tried.front()], origin_y = y_[tried.front()];
        for (const std::size_t i : tried) {
            x.push_back(x_[i] - origin_x);
            y.push_back(y_[i] - origin_y);
        }
        const PlainCircle found = center_;
        const auto other = largest_empty_circle(x, y, radius);
        if (!other) return false;
        center_ = {origin_x + other->x, origin_y + other->y, 0};
        center_.radius = nearest_to(center_);
        const bool larger = climb() && center_.radius >= radius;
        if (!larger) center_ = found;
        return larger;
    }

    static tl::unexpected<Error> not_surrounded() {
        return refuse(Fault::bad_case, "maximum_inscribed",
                      "the points surround no centre: they span no more than 180 deg");
    }

    /// Distance of the nearest point; the nearest ones of each stretch join the working set.
    double nearest_to(const PlainCircle& center) {
        constexpr double all = std::numeric_limits<double>::infinity();
        double radius = all;
        for (const std::size_t i : find_outside({x_, y_, center.x, center.y}, {all, all})) {
            radius = std::min(radius, distance(center, i));
            if (std::ranges::find(set_, i) == set_.end()) set_.push_back(i);
        }
        return radius;
    }

    [[nodiscard]] double distance(const PlainCircle& center, std::size_t i) const {
        const double dx = x_[i] - center.x, dy = y_[i] - center.y;
        return std::sqrt(dx * dx + dy * dy);
    }

    [[nodiscard]] std::vector<Sight> sights() const {
        const double far = 1e6 * extent_, half = 0.5, high = std::sqrt(0.75);
        std::vector<Sight> all{{1, 0, far}, {-half, high, far}, {-half, -high, far}};
        for (const std::size_t i : set_) {
            const double d = distance(center_, i);
            if (d > 0) all.push_back({(x_[i] - center_.x) / d, (y_[i] - center_.y) / d, d});
        }
        return all;
    }

    Values x_, y_;
    double extent_, start_radius_;
    PlainCircle center_;
    std::vector<std::size_t> set_;
};

} // namespace

Result<PlainCircle> fit_maximum_inscribed_circle(Values x, Values y) {
    AXISCAL_TRY(const CheckedPoints points, check_points(x, y));
    AXISCAL_TRY(const LeastSquaresCircle start, fit_least_squares_circle(x, y));
    return Inscribed{x, y, points.box.extent(), start}.fit();
}

} // namespace axiscal
