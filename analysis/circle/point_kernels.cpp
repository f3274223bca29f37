#include "analysis/circle/point_kernels.hpp"

#include "analysis/circle/wide.hpp"

#include <algorithm>
#include <array>

namespace axiscal::circle {
namespace {

/// A point in the centre has no direction: u = 0 / 1e-140.
constexpr double no_zero = 1e-280;

/// Adds up the terms of every point: `terms(x, y)` gives an array, of Lanes or of double.
template <class Lanes, std::size_t count, class Terms>
inline std::array<double, count>
add_up(std::span<const double> x, std::span<const double> y, const Terms& terms) {
    std::array<Lanes, count> wide{};
    const std::size_t whole = x.size() - x.size() % Lanes::lanes;
    for (std::size_t i = 0; i < whole; i += Lanes::lanes) {
        const auto term = terms(Lanes::load(&x[i]), Lanes::load(&y[i]));
        for (std::size_t j = 0; j < count; ++j)
            wide[j] = wide[j] + term[j];
    }
    for (std::size_t i = whole; i < x.size(); ++i) {
        const auto term = terms(x[i], y[i]);
        for (std::size_t j = 0; j < count; ++j)
            wide[j].add_to_lane(i - whole, term[j]);
    }
    std::array<double, count> sums{};
    for (std::size_t j = 0; j < count; ++j)
        sums[j] = wide[j].sum();
    return sums;
}

template <class Lanes, std::size_t count, class Terms>
std::array<double, count>
mean_of(std::span<const double> x, std::span<const double> y, const Terms& terms) {
    auto sums = add_up<Lanes, count>(x, y, terms);
    for (double& sum : sums)
        sum /= static_cast<double>(x.size());
    return sums;
}

template <class Lanes> struct Range {
    Lanes low, high;
    explicit Range(double first)
        : low{first}
        , high{first} {}
    void include(Lanes values) {
        low = smaller(values, low);
        high = larger(values, high);
    }
    void include_in(double& lowest, double& highest) const {
        for (std::size_t lane = 0; lane < Lanes::lanes; ++lane) {
            lowest = std::min(lowest, low[lane]);
            highest = std::max(highest, high[lane]);
        }
    }
};

} // namespace

Survey survey(std::span<const double> x, std::span<const double> y) {
    using Lanes = Four;
    Range<Lanes> range_x{x[0]}, range_y{y[0]};
    const auto sums = add_up<Lanes, 2>(x, y, [&range_x, &range_y](auto at_x, auto at_y) {
        range_x.include(at_x);
        range_y.include(at_y);
        return std::array{at_x, at_y};
    });
    Survey out{x[0], x[0], y[0], y[0], sums[0], sums[1]};
    range_x.include_in(out.low_x, out.high_x);
    range_y.include_in(out.low_y, out.high_y);
    return out;
}

Moments moments_about(std::span<const double> x,
                      std::span<const double> y,
                      double origin_x,
                      double origin_y) {
    const auto mean = mean_of<Pair, 6>(x, y, [=](auto at_x, auto at_y) {
        const auto from_x = at_x - origin_x, from_y = at_y - origin_y;
        const auto xx = from_x * from_x, yy = from_y * from_y, z = xx + yy;
        return std::array{xx, from_x * from_y, yy, from_x * z, from_y * z, z * z};
    });
    return {mean[0], mean[1], mean[2], mean[3], mean[4], mean[5]};
}

Residuals residuals_of(std::span<const double> x, std::span<const double> y, const SeenCircle& c) {
    const double towards_x = -c.a / c.radius, towards_y = -c.b / c.radius;
    const auto mean = mean_of<Pair, 12>(x, y, [=, &c](auto at_x, auto at_y) {
        const auto from_x = at_x - c.origin_x, from_y = at_y - c.origin_y;
        const auto f = from_x * from_x + from_y * from_y - 2 * (c.a * from_x + c.b * from_y) + c.k;
        const auto dx = from_x - c.a, dy = from_y - c.b;
        const auto d = root(dx * dx + dy * dy + no_zero);
        const auto e = f / (d + c.radius), one_by_d = 1 / d;
        const auto ux = dx * one_by_d, uy = dy * one_by_d;
        const auto vx = ux - towards_x, vy = uy - towards_y, bend = e * one_by_d;
        return std::array{e,
                          e * e,
                          vx,
                          vy,
                          vx * vx,
                          vx * vy,
                          vy * vy,
                          e * vx,
                          e * vy,
                          bend * (uy * uy),
                          bend * (0 - ux * uy),
                          bend * (ux * ux)};
    });
    return {mean[0], mean[1], mean[2], mean[3], mean[4],  mean[5],
            mean[6], mean[7], mean[8], mean[9], mean[10], mean[11]};
}

Residuals
plain_residuals_of(std::span<const double> x, std::span<const double> y, const SeenCircle& c) {
    const double center_x = c.origin_x + c.a, center_y = c.origin_y + c.b;
    const auto mean = mean_of<Pair, 8>(x, y, [=, &c](auto at_x, auto at_y) {
        const auto dx = at_x - center_x, dy = at_y - center_y;
        const auto d = root(dx * dx + dy * dy + no_zero);
        const auto e = d - c.radius, one_by_d = 1 / d;
        const auto ux = dx * one_by_d, uy = dy * one_by_d;
        return std::array{e, e * e, ux, uy, ux * ux, ux * uy, e * ux, e * uy};
    });
    const auto [e, ee, ux, uy, uxx, uxy, ex, ey] = mean;
    const double tx = c.a / c.radius, ty = c.b / c.radius; // v = u + t
    Residuals r;
    r.e = e;
    r.ee = ee;
    r.vx = ux + tx;
    r.vy = uy + ty;
    r.vxx = uxx + (2 * ux + tx) * tx;
    r.vxy = uxy + ux * ty + uy * tx + tx * ty;
    r.vyy = (1 - uxx) + (2 * uy + ty) * ty;
    r.ex = ex + e * tx;
    r.ey = ey + e * ty;
    return r;
}

} // namespace axiscal::circle
