#pragma once
// The points that lie nearest to and furthest from a centre, out of very many. Only a search:
// what it names is measured again by the code of the figures. Pure.

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal::circle {

/// Points by their coordinates, and the centre in the same coordinates.
struct Target {
    std::span<const double> x, y;
    double center_x = 0, center_y = 0;
};

/// Only points outside this ring are of interest (squared radii).
struct Ring {
    double inner = 0, outer = 0;
};

/// Indices of points outside the ring: of each of up to 32 stretches of the points the furthest
/// and the nearest one. Empty: all points lie in the ring.
std::vector<std::size_t> find_outside(const Target& target, const Ring& ring);

/// The point furthest from the centre.
std::size_t find_furthest(const Target& target);

} // namespace axiscal::circle
