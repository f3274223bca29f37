#include "acquisition/documents/circular/polar_plot.hpp"

#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/circular/polar_signs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axiscal {
namespace {

constexpr double quarter = whole_turn_rad / 4;
constexpr double rim_pt = 26; ///< around the plot: sense, start and end, names of the axes
constexpr TextStyle ring_style{6}, mark_style{6.5, true}, axis_style{7.5, true};

PagePoint polar(PagePoint centre, double radius, double angle_rad) {
    return {centre.x + radius * std::cos(angle_rad), centre.y - radius * std::sin(angle_rad)};
}

std::vector<PagePoint> arc(PagePoint centre, double radius, double from_rad, double to_rad) {
    const int steps = std::max(2, static_cast<int>(std::fabs(to_rad - from_rad) / one_degree_rad));
    std::vector<PagePoint> points;
    points.reserve(static_cast<std::size_t>(steps) + 1);
    for (int i = 0; i <= steps; ++i)
        points.push_back(polar(centre, radius, from_rad + (to_rad - from_rad) * i / steps));
    return points;
}

/// Keeps numbers apart: the first of some places that overlaps none taken before.
class LabelPlaces {
public:
    bool take(PageBox box) {
        for (const PageBox& other : taken_)
            if (box.x < other.right() && other.x < box.right() && box.y < other.bottom() &&
                other.y < box.bottom())
                return false;
        taken_.push_back(box);
        return true;
    }

private:
    std::vector<PageBox> taken_;
};

// ---- rings and spokes -------------------------------------------------------------------------

/// Whole divisions about the base circle that lie inside the plot and outside its middle.
std::vector<int> divisions_of(const PolarScale& scale) {
    constexpr double middle_pt = 6;
    std::vector<int> whole;
    constexpr int most = 40;
    for (int k = -most; k <= most; ++k) {
        const double radius = scale.radius_pt(k * scale.division_mm());
        if (radius > middle_pt && radius <= scale.plot_pt + 0.01) whole.push_back(k);
    }
    return whole;
}

std::string ring_text(int k, double division_mm) {
    if (k == 0) return "0";
    const std::string words = division_text(std::abs(k) * division_mm);
    return (k < 0 ? "\u2212" : "+") + words.substr(0, words.find(' '));
}

void draw_spokes(Canvas& canvas, const PolarPlace& place) {
    for (int i = 0; i < 8; ++i) {
        const double angle = i * quarter / 2;
        canvas.line(place.centre, polar(place.centre, place.scale.plot_pt, angle),
                    {i % 2 == 0 ? grey : pale, i % 2 == 0 ? 0.35 : 0.4});
    }
}

void draw_rings(Canvas& canvas, const PolarPlace& place) {
    const PolarScale& scale = place.scale;
    const double half = scale.division_mm() / 2;
    for (const int k : divisions_of(scale)) {
        canvas.ring(place.centre, scale.radius_pt(k * scale.division_mm()), {pale, 0.6});
        const double between = scale.radius_pt(k * scale.division_mm() + half);
        if (between < scale.plot_pt) canvas.ring(place.centre, between, {pale, 0.25});
    }
    canvas.ring(place.centre, scale.base_pt, {grey, 0.9});
    canvas.ring(place.centre, scale.plot_pt, {grey, 0.5});
}

/// The middle of an octant that lies farthest from every control point.
double label_spoke(const PolarPlace& place, const PolarView& view) {
    double best = 0, widest = -1;
    for (const double octant : {2.5, 3.5, 6.5, 7.5, 1.5, 4.5, 5.5, 8.5}) {
        const double angle = (octant - 1) * quarter / 2;
        double nearest = place.scale.plot_pt;
        for (const int k : divisions_of(place.scale)) {
            const PagePoint at =
                polar(place.centre, place.scale.radius_pt(k * place.scale.division_mm()), angle);
            for (const PolarMark& mark : view.marks) {
                const PagePoint to = place.at(mark.at);
                nearest = std::min(nearest, std::hypot(to.x - at.x, to.y - at.y));
            }
        }
        constexpr double clearly = 3; // points; else the first, upper right of the second axis
        if (nearest > widest + clearly) {
            widest = nearest;
            best = angle;
        }
    }
    return best;
}

void draw_ring_labels(Canvas& canvas,
                      const PolarPlace& place,
                      const PolarView& view,
                      LabelPlaces& labels) {
    constexpr double height = 7;
    const double spoke = label_spoke(place, view);
    for (const int k : divisions_of(place.scale)) {
        const std::string words = ring_text(k, place.scale.division_mm());
        const double width = canvas.width_of(words, ring_style) + 2;
        const PagePoint at =
            polar(place.centre, place.scale.radius_pt(k * place.scale.division_mm()), spoke);
        const PageBox box{at.x - width / 2, at.y - height / 2, width, height};
        if (!labels.take(box)) continue;
        canvas.text({at.x, at.y + 2.2}, words, ring_style, Align::centre);
    }
}

void draw_axis_names(Canvas& canvas, const PolarPlace& place, const AxisNames& axes) {
    constexpr double away = 12;
    const double radius = place.scale.plot_pt + away;
    const std::array<std::string, 4> names{"+" + axes[0], "+" + axes[1], "\u2212" + axes[0],
                                           "\u2212" + axes[1]};
    constexpr std::array sides{Align::left, Align::centre, Align::right, Align::centre};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const PagePoint at = polar(place.centre, radius, static_cast<double>(i) * quarter);
        const double lower = i == 1 ? 0 : i == 3 ? 5.4 : 2.7;
        canvas.text({at.x, at.y + lower}, names[i], axis_style, sides[i]);
    }
}

