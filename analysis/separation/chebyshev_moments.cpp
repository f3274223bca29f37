// The kernel of the fast fit, compiled twice on x86-64 (baseline and AVX2, same bits). Eight points
// go abreast. Sums above the degree come from products, T_D T_j = (T_{D+j} + T_{D-j}) / 2, so the
// recurrence runs to the degree only.

#include "analysis/separation/chebyshev_moments.hpp"

#include <algorithm>
#include <cstring>

namespace axiscal {
namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t terms = highest_moment_degree + 1;

/// What the kernel needs of the range: t = ((x - from) + (x - to)) * scale.
struct Scale {
    double from, to, scale;
};

/// Eight sums of everything, one a lane.
struct LaneSums {
    alignas(64) double basis[terms][lanes], product[terms][lanes], right[terms][lanes],
        largest_square[lanes], largest_right_square[lanes];
};

/// Eight doubles in vectors of `width`, what one register of the CPU holds: compilers make poor
/// code of wider ones. Every width does the same operations in the same lanes.
template <std::size_t width> struct Eight {
    using Vector [[gnu::vector_size(width * sizeof(double))]] = double;
    static constexpr std::size_t parts = lanes / width;
    Vector part[parts];
};

/// Adds `groups` groups of eight points.
template <std::size_t width>
[[gnu::always_inline]] inline void add_groups(const double* x,
                                              const double* y,
                                              std::size_t groups,
                                              std::size_t degree,
                                              Scale range,
                                              LaneSums& sums) {
    using V = typename Eight<width>::Vector;
    constexpr std::size_t parts = Eight<width>::parts;
    const auto add = [](double* sum, const V& more) __attribute__((always_inline)) {
        V value;
        std::memcpy(&value, sum, sizeof value);
        value += more;
        std::memcpy(sum, &value, sizeof value);
    };
    const auto raise = [](double* top, const V& square) __attribute__((always_inline)) {
        V value;
        std::memcpy(&value, top, sizeof value);
        value = square > value ? square : value;
        std::memcpy(top, &value, sizeof value);
    };
    for (std::size_t group = 0; group < groups; ++group) {
        V value[parts], twice[parts], before[parts], here[parts], values[terms][parts];
        for (std::size_t p = 0; p < parts; ++p) {
            V position;
            std::memcpy(&position, x + group * lanes + p * width, sizeof position);
            std::memcpy(&value[p], y + group * lanes + p * width, sizeof position);
            const V t = ((position - range.from) + (position - range.to)) * range.scale;
            raise(sums.largest_square + p * width, t * t);
            raise(sums.largest_right_square + p * width, value[p] * value[p]);
            add(sums.right[0] + p * width, value[p]);
            twice[p] = t + t;
            before[p] = t * 0 + 1;
            here[p] = t;
        }
        for (std::size_t k = 1; k <= degree; ++k)
            for (std::size_t p = 0; p < parts; ++p) {
                values[k][p] = here[p];
                add(sums.basis[k] + p * width, here[p]);
                add(sums.right[k] + p * width, here[p] * value[p]);
                const V next = twice[p] * here[p] - before[p];
                before[p] = here[p];
                here[p] = next;
            }
        for (std::size_t j = 1; j <= degree; ++j)
            for (std::size_t p = 0; p < parts; ++p)
                add(sums.product[j] + p * width, values[degree][p] * values[j][p]);
    }
}

void add_groups_anywhere(const double* x,
                         const double* y,
                         std::size_t groups,
                         std::size_t degree,
                         Scale range,
                         LaneSums& sums) {
    add_groups<2>(x, y, groups, degree, range, sums);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void add_groups_avx2(const double* x,
                                                     const double* y,
                                                     std::size_t groups,
                                                     std::size_t degree,
                                                     Scale range,
                                                     LaneSums& sums) {
    add_groups<4>(x, y, groups, degree, range, sums);
}
auto choose_kernel() {
    return __builtin_cpu_supports("avx2") ? add_groups_avx2 : add_groups_anywhere;
}
#else
auto choose_kernel() {
    return add_groups_anywhere;
}
#endif

struct Totals {
    double basis[terms] = {}, product[terms] = {}, right[terms] = {}, largest_square = 0,
           largest_right_square = 0;
};

void fold(const LaneSums& sums, std::size_t degree, Totals& totals) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        totals.largest_square = std::max(totals.largest_square, sums.largest_square[lane]);
        totals.largest_right_square =
            std::max(totals.largest_right_square, sums.largest_right_square[lane]);
        for (std::size_t k = 0; k <= degree; ++k) {
            totals.basis[k] += sums.basis[k][lane];
            totals.product[k] += sums.product[k][lane];
            totals.right[k] += sums.right[k][lane];
        }
    }
}

void add_point(double x, double y, std::size_t degree, Scale range, Totals& totals) {
    const double t = ((x - range.from) + (x - range.to)) * range.scale;
    totals.largest_square = std::max(totals.largest_square, t * t);
    totals.largest_right_square = std::max(totals.largest_right_square, y * y);
    double values[terms] = {1, t};
    for (std::size_t k = 2; k <= degree; ++k)
        values[k] = 2 * t * values[k - 1] - values[k - 2];
    totals.right[0] += y;
    for (std::size_t k = 1; k <= degree; ++k) {
        totals.basis[k] += values[k];
        totals.right[k] += values[k] * y;
        totals.product[k] += values[degree] * values[k];
    }
}

} // namespace

ChebyshevMoments chebyshev_moments(std::span<const double> x,
                                   std::span<const double> y,
                                   std::size_t degree,
                                   double from,
                                   double to) {
    const Scale range{from, to, 1 / (to - from)};
    constexpr std::size_t chunk_groups = 512; // short sums first: their rounding does not pile up
    const std::size_t groups = x.size() / lanes;
    const auto add = choose_kernel();
    Totals totals;
    for (std::size_t first = 0; first < groups; first += chunk_groups) {
        LaneSums sums{};
        add(x.data() + first * lanes, y.data() + first * lanes,
            std::min(chunk_groups, groups - first), degree, range, sums);
        fold(sums, degree, totals);
    }
    for (std::size_t i = groups * lanes; i < x.size(); ++i)
        add_point(x[i], y[i], degree, range, totals);

    ChebyshevMoments moments;
    moments.largest_square = totals.largest_square;
    moments.largest_right_square = totals.largest_right_square;
    totals.basis[0] = static_cast<double>(x.size());
    moments.right.assign(totals.right, totals.right + degree + 1);
    moments.basis.assign(totals.basis, totals.basis + degree + 1);
    for (std::size_t j = 1; j <= degree; ++j)
        moments.basis.push_back(2 * totals.product[j] - totals.basis[degree - j]);
    return moments;
}

} // namespace axiscal
