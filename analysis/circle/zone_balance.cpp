#include "analysis/circle/zone_balance.hpp"

#include "analysis/linear/length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axiscal::circle {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Twice the area of the triangle of three directions.
double area(const Bearing& a, const Bearing& b, const Bearing& c) {
    return (b.vx - a.vx) * (c.vy - a.vy) - (b.vy - a.vy) * (c.vx - a.vx);
}

double after(const CircleStep& step, const Bearing& p) {
    return p.e - p.vx * step.x - p.vy * step.y - step.inward;
}

/// The step after which three points lie at these distances.
CircleStep step_to(const std::array<Bearing, 3>& p, const std::array<double, 3>& distances) {
    const double determinant = area(p[0], p[1], p[2]);
    const double first = p[0].e - distances[0];
    const double e1 = p[1].e - distances[1] - first, e2 = p[2].e - distances[2] - first;
    CircleStep step;
    step.x = (e1 * (p[2].vy - p[0].vy) - e2 * (p[1].vy - p[0].vy)) / determinant;
    step.y = (e2 * (p[1].vx - p[0].vx) - e1 * (p[2].vx - p[0].vx)) / determinant;
    step.inward = first - p[0].vx * step.x - p[0].vy * step.y;
    return step;
}

void add_step(Balance& out, const std::array<Bearing, 4>& p) {
    // the three of the largest triangle: all but the one of the largest weight
    std::size_t left_out = 0;
    for (std::size_t k = 1; k < 4; ++k)
        if (std::fabs(out.weights[k]) > std::fabs(out.weights[left_out])) left_out = k;
    std::array<Bearing, 3> three;
    std::array<double, 3> distances{};
    for (std::size_t k = 0, to = 0; k < 4; ++k) {
        if (k == left_out) continue;
        three[to] = p[k];
        distances[to++] = std::copysign(out.half_width, out.weights[k]);
    }
    out.step = step_to(three, distances);
}

/// Place of the largest value, by a key.
template <class Key> std::size_t largest(const WorkingSet& set, const Key& key) {
    std::size_t best = 0;
    double best_value = -1;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const double value = key(set.bearings()[i]);
        if (value > best_value) {
            best = i;
            best_value = value;
        }
    }
    return best;
}

/// Two far apart, the one that spans the largest triangle with them, and the one that lies
/// furthest from the circle through these three.
FourPlaces spread_out(const WorkingSet& set) {
    const auto& all = set.bearings();
    FourPlaces places{};
    const auto from = [&all](std::size_t place) {
        return [a = all[place]](const Bearing& p) {
            return length_in_plane(p.vx - a.vx, p.vy - a.vy);
        };
    };
    places[0] = largest(set, from(0));
    places[1] = largest(set, from(places[0]));
    const Bearing a = all[places[0]], b = all[places[1]];
    places[2] = largest(set, [&](const Bearing& p) { return std::fabs(area(a, b, p)); });
    const CircleStep step = step_to({a, b, all[places[2]]}, {0, 0, 0});
    places[3] = largest(set, [&](const Bearing& p) { return std::fabs(after(step, p)); });
    return places;
}

Balance best_exchange(const WorkingSet& set, const Balance& now, std::size_t entering) {
    Balance best;
    for (std::size_t k = 0; k < 4; ++k) {
        FourPlaces places = now.places;
        places[k] = entering;
        const Balance next = balance_of(set, places);
        if (next.half_width > best.half_width) best = next;
    }
    return best;
}

} // namespace

Bearing bearing_of(double from_x, double from_y, const SeenCircle& c) {
    const double f = from_x * from_x + from_y * from_y - 2 * (c.a * from_x + c.b * from_y) + c.k;
    const double dx = from_x - c.a, dy = from_y - c.b, d = std::sqrt(dx * dx + dy * dy);
    if (d == 0) return {-c.radius, c.a / c.radius, c.b / c.radius};
    // v = (p - c) / d + c / R without the cancellation that a far centre would bring
    const double e = f / (d + c.radius), turned = e / c.radius;
    return {e, (from_x + c.a * turned) / d, (from_y + c.b * turned) / d};
}

bool WorkingSet::add(std::size_t index, double from_x, double from_y) {
    if (std::ranges::find(index_, index) != index_.end()) return false;
    append(index, from_x, from_y);
    return true;
}

void WorkingSet::append(std::size_t index, double from_x, double from_y) {
    index_.push_back(index);
    from_x_.push_back(from_x);
    from_y_.push_back(from_y);
}

void WorkingSet::see_from(const SeenCircle& circle) {
    bearings_.resize(size());
    for (std::size_t i = 0; i < size(); ++i)
        bearings_[i] = bearing_of(from_x_[i], from_y_[i], circle);
}

double WorkingSet::width_from(const SeenCircle& circle) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < size(); ++i) {
        const double e = bearing_of(from_x_[i], from_y_[i], circle).e;
        low = std::min(low, e);
        high = std::max(high, e);
    }
    return high - low;
}

Balance balance_of(const WorkingSet& set, const FourPlaces& places) {
    std::array<Bearing, 4> p;
    for (std::size_t k = 0; k < 4; ++k)
        p[k] = set.bearings()[places[k]];
    Balance out;
    out.places = places;
    out.weights = {area(p[1], p[2], p[3]), -area(p[0], p[2], p[3]), area(p[0], p[1], p[3]),
                   -area(p[0], p[1], p[2])};
    double level = 0, total = std::fabs(out.weights[0]);
    for (std::size_t k = 1; k < 4; ++k) { // the weights add up to 0: distances from the first one's
        level += out.weights[k] * (p[k].e - p[0].e);
        total += std::fabs(out.weights[k]);
    }
    if (!(total > 0)) return out;
    for (double& weight : out.weights)
        weight /= std::copysign(total, level);
    out.half_width = std::fabs(level) / total;
    add_step(out, p);
    return out;
}

Balance balance(const WorkingSet& set, const FourPlaces& start) {
    constexpr int most_exchanges = 500; // about 10 are needed
    Balance now = balance_of(set, start);
    if (!(now.half_width > 0)) now = balance_of(set, spread_out(set));
    for (int i = 0; i < most_exchanges && now.half_width >= 0; ++i) {
        const CircleStep step = now.step;
        const std::size_t worst =
            largest(set, [&](const Bearing& p) { return std::fabs(after(step, p)); });
        const double distance = std::fabs(after(step, set.bearings()[worst]));
        if (!(distance > now.half_width * (1 + epsilon))) break;
        const Balance next = best_exchange(set, now, worst);
        if (!(next.half_width > now.half_width)) break;
        now = next;
    }
    return now;
}

} // namespace axiscal::circle
