#pragma once
// Points for the circle fits.

#include "tests/unit/analysis/reference_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace axiscal::test {

struct Points {
    std::vector<double> x, y;
};

inline Points listed(const std::vector<std::pair<double, double>>& pairs) {
    Points points;
    for (const auto& [x, y] : pairs) {
        points.x.push_back(x);
        points.y.push_back(y);
    }
    return points;
}

inline Points points_of(const nlohmann::json& rows) {
    return listed(rows.get<std::vector<std::pair<double, double>>>());
}

/// `count` points evenly over an arc, both ends included.
inline Points
arc(std::size_t count, double degrees, double first_degrees, double x, double y, double radius) {
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(count - 1);
        const double angle = (first_degrees + degrees * part) * std::numbers::pi / 180;
        points.x.push_back(x + radius * std::cos(angle));
        points.y.push_back(y + radius * std::sin(angle));
    }
    return points;
}

inline void add_noise(Points& points, double size, std::mt19937_64& random) {
    std::uniform_real_distribution<double> noise{-size, size};
    for (auto* values : {&points.x, &points.y})
        for (double& value : *values)
            value += noise(random);
}

inline Points mapped(Points points, double scale, double shift_x, double shift_y) {
    for (double& x : points.x)
        x = scale * x + shift_x;
    for (double& y : points.y)
        y = scale * y + shift_y;
    return points;
}

inline Points shuffled(const Points& points, std::mt19937_64& random) {
    std::vector<std::size_t> order(points.x.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::ranges::shuffle(order, random);
    Points out;
    for (const std::size_t i : order) {
        out.x.push_back(points.x[i]);
        out.y.push_back(points.y[i]);
    }
    return out;
}

} // namespace axiscal::test
