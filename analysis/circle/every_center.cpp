#include "analysis/circle/every_center.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

} // namespace

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
