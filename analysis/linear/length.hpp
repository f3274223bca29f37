#pragma once
// The length of a vector in a plane. Pure.

#include <cmath>

namespace axiscal {

/// sqrt(x² + y²), in the unit of both, to 1 ulp for lengths from 1e-150 to 1e150. Not std::hypot, which each C library rounds in
/// its own way: figures have the same bits on every processor.
inline double length_in_plane(double x, double y) {
    return std::sqrt(x * x + y * y);
}

} // namespace axiscal
