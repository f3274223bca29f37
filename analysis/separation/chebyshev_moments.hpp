#pragma once
// Sums of Chebyshev polynomials over many points, in one pass. Pure.

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal {

inline constexpr std::size_t highest_moment_degree = 32;

/// With t = ((x - from) + (x - to)) / (to - from):
struct ChebyshevMoments {
    std::vector<double> basis;       ///< sum of T_k(t), k = 0 .. 2 degree
    std::vector<double> right;       ///< sum of T_k(t) y, k = 0 .. degree
    double largest_square = 0;       ///< of t; meaningless where a sum is not finite
    double largest_right_square = 0; ///< of y
};

/// degree: 1 to 32; x and y of one length. Fixed lanes of eight and no contraction: the same bits
/// on every CPU. A number that is not finite makes right[0] or basis[1] not finite.
/// Relative accuracy of a sum: about 1e-16 times the square root of the number of points.
ChebyshevMoments chebyshev_moments(std::span<const double> x,
                                   std::span<const double> y,
                                   std::size_t degree,
                                   double from,
                                   double to);

} // namespace axiscal