// ---- what was measured ------------------------------------------------------------------------

void draw_zone(Canvas& canvas, const PolarPlace& place, const PolarView& view) {
    if (!view.zone) return;
    const double outer = place.scale.radius_pt(view.zone->outer_mm - view.base_mm);
    const double inner = place.scale.radius_pt(view.zone->inner_mm - view.base_mm);
    std::vector<PagePoint> border = arc(place.centre, outer, 0, whole_turn_rad);
    const std::vector<PagePoint> hole = arc(place.centre, inner, whole_turn_rad, 0);
    border.insert(border.end(), hole.begin(), hole.end());
    canvas.area(border, zone_tint, zone_opacity);
    canvas.ring(place.centre, outer, {ink, 0.5});
    canvas.ring(place.centre, inner, {ink, 0.5});
}

/// Readings far apart are joined along the circle: a chord would cut inward.
std::vector<PagePoint> line_through(const PolarPlace& place, const std::vector<PolarPoint>& piece) {
    constexpr double longest = 2 * one_degree_rad;
    std::vector<PagePoint> line;
    line.reserve(piece.size());
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const PolarPoint& to = piece[i];
        const PolarPoint& from = piece[i == 0 ? 0 : i - 1];
        const double step = std::remainder(to.angle_rad - from.angle_rad, whole_turn_rad);
        const int parts = 1 + static_cast<int>(std::fabs(step) / longest);
        for (int part = 1; part <= parts; ++part) {
            const double share = static_cast<double>(part) / parts;
            line.push_back(
                place.at({from.angle_rad + step * share,
                          from.deviation_mm + (to.deviation_mm - from.deviation_mm) * share}));
        }
    }
    return line;
}

void draw_trace(Canvas& canvas, const PolarPlace& place, const PolarTrace& trace) {
    const Stroke stroke{colour_of(trace.sense), 0.8, trace.sense == Sense::cw};
    for (const auto& piece : trace.pieces) {
        const std::vector<PagePoint> line = line_through(place, piece);
        if (line.size() == 1) canvas.dot(line.front(), 0.8, stroke.colour);
        canvas.polyline(line, stroke);
    }
}

/// One rim inside the other where both senses are drawn.
double rim_of(const PolarPlace& place, const PolarView& view, const PolarTrace& trace) {
    constexpr double nearest = 3.5, apart = 4.5;
    const bool second = view.traces.size() > 1 && trace.sense == Sense::cw;
    return place.scale.plot_pt + nearest + (second ? apart : 0);
}

