// ISO 230-4 figures. With R the nominal radius, dr the reading at the nominal angle theta:
//
//   G       least width of a ring of two concentric circles that holds the path of one sense;
//           beside it max - min radius about the least squares centre
//   G(b)    the same of both paths together
//   F       radius about a stated centre - R: the largest and the smallest, of one sense
//   D       radius of the least squares circle of both paths - R

#include "analysis/circular/circular_parameters.hpp"

#include "analysis/circle/circle_fit.hpp"
#include "analysis/linear/length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

constexpr double shortest_arc_deg = 90; ///< for what leans on a least squares circle

/// Readings of one or both traces, as the circle fits take them and as they were.
struct Path {
    std::vector<double> x, y, cosine, sine, deviation;
    std::vector<std::pair<Sense, std::size_t>> traces; ///< in their order: sense and readings
    double radius = 0;
    explicit Path(double nominal_radius)
        : radius{nominal_radius} {}
    void add(const Path& other) {
        for (const auto& list : {&Path::x, &Path::y, &Path::cosine, &Path::sine, &Path::deviation})
            (this->*list).insert((this->*list).end(), (other.*list).begin(), (other.*list).end());
        traces.insert(traces.end(), other.traces.begin(), other.traces.end());
    }
    void add(const CircularTrace& trace) {
        traces.emplace_back(trace.sense, trace.angle_rad.size());
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
            const double dr = trace.radial_deviation_mm[i];
            cosine.push_back(std::cos(trace.angle_rad[i]));
            sine.push_back(std::sin(trace.angle_rad[i]));
            deviation.push_back(dr);
            x.push_back((radius + dr) * cosine.back());
            y.push_back((radius + dr) * sine.back());
        }
    }
    [[nodiscard]] RingPoint reading(const ControlPoint& point) const {
        std::size_t index = point.index;
        for (const auto& [sense, readings] : traces) {
            if (index < readings) return {sense, index, point.side};
            index -= readings;
        }
        return {};
    }
};

struct Extremes {
    double low = 0, high = 0, mean = 0;
    [[nodiscard]] double range() const { return high - low; }
};

/// Distance of reading i from (a, b), minus radius. Near the nominal centre by the difference of
/// the squares, (d^2 - radius^2) / (d + radius), in which radius^2 has cancelled exactly; far from
/// it (short arcs alone) as it stands.
double radial_distance(const Path& path, std::size_t i, double a, double b) {
    const double radius = path.radius, dr = path.deviation[i];
    if (a * a + b * b > radius * radius)
        return length_in_plane(path.x[i] - a, path.y[i] - b) - radius;
    const double projected = a * path.cosine[i] + b * path.sine[i];
    const double excess = dr * (2 * radius + dr) - 2 * (radius + dr) * projected + (a * a + b * b);
    return excess / (radius + std::sqrt(std::max(radius * radius + excess, 0.0)));
}

Extremes radii_about(const Path& path, double a, double b) {
    Extremes seen;
    double sum = 0;
    for (std::size_t i = 0; i < path.x.size(); ++i) {
        const double d = radial_distance(path, i, a, b);
        seen.low = i == 0 ? d : std::min(seen.low, d);
        seen.high = i == 0 ? d : std::max(seen.high, d);
        sum += d;
    }
    seen.mean = sum / static_cast<double>(path.x.size());
    return seen;
}

/// What the least squares and the minimum zone circle of one path say.
struct FittedPath {
    LeastSquaresCircle circle;
    Extremes about_least_squares, about_nominal;
    CircularDeviation G;
};

bool same_reading(const RingPoint& a, const RingPoint& b) {
    return a.sense == b.sense && a.index == b.index && a.side == b.side;
}

/// Where an outer and an inner point in one direction alone prove the optimum, the fit names two
/// more that need not touch: they are left out.
ZoneRing ring_of(const Path& path, const MinimumZoneCircle& zone, const Extremes& about_center) {
    ZoneRing ring{zone.x, zone.y, about_center.high, about_center.low, {}, false};
    ring.beyond_set_up = length_in_plane(zone.x, zone.y) > path.radius;
    const double touching = 1e-6 * about_center.range() + 1e-12 * path.radius;
    for (const ControlPoint& point : zone.control_points) {
        const double side = point.side == ZoneSide::outer ? ring.outer_mm : ring.inner_mm;
        const double distance = radial_distance(path, point.index, zone.x, zone.y);
        const RingPoint reading = path.reading(point);
        const bool known = std::ranges::any_of(ring.control_points, [&](const RingPoint& held) {
            return same_reading(held, reading);
        });
        if (!known && std::fabs(distance - side) <= touching)
            ring.control_points.push_back(reading);
    }
    return ring;
}

Result<FittedPath> fit(const Path& path, const std::string& field) {
    const auto circle = fit_least_squares_circle(path.x, path.y);
    if (!circle) return refuse(Fault::bad_case, field, circle.error().detail);
    const auto zone = fit_minimum_zone_circle(path.x, path.y);
    if (!zone) return refuse(Fault::bad_case, field, zone.error().detail);
    FittedPath fitted;
    fitted.circle = *circle;
    fitted.about_least_squares = radii_about(path, circle->x, circle->y);
    fitted.about_nominal = radii_about(path, 0, 0);
    const Extremes about_zone = radii_about(path, zone->x, zone->y);
    fitted.G.ring = ring_of(path, *zone, about_zone);
    fitted.G.minimum_zone_mm = fitted.G.ring.beyond_set_up ? zone->width : about_zone.range();
    fitted.G.fitted = {circle->x, circle->y, fitted.about_least_squares.mean};
    fitted.G.least_squares_mm = fitted.about_least_squares.range();
    fitted.G.gap_mm = zone->gap;
    fitted.G.wide = zone->wide;
    return fitted;
}

