#pragma once
// What a ballbar sees: two and three lobes, reversal spikes, noise of 0.5 um on a radius of 100 mm.

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace axiscal::bench {

struct CirclePoints {
    std::vector<double> x, y;
};

inline CirclePoints make_circle(std::size_t count, double arc_deg) {
    std::mt19937_64 random{17};
    std::normal_distribution<double> noise{0, 0.0005};
    CirclePoints points;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(count);
        const double t = 0.3 + part * arc_deg * std::numbers::pi / 180;
        const bool spike = std::fmod(t, std::numbers::pi / 2) < 0.01;
        const double r = 100 + 0.004 * std::cos(2 * t) + 0.002 * std::cos(3 * t + 1) +
                         (spike ? -0.003 : 0) + noise(random);
        points.x.push_back(3 + r * std::cos(t));
        points.y.push_back(-2 + r * std::sin(t));
    }
    return points;
}

/// The same points for every row that asks for them.
inline const CirclePoints& circle_points(std::size_t count, double arc_deg) {
    static std::map<std::pair<std::size_t, double>, CirclePoints> made;
    auto [found, is_new] = made.try_emplace({count, arc_deg});
    if (is_new) found->second = make_circle(count, arc_deg);
    return found->second;
}

/// Reads both coordinates of every point once, as fast as the baseline processor can: enough sums
/// at a time that none waits for another.
inline double read_pass(const CirclePoints& points) {
    typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));
    constexpr std::size_t step = 8;
    Pair a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{};
    for (std::size_t i = 0; i + step <= points.x.size(); i += step) {
        const auto* x = reinterpret_cast<const Pair*>(&points.x[i]);
        const auto* y = reinterpret_cast<const Pair*>(&points.y[i]);
        a += x[0];
        b += x[1];
        c += x[2];
        d += x[3];
        e += y[0];
        f += y[1];
        g += y[2];
        h += y[3];
    }
    const Pair sum = ((a + b) + (c + d)) + ((e + f) + (g + h));
    return sum[0] + sum[1];
}

} // namespace axiscal::bench
