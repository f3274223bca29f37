#include "acquisition/documents/circular/polar_view.hpp"

#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/pdf/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace axiscal {
namespace {

/// Difference of two angles within (-180, 180] deg.
double difference(double from, double to) {
    const double d = folded_angle(to - from);
    return d > std::numbers::pi ? d - whole_turn_rad : d;
}

/// In the order driven where the angles tell one; by angle elsewhere.
std::vector<PolarPoint> in_order(const CircularTrace& about) {
    std::vector<PolarPoint> points;
    points.reserve(about.angle_rad.size());
    for (std::size_t i = 0; i < about.angle_rad.size(); ++i)
        points.push_back({about.angle_rad[i], about.radial_deviation_mm[i]});
    std::size_t forward = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        forward += difference(points[i - 1].angle_rad, points[i].angle_rad) > 0;
    const std::size_t steps = points.size() - 1;
    if (forward == steps || forward == 0) return points;
    for (PolarPoint& point : points)
        point.angle_rad = folded_angle(point.angle_rad);
    std::ranges::sort(points, {}, &PolarPoint::angle_rad);
    return points;
}

/// The widest step that a line bridges: 5 deg or twice the median step, as a full circle has it.
double widest_step(const std::vector<PolarPoint>& points) {
    std::vector<double> steps;
    steps.reserve(points.size());
    for (std::size_t i = 1; i < points.size(); ++i)
        steps.push_back(std::fabs(difference(points[i - 1].angle_rad, points[i].angle_rad)));
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    constexpr double slack = 1 + 1e-9; // even steps
    return slack * std::max(5 * one_degree_rad, 2 * *middle);
}

std::vector<std::vector<PolarPoint>> pieces_of(const std::vector<PolarPoint>& points) {
    const double widest = widest_step(points);
    std::vector<std::vector<PolarPoint>> pieces{{points.front()}};
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (std::fabs(difference(points[i - 1].angle_rad, points[i].angle_rad)) > widest)
            pieces.emplace_back();
        pieces.back().push_back(points[i]);
    }
    return pieces;
}

/// First, least, greatest and last of each tenth of a degree, in their order.
std::vector<PolarPoint> thinned(const std::vector<PolarPoint>& points) {
    constexpr double bin = 0.1 * one_degree_rad;
    std::vector<PolarPoint> kept;
    std::size_t first = 0;
    while (first < points.size()) {
        const double sector = std::floor(points[first].angle_rad / bin);
        std::size_t last = first, least = first, greatest = first;
        for (std::size_t i = first;
             i < points.size() && std::floor(points[i].angle_rad / bin) == sector; ++i) {
            last = i;
            if (points[i].deviation_mm < points[least].deviation_mm) least = i;
            if (points[i].deviation_mm > points[greatest].deviation_mm) greatest = i;
        }
        std::array<std::size_t, 4> chosen{first, least, greatest, last};
        std::ranges::sort(chosen);
        for (std::size_t k = 0; k < chosen.size(); ++k)
            if (k == 0 || chosen[k] != chosen[k - 1]) kept.push_back(points[chosen[k]]);
        first = last + 1;
    }
    return kept;
}

/// A full circle is drawn closed.
void close_up(PolarTrace& trace, const std::vector<PolarPoint>& points) {
    if (trace.pieces.size() != 1) return;
    const double gap = std::fabs(difference(points.back().angle_rad, points.front().angle_rad));
    const double travelled = std::fabs(points.back().angle_rad - points.front().angle_rad);
    if (travelled > std::numbers::pi && gap <= widest_step(points))
        trace.pieces.front().push_back(trace.pieces.front().front());
}

PolarTrace
trace_about(const CircularTrace& trace, const CircularTest& test, const PolarView& view) {
    const CircularTrace about = centred(trace, test.nominal_radius_mm, view.x_mm, view.y_mm);
    const std::vector<PolarPoint> points = in_order(about);
    PolarTrace out;
    out.sense = trace.sense;
    out.start_rad = trace.angle_rad.front();
    out.end_rad = trace.angle_rad.back();
    out.pieces = pieces_of(points);
    close_up(out, points);
    for (auto& piece : out.pieces)
        piece = thinned(piece);
    return out;
}

void take_extremes(PolarView& view) {
    view.low_mm = std::numeric_limits<double>::max();
    view.high_mm = std::numeric_limits<double>::lowest();
    for (const PolarTrace& trace : view.traces)
        for (const auto& piece : trace.pieces)
            for (const PolarPoint& point : piece) {
                view.low_mm = std::min(view.low_mm, point.deviation_mm);
                view.high_mm = std::max(view.high_mm, point.deviation_mm);
            }
}