Result<RadialDeviation>
radial_deviation(const FittedPath& fitted, const ArcCover& cover, RadialCentre asked) {
    RadialCentre centre = asked;
    if (asked == RadialCentre::automatic)
        centre = cover.full_circle ? RadialCentre::least_squares : RadialCentre::set_up;
    if (centre == RadialCentre::least_squares && cover.arc_deg < shortest_arc_deg)
        return refuse(Fault::bad_case, "f_centre",
                      "no least squares centre over less than 90 deg; use \"set_up\"");
    const Extremes& seen =
        centre == RadialCentre::set_up ? fitted.about_nominal : fitted.about_least_squares;
    return RadialDeviation{seen.high, seen.low, centre};
}

/// Keys in the order of the contract.
constexpr std::array<std::string_view, 8> keys{"G_ccw",     "G_cw",     "G_b",      "F_max_ccw",
                                               "F_min_ccw", "F_max_cw", "F_min_cw", "D"};

std::map<std::string, std::string> reasons_of_absence(const CircularTest& test,
                                                      const ArcCover& cover) {
    std::map<std::string, std::string> reasons;
    for (const std::string_view key : keys) {
        const bool of_ccw = key.ends_with("_ccw"), of_cw = !of_ccw && key.ends_with("_cw");
        const bool measured = of_ccw  ? test.find(Sense::ccw) != nullptr
                              : of_cw ? test.find(Sense::cw) != nullptr
                                      : test.traces.size() == 2;
        if (!measured) reasons[std::string{key}] = "one sense only was measured";
        if (test.source == SignalSource::feedback && !key.starts_with('G'))
            reasons[std::string{key}] =
                "defined for an instrument outside the machine; feedback signals give G_f";
    }
    if (!reasons.contains("D") && cover.arc_deg < shortest_arc_deg)
        reasons["D"] = "least squares radius over less than 90 deg";
    return reasons;
}

Result<void> check_degrees(double value, const char* field) {
    if (!(value >= -100 && value <= 200))
        return refuse(Fault::bad_case, field, "must lie within -100 ... 200 degC");
    return {};
}
Result<void> check_alpha(double value, const char* field) {
    if (!(std::fabs(value) < 1e-3))
        return refuse(Fault::bad_case, field, "must be per kelvin, as 11.5e-6, and below 1e-3");
    return {};
}

} // namespace

std::string_view name_of(RadialCentre centre) {
    switch (centre) {
    case RadialCentre::automatic: return "automatic";
    case RadialCentre::set_up: return "set_up";
    case RadialCentre::least_squares: break;
    }
    return "least_squares";
}

const std::optional<SenseFigures>& CircularParameters::of(Sense sense) const {
    return sense == Sense::ccw ? ccw : cw;
}

Result<double> correction_to_20C_mm(const BarExpansion& bar, double nominal_radius_mm) {
    AXISCAL_CHECK(check_degrees(bar.bar_degC, "temperature.bar_degC"));
    AXISCAL_CHECK(check_degrees(bar.machine_degC, "temperature.machine_degC"));
    AXISCAL_CHECK(check_alpha(bar.bar_alpha_per_K, "temperature.bar_expansion_per_K"));
    AXISCAL_CHECK(check_alpha(bar.machine_alpha_per_K, "temperature.machine_expansion_per_K"));
    if (!(bar.bar_length_mm > 0 && bar.bar_length_mm <= 1e12))
        return refuse(Fault::bad_case, "temperature.bar_length_mm",
                      "must lie above 0 and not beyond 1e12");
    return bar.bar_length_mm * (bar.bar_alpha_per_K * (bar.bar_degC - 20)) -
           nominal_radius_mm * (bar.machine_alpha_per_K * (bar.machine_degC - 20));
}

Result<CircularParameters> evaluate_circular(const CircularTest& test,
                                             RadialCentre f_centre,
                                             const std::optional<BarExpansion>& bar) {
    AXISCAL_CHECK(check_circular_test(test));
    CircularParameters out;
    if (bar) {
        AXISCAL_TRY(out.correction_mm, correction_to_20C_mm(*bar, test.nominal_radius_mm));
    }
    const double correction = out.correction_mm.value_or(0);
    Path both{test.nominal_radius_mm};
    std::vector<double> angles;
    for (std::size_t i = 0; i < test.traces.size(); ++i) {
        const CircularTrace& trace = test.traces[i];
        Path path{test.nominal_radius_mm};
        path.add(trace);
        both.add(path);
        angles.insert(angles.end(), trace.angle_rad.begin(), trace.angle_rad.end());
        AXISCAL_TRY(const FittedPath fitted, fit(path, "traces[" + std::to_string(i) + "]"));
        SenseFigures figures{cover_of(trace.angle_rad), fitted.G, {}};
        AXISCAL_TRY(figures.F, radial_deviation(fitted, figures.cover, f_centre));
        figures.F.max_mm += correction;
        figures.F.min_mm += correction;
        (trace.sense == Sense::ccw ? out.ccw : out.cw) = figures;
    }
    out.cover = cover_of(angles);
    out.not_evaluated = reasons_of_absence(test, out.cover);
    if (test.traces.size() < 2) return out;
    AXISCAL_TRY(const FittedPath fitted, fit(both, "traces"));
    out.G_b = fitted.G;
    if (out.not_evaluated.contains("D")) return out;
    out.D_mm = fitted.about_least_squares.mean + correction;
    out.D_condition = fitted.circle.condition;
    return out;
}

} // namespace axiscal