void draw_sense(Canvas& canvas,
                const PolarPlace& place,
                const PolarView& view,
                const PolarTrace& trace) {
    constexpr double shaft = 24 * one_degree_rad, most_overshoot = 30 * one_degree_rad, bar = 2;
    const Colour colour = colour_of(trace.sense);
    const double radius = rim_of(place, view, trace), sign = sign_of(trace.sense);
    const double overshoot =
        std::min(view.overshoot_deg.value_or(0) * one_degree_rad, most_overshoot);
    if (overshoot > 0) {
        canvas.polyline(
            arc(place.centre, radius, trace.start_rad - sign * overshoot, trace.start_rad),
            {colour, 0.4});
        canvas.polyline(arc(place.centre, radius, trace.end_rad, trace.end_rad + sign * overshoot),
                        {colour, 0.4});
    }
    const double head = trace.start_rad + sign * shaft;
    canvas.polyline(arc(place.centre, radius, trace.start_rad, head), {colour, 1});
    canvas.pointer(polar(place.centre, radius, head), head + sign * quarter, colour, 2.2);
    canvas.dot(polar(place.centre, radius, trace.start_rad), 1.7, colour);
    canvas.line(polar(place.centre, radius - bar, trace.end_rad),
                polar(place.centre, radius + bar, trace.end_rad), {colour, 1.1});
}

/// Its number beyond the ring it holds, or beside it where another number stands.
void draw_mark(Canvas& canvas,
               const PolarPlace& place,
               const PolarMark& mark,
               LabelPlaces& labels) {
    const PagePoint at = place.at(mark.at);
    draw_mark_sign(canvas, at, mark.side);
    const std::string words = std::to_string(mark.number);
    const double width = canvas.width_of(words, mark_style) + 1, height = 7;
    const double outward = mark.side == ZoneSide::outer ? 1 : -1;
    constexpr double away = 7.5;
    for (int step = 0; step < 16; ++step) {
        const int places_aside = (step + 1) / 2 * (step % 2 == 0 ? 1 : -1); // 0 -1 1 -2 2 ...
        const double shift = places_aside * away;
        const PagePoint by = polar({0, 0}, away * outward, mark.at.angle_rad);
        const PagePoint along = polar({0, 0}, shift, mark.at.angle_rad + quarter);
        const PagePoint middle{at.x + by.x + along.x, at.y + by.y + along.y};
        if (!labels.take({middle.x - width / 2, middle.y - height / 2, width, height})) continue;
        canvas.text({middle.x, middle.y + 2.4}, words, mark_style, Align::centre);
        return;
    }
}

/// Magnified like the traces; where it would leave the middle it is told in numbers alone.
void draw_fitted_centre(Canvas& canvas, const PolarPlace& place, const PolarView& view) {
    const double radius = view.fitted.deviation_mm * place.scale.magnification * points_per_mm;
    if (radius > place.scale.base_pt) return;
    draw_cross(canvas, polar(place.centre, radius, view.fitted.angle_rad), 2.4, {ink, 0.8});
}

} // namespace

PagePoint PolarPlace::at(const PolarPoint& point) const {
    return polar(centre, scale.radius_pt(point.deviation_mm - base_mm), point.angle_rad);
}

PolarPlace polar_place(Canvas& canvas, PageBox box, const PolarView& view) {
    const double name = canvas.width_of("+" + view.axes[0], axis_style) + 14;
    const double radius = std::min(box.width / 2 - std::max(rim_pt, name), box.height / 2 - rim_pt);
    return {{box.x + box.width / 2, box.y + box.height / 2},
            polar_scale(radius, view.low_mm - view.base_mm, view.high_mm - view.base_mm),
            view.base_mm};
}

void draw_polar_plot(Canvas& canvas, PageBox box, const PolarView& view) {
    const PolarPlace place = polar_place(canvas, box, view);
    LabelPlaces labels;
    draw_spokes(canvas, place);
    draw_zone(canvas, place, view);
    draw_rings(canvas, place);
    draw_axis_names(canvas, place, view.axes);
    for (const PolarTrace& trace : view.traces) {
        draw_trace(canvas, place, trace);
        draw_sense(canvas, place, view, trace);
    }
    draw_ring_labels(canvas, place, view, labels);
    draw_fitted_centre(canvas, place, view);
    for (const PolarMark& mark : view.marks)
        draw_mark(canvas, place, mark, labels);
}

} // namespace axiscal
