#pragma once
// Every centre that a few points can define. Pure.

#include "analysis/circle/circle_fit.hpp"
#include "analysis/circle/point_check.hpp"
#include "analysis/circle/seen_circle.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace axiscal::circle {

/// A minimum zone has two points on each circle: its centre lies on the bisectors of two pairs.
/// Tries all of them (n^4 / 8) and gives up to eight of the narrowest, narrower than `width`.
std::vector<SeenCircle>
narrowest_centers(Values x, Values y, double origin_x, double origin_y, double width);

/// The narrowest zone's centre for any number of points, from a few of them: those that lie
/// furthest and nearest seen from the answer join the few (up to 24) until none is new. `few` holds
/// indices.
std::optional<SeenCircle>
center_by_growing_set(Values x, Values y, const SeenCircle& near, std::vector<std::size_t> few);

/// The largest circle with three of the points on it, none in it, and its centre surrounded by the
/// three; larger than `radius`. Tries all of them (n^3 / 6).
std::optional<PlainCircle> largest_empty_circle(Values x, Values y, double radius);

} // namespace axiscal::circle
