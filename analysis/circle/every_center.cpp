#include "analysis/circle/every_center.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace axiscal::circle {
namespace {

/// Points at the same distance from two points: normal . (x, y) = offset.
struct Bisector {
    double normal_x, normal_y, offset;
};

struct Found {
    SeenCircle circle;
    double width;
};

class EveryCenter {
public:
    EveryCenter(Values x, Values y, double origin_x, double origin_y, double width)
        : origin_x_{origin_x}
        , origin_y_{origin_y}
        , width_{width} {
        for (std::size_t i = 0; i < x.size(); ++i) {
            x_.push_back(x[i] - origin_x);
            y_.push_back(y[i] - origin_y);
        }
    }

    std::vector<SeenCircle> search() {
        const auto lines = bisectors();
        for (std::size_t i = 0; i < lines.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                try_crossing(lines[i], lines[j]);
        std::ranges::sort(found_, {}, &Found::width);
        std::vector<SeenCircle> out;
        for (const Found& one : found_) {
            if (out.size() == most_answers) break;
            out.push_back(one.circle);
        }
        return out;
    }

private:
    static constexpr std::size_t most_answers = 8;

    [[nodiscard]] std::vector<Bisector> bisectors() const {
        std::vector<Bisector> lines;
        for (std::size_t i = 0; i < x_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double dx = x_[i] - x_[j], dy = y_[i] - y_[j];
                if (dx == 0 && dy == 0) continue;
                lines.push_back({dx, dy, (dx * (x_[i] + x_[j]) + dy * (y_[i] + y_[j])) / 2});
            }
        return lines;
    }

    void try_crossing(const Bisector& p, const Bisector& q) {
        const double determinant = p.normal_x * q.normal_y - p.normal_y * q.normal_x;
        const double a = (p.offset * q.normal_y - q.offset * p.normal_y) / determinant;
        const double b = (q.offset * p.normal_x - p.offset * q.normal_x) / determinant;
        if (!std::isfinite(a + b)) return; // parallel
        double low = std::numeric_limits<double>::infinity(), high = 0;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const double dx = x_[i] - a, dy = y_[i] - b, d = std::sqrt(dx * dx + dy * dy);
            low = std::min(low, d);
            high = std::max(high, d);
            if (high - low >= width_) return;
        }
        width_ = high - low; // only narrower ones from here on
        found_.push_back({seen_from(origin_x_, origin_y_, a, b, (high + low) / 2), high - low});
    }

    double origin_x_, origin_y_, width_;
    std::vector<double> x_, y_;
    std::vector<Found> found_;
};

/// The circle through three corners of an acute triangle.
std::optional<PlainCircle> circle_of_acute(const std::array<double, 6>& p) {
    const double bx = p[2] - p[0], by = p[3] - p[1], cx = p[4] - p[0], cy = p[5] - p[1];
    const double b = bx * bx + by * by, c = cx * cx + cy * cy, bc = bx * cx + by * cy;
    const bool is_acute = bc > 0 && b > bc && c > bc;
    const double twice = 2 * (bx * cy - by * cx);
    if (!is_acute || twice == 0) return std::nullopt;
    const double x = (cy * b - by * c) / twice, y = (bx * c - cx * b) / twice;
    return PlainCircle{p[0] + x, p[1] + y, std::sqrt(x * x + y * y)};
}

bool is_empty(const PlainCircle& circle, Values x, Values y) {
    constexpr double rounding = 1e-12;
    const double inside = circle.radius * (1 - rounding), squared = inside * inside;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = x[i] - circle.x, dy = y[i] - circle.y;
        if (dx * dx + dy * dy < squared) return false;
    }
    return true;
}

/// Takes the point in unless one of the same place is there.
bool join(std::vector<std::size_t>& few, Values x, Values y, std::size_t added) {
    const auto same = [&](std::size_t i) { return x[i] == x[added] && y[i] == y[added]; };
    if (std::ranges::any_of(few, same)) return false;
    few.push_back(added);
    return true;
}

/// Indices of the nearest and the furthest point.
std::pair<std::size_t, std::size_t> ends_from(Values x, Values y, const SeenCircle& circle) {
    const double center_x = circle.origin_x + circle.a, center_y = circle.origin_y + circle.b;
    std::pair<std::size_t, std::size_t> ends{0, 0};
    double low = std::numeric_limits<double>::infinity(), high = -1;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = x[i] - center_x, dy = y[i] - center_y, squared = dx * dx + dy * dy;
        if (squared < low) ends.first = i, low = squared;
        if (squared > high) ends.second = i, high = squared;
    }
    return ends;
}

} // namespace

std::optional<SeenCircle>
center_by_growing_set(Values x, Values y, const SeenCircle& near, std::vector<std::size_t> few) {
    constexpr std::size_t most = 24;
    std::optional<SeenCircle> answer;
    for (bool grown = true; grown && few.size() <= most;) {
        std::vector<double> few_x, few_y;
        for (const std::size_t i : few) {
            few_x.push_back(x[i]);
            few_y.push_back(y[i]);
        }
        const auto centers = narrowest_centers(few_x, few_y, near.origin_x, near.origin_y,
                                               std::numeric_limits<double>::infinity());
        if (centers.empty()) break;
        answer = centers.front();
        const auto [nearest, furthest] = ends_from(x, y, *answer);
        const bool in = join(few, x, y, nearest), out = join(few, x, y, furthest);
        grown = in || out;
    }
    return answer;
}

std::optional<PlainCircle> largest_empty_circle(Values x, Values y, double radius) {
    std::optional<PlainCircle> best;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                const auto tried = circle_of_acute({x[i], y[i], x[j], y[j], x[k], y[k]});
                if (!tried || tried->radius <= (best ? best->radius : radius)) continue;
                if (is_empty(*tried, x, y)) best = tried;
            }
    return best;
}

std::vector<SeenCircle>
narrowest_centers(Values x, Values y, double origin_x, double origin_y, double width) {
    return EveryCenter{x, y, origin_x, origin_y, width}.search();
}

} // namespace axiscal::circle
