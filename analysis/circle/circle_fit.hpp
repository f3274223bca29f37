#pragma once
// Circles through measured points: least squares, minimum zone, minimum circumscribed, maximum
// inscribed. Coordinates and results in one unit, whichever it is. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

struct LeastSquaresCircle {
    double x = 0, y = 0, radius = 0;
    /// 2-norm condition number of the normal matrix (centre x, centre y, radius): 2 on a full
    /// circle of even steps, growing about as (180 deg / arc)^4 on short arcs.
    double condition = 0;
};

enum class ZoneSide : std::uint8_t { outer, inner };
struct ControlPoint {
    std::size_t index = 0; ///< of the point, from 0
    ZoneSide side = ZoneSide::outer;
};

/// How far the search went. What is certified is always the local optimum.
enum class ZoneSearch : std::uint8_t {
    local,       ///< the optimum next to the least squares circle
    multi_start, ///< the narrowest of the optima met from many starts
    exhaustive,  ///< the narrowest of every centre that two pairs of points can define
};

struct MinimumZoneCircle {
    double x = 0, y = 0;
    double outer_radius = 0, inner_radius = 0;
    double width = 0; ///< outer - inner radius
    /// width minus a proven lower bound of the local optimum: first-order bound over the control
    /// points, at the centre given. At most 1e-12 max(outer radius, largest |coordinate|).
    double gap = 0;
    /// Two outer, two inner, interlaced around the centre: what proves the optimum. Of three
    /// points, which a circle meets exactly, one stands twice.
    std::vector<ControlPoint> control_points;
    bool wide = false; ///< width > 0.1 R: other, narrower optima may exist
    /// The zone tends to a strip: its radius was held at a million times the extent of the points.
    bool strip = false;
    ZoneSearch search = ZoneSearch::local;
};

struct PlainCircle {
    double x = 0, y = 0, radius = 0;
};

/// ISO 230-4 least squares circle: least sum of squared orthogonal distances (no algebraic fit),
/// robust on arcs of any length. Three distinct points are met exactly.
/// Accuracy: NIST's 30 reference pairs to 1e-10.
/// @errors Fault::bad_case, field "points" (or "points[i]"): fewer than three distinct points,
/// points on a line, not finite, beyond 1e12.
Result<LeastSquaresCircle> fit_least_squares_circle(std::span<const double> x,
                                                    std::span<const double> y);

/// ISO 230-4 minimum zone circle: the narrowest ring between two concentric circles that holds
/// every point. Errors as above.
Result<MinimumZoneCircle> fit_minimum_zone_circle(std::span<const double> x,
                                                  std::span<const double> y);

/// The smallest circle that holds every point. Errors as above.
Result<PlainCircle> fit_minimum_circumscribed_circle(std::span<const double> x,
                                                     std::span<const double> y);

/// The largest circle that holds no point and whose centre is surrounded by the points it
/// touches. Errors as above, and Fault::bad_case, field "maximum_inscribed", where the points
/// surround no centre (arcs up to about 180 deg).
Result<PlainCircle> fit_maximum_inscribed_circle(std::span<const double> x,
                                                 std::span<const double> y);

/// 360 deg minus the largest angular gap between neighbouring points, seen from (center_x,
/// center_y): the least squares centre, by convention.
double arc_of_points_deg(std::span<const double> x,
                         std::span<const double> y,
                         double center_x,
                         double center_y);

} // namespace axiscal
