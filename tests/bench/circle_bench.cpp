#include "analysis/circle/circle_fit.hpp"
#include "analysis/circle/circle_start.hpp"
#include "tests/bench/circle_points.hpp"
#include "tests/bench/row.hpp"

namespace axiscal::bench {
namespace {

Work reading(std::size_t count, double arc_deg) {
    return [count, arc_deg] { benchmark::DoNotOptimize(read_pass(circle_points(count, arc_deg))); };
}

Work zone(std::size_t count, double arc_deg) {
    return [count, arc_deg] {
        const CirclePoints& points = circle_points(count, arc_deg);
        benchmark::DoNotOptimize(fit_minimum_zone_circle(points.x, points.y));
    };
}

Work algebraic(std::size_t count) {
    return [count] {
        const CirclePoints& points = circle_points(count, 360);
        circle::CheckedPoints checked;
        checked.box = {-97, 103, -102, 98};
        checked.mean_x = 3;
        checked.mean_y = -2;
        benchmark::DoNotOptimize(circle::starting_circle(points.x, points.y, checked));
    };
}

Work orthogonal(std::size_t count) {
    return [count] {
        const CirclePoints& points = circle_points(count, 360);
        benchmark::DoNotOptimize(fit_least_squares_circle(points.x, points.y));
    };
}

constexpr std::size_t thousand = 1000, hundred_thousand = 100000, million = 1000000;

[[maybe_unused]] const bool added =
    add({"minimum zone, 360 deg, 1e6", zone(million, 360), reading(million, 360), 5}) &&
    add({"minimum zone, 220 deg, 1e6", zone(million, 220), reading(million, 220), 5}) &&
    add({"minimum zone, 360 deg, 1e5", zone(hundred_thousand, 360), reading(hundred_thousand, 360),
         10}) &&
    add({"minimum zone, 220 deg, 1e5", zone(hundred_thousand, 220), reading(hundred_thousand, 220),
         10}) &&
    add({"minimum zone, 360 deg, 1e3", zone(thousand, 360), reading(thousand, 360), 0, 0.1}) &&
    add({"minimum zone, 220 deg, 1e3", zone(thousand, 220), reading(thousand, 220), 0, 0.1}) &&
    add({"least squares circle, algebraic, 1e6", algebraic(million), reading(million, 360), 3}) &&
    add({"least squares circle, orthogonal, 1e6", orthogonal(million), reading(million, 360), 12});

} // namespace
} // namespace axiscal::bench