/// The nominal circle, unless it would take more than two thirds of the plot.
double base_of(const PolarView& view, const FittedCircle& fitted) {
    const double form = view.high_mm - view.low_mm;
    const double farthest = std::max(std::fabs(view.low_mm), std::fabs(view.high_mm));
    return farthest > 2 * form ? fitted.radius_mm : 0;
}

void take_marks(PolarView& view, const ZoneRing& ring, const CircularTest& test) {
    int number = 0;
    for (const RingPoint& point : ring.control_points) {
        const CircularTrace* trace = test.find(point.sense);
        const CircularTrace held{point.sense,
                                 {trace->angle_rad[point.index]},
                                 {trace->radial_deviation_mm[point.index]}};
        const CircularTrace about = centred(held, test.nominal_radius_mm, view.x_mm, view.y_mm);
        view.marks.push_back({{folded_angle(held.angle_rad[0]), about.radial_deviation_mm[0]},
                              point.sense,
                              point.side,
                              ++number});
    }
}

PolarView view_of(const CircularCertificate& certificate,
                  const CircularDeviation& G,
                  const std::vector<const CircularTrace*>& traces) {
    const CircularTest& test = certificate.measured.test;
    PolarView view;
    view.axes = certificate.measured.axes;
    view.overshoot_deg = certificate.measured.conditions.overshoot_deg;
    view.about_zone = !G.ring.beyond_set_up;
    if (view.about_zone) {
        view.x_mm = G.ring.x_mm;
        view.y_mm = G.ring.y_mm;
        view.zone = PolarZone{G.ring.outer_mm, G.ring.inner_mm};
        take_marks(view, G.ring, test);
    }
    for (const CircularTrace* trace : traces)
        view.traces.push_back(trace_about(*trace, test, view));
    const double dx = G.fitted.x_mm - view.x_mm, dy = G.fitted.y_mm - view.y_mm;
    view.fitted = {std::atan2(dy, dx), std::hypot(dx, dy)};
    take_extremes(view);
    view.base_mm = base_of(view, G.fitted);
    return view;
}

} // namespace

PolarView polar_view_of(const CircularCertificate& certificate, Sense sense) {
    return view_of(certificate, certificate.parameters.of(sense)->G,
                   {certificate.measured.test.find(sense)});
}

PolarView polar_view_of_both(const CircularCertificate& certificate) {
    std::vector<const CircularTrace*> traces;
    for (const CircularTrace& trace : certificate.measured.test.traces)
        traces.push_back(&trace);
    if (!certificate.parameters.G_b) return polar_view_of(certificate, traces.front()->sense);
    return view_of(certificate, *certificate.parameters.G_b, traces);
}

double round_down_125(double value) {
    constexpr double slack = 1 + 1e-9; // 2 stays 2 whatever its last bit
    double decade = std::pow(10.0, std::floor(std::log10(value)));
    if (decade * 10 <= value * slack) decade *= 10;
    for (const double step : {5.0, 2.0})
        if (step * decade <= value * slack) return step * decade;
    return decade;
}

double PolarScale::radius_pt(double above_base_mm) const {
    return base_pt + above_base_mm * magnification * points_per_mm;
}

PolarScale polar_scale(double plot_radius_pt, double low_mm, double high_mm) {
    constexpr double base_share = 0.55, inward_share = 0.85, rim_pt = 3, greatest = 1e5;
    PolarScale scale;
    scale.plot_pt = plot_radius_pt;
    scale.base_pt = base_share * plot_radius_pt;
    const double outward = plot_radius_pt - scale.base_pt - rim_pt;
    const double inward = inward_share * scale.base_pt;
    double most = greatest;
    if (high_mm > 0) most = std::min(most, outward / (high_mm * points_per_mm));
    if (low_mm < 0) most = std::min(most, inward / (-low_mm * points_per_mm));
    scale.magnification = round_down_125(most);
    return scale;
}

std::string magnification_text(double magnification) {
    std::array<char, 32> text{};
    if (magnification >= 1)
        std::snprintf(text.data(), text.size(), "%.0f:1", magnification);
    else
        std::snprintf(text.data(), text.size(), "1:%.0f", 1 / magnification);
    return text.data();
}

std::string division_text(double division_mm) {
    constexpr double micrometres = 1e3;
    std::array<char, 32> text{};
    const bool large = division_mm >= 1;
    std::snprintf(text.data(), text.size(), "%.12g %s",
                  large ? division_mm : division_mm * micrometres, large ? "mm" : "µm");
    return text.data();
}

} // namespace axiscal
