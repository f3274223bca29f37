// Points of any kind into the circle fits: finite circles with what they promise, or a reason.
// First byte: how the rest is read, as doubles or as small integers on a grid.

#include "analysis/circle/circle_fit.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace axiscal;

namespace {

struct Points {
    std::vector<double> x, y;
    double largest = 0;
};

double coordinate(const std::uint8_t* from, bool as_double) {
    if (as_double) {
        double value = 0;
        std::memcpy(&value, from, sizeof value);
        return value;
    }
    std::int16_t value = 0;
    std::memcpy(&value, from, sizeof value);
    return value / 16.0;
}

Points points_of(const std::uint8_t* data, std::size_t size) {
    Points points;
    if (size == 0) return points;
    const bool as_double = data[0] % 2 == 1;
    const std::size_t width = as_double ? 8 : 2;
    constexpr std::size_t most = 200;
    for (std::size_t at = 1; at + 2 * width <= size && points.x.size() < most; at += 2 * width) {
        points.x.push_back(coordinate(data + at, as_double));
        points.y.push_back(coordinate(data + at + width, as_double));
        points.largest =
            std::max({points.largest, std::fabs(points.x.back()), std::fabs(points.y.back())});
    }
    return points;
}

template <class Fit> bool is_told(const Result<Fit>& fit) {
    if (!fit)
        fuzz::require(!fit.error().detail.empty() && fit.error().fault == Fault::bad_case,
                      "a refusal has a reason");
    return fit.has_value();
}

void judge_circle(double x, double y, double radius) {
    fuzz::require(std::isfinite(x) && std::isfinite(y) && std::isfinite(radius),
                  "a circle is finite");
    fuzz::require(radius >= 0, "a radius is not negative");
}

void judge_zone(const Points& points, const MinimumZoneCircle& zone) {
    judge_circle(zone.x, zone.y, zone.outer_radius);
    const double scale = std::max(zone.outer_radius, points.largest);
    fuzz::require(zone.gap >= 0 && zone.gap <= 1e-12 * scale, "the gap is closed");
    fuzz::require(zone.control_points.size() == 4, "four control points");
    const double rounding = 1e-14 * scale;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const double d = std::hypot(points.x[i] - zone.x, points.y[i] - zone.y);
        fuzz::require(d <= zone.outer_radius + rounding && d >= zone.inner_radius - rounding,
                      "the zone holds every point");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Points points = points_of(data, size);
    const auto mean = fit_least_squares_circle(points.x, points.y);
    if (is_told(mean)) {
        judge_circle(mean->x, mean->y, mean->radius);
        fuzz::require(std::isfinite(mean->condition) && mean->condition >= 1, "a condition from 1");
        const double arc = arc_of_points_deg(points.x, points.y, mean->x, mean->y);
        fuzz::require(arc >= 0 && arc <= 360, "an arc from 0 to 360");
    }
    const auto zone = fit_minimum_zone_circle(points.x, points.y);
    if (is_told(zone)) judge_zone(points, *zone);
    const auto around = fit_minimum_circumscribed_circle(points.x, points.y);
    if (is_told(around)) {
        judge_circle(around->x, around->y, around->radius);
        for (std::size_t i = 0; i < points.x.size(); ++i)
            fuzz::require(std::hypot(points.x[i] - around->x, points.y[i] - around->y) <=
                              around->radius * (1 + 1e-12) + 1e-14 * points.largest,
                          "the circumscribed circle holds every point");
    }
    const auto inside = fit_maximum_inscribed_circle(points.x, points.y);
    if (is_told(inside)) {
        judge_circle(inside->x, inside->y, inside->radius);
        for (std::size_t i = 0; i < points.x.size(); ++i)
            fuzz::require(std::hypot(points.x[i] - inside->x, points.y[i] - inside->y) >=
                              inside->radius * (1 - 1e-12) - 1e-14 * points.largest,
                          "the inscribed circle holds no point");
    }
    return 0;
}
