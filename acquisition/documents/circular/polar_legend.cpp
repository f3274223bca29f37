// What the signs of a polar plot mean, and its magnification.

#include "acquisition/documents/circular/polar_plot.hpp"
#include "acquisition/documents/circular/polar_signs.hpp"
#include "acquisition/documents/pdf/wording.hpp"

#include <cmath>

namespace axiscal {
namespace {

/// Items one after another, wrapped.
class LegendLine {
public:
    LegendLine(Canvas& canvas, PageBox box)
        : canvas_{canvas}
        , box_{box}
        , at_{box.x, box.y + 7} {}
    /// @returns where the sign of the next item is drawn: its left end, half way up its text
    PagePoint next(const std::string& words, double sign_width) {
        constexpr double gap = 10;
        const double text_width = canvas_.width_of(words, style);
        if (at_.x > box_.x && at_.x + sign_width + 3 + text_width > box_.right()) next_line();
        const PagePoint sign{at_.x, at_.y - 2.4};
        canvas_.text({at_.x + sign_width + 3, at_.y}, words, style);
        at_.x += sign_width + 3 + text_width + gap;
        return sign;
    }
    void next_line() { at_ = {box_.x, at_.y + 9.5}; }
    [[nodiscard]] double height() const { return at_.y + 3 - box_.y; }
    static constexpr TextStyle style{6.5};

private:
    Canvas& canvas_;
    PageBox box_;
    PagePoint at_;
};

void tell_traces(Canvas& canvas, LegendLine& legend, const PolarView& view) {
    for (const PolarTrace& trace : view.traces) {
        const bool ccw = trace.sense == Sense::ccw;
        const PagePoint at = legend.next(ccw ? "CCW, counter-clockwise" : "CW, clockwise", 18);
        canvas.line(at, {at.x + 18, at.y}, {colour_of(trace.sense), 1, !ccw});
    }
    const PagePoint start = legend.next("start and sense", 14);
    canvas.dot({start.x + 2, start.y}, 1.7, ink);
    canvas.line({start.x + 2, start.y}, {start.x + 11, start.y}, {ink, 1});
    canvas.pointer({start.x + 11, start.y}, 0, ink, 2.2);
    const PagePoint end = legend.next("end", 3);
    canvas.line({end.x + 1.5, end.y - 2}, {end.x + 1.5, end.y + 2}, {ink, 1.1});
    if (view.overshoot_deg.value_or(0) <= 0) return;
    const PagePoint over = legend.next("overshoot", 12);
    canvas.line(over, {over.x + 12, over.y}, {ink, 0.4});
}

void tell_circles(Canvas& canvas, LegendLine& legend, const PolarView& view) {
    const PagePoint base = legend.next(
        view.base_mm == 0 ? "nominal circle"
                          : "nominal circle " + std::string{view.base_mm < 0 ? "\u2212" : "+"} +
                                " " + fixed(std::fabs(view.base_mm) * 1e3, 1) + " µm",
        12);
    canvas.line(base, {base.x + 12, base.y}, {grey, 0.9});
    if (!view.zone) return;
    const PagePoint zone = legend.next("minimum zone", 12);
    canvas.area({{zone.x, zone.y - 2.5},
                 {zone.x + 12, zone.y - 2.5},
                 {zone.x + 12, zone.y + 2.5},
                 {zone.x, zone.y + 2.5}},
                zone_tint, zone_opacity);
    canvas.line({zone.x, zone.y - 2.5}, {zone.x + 12, zone.y - 2.5}, {ink, 0.5});
    canvas.line({zone.x, zone.y + 2.5}, {zone.x + 12, zone.y + 2.5}, {ink, 0.5});
    const PagePoint outer = legend.next("control point, outer", 5);
    draw_mark_sign(canvas, {outer.x + 2.5, outer.y}, ZoneSide::outer);
    const PagePoint inner = legend.next("inner", 5);
    draw_mark_sign(canvas, {inner.x + 2.5, inner.y}, ZoneSide::inner);
    const PagePoint cross = legend.next("least squares centre", 6);
    draw_cross(canvas, {cross.x + 3, cross.y}, 2.4, {ink, 0.8});
}

} // namespace

Colour colour_of(Sense sense) {
    return sense == Sense::ccw ? forward_blue : backward_vermilion;
}

void draw_mark_sign(Canvas& canvas, PagePoint at, ZoneSide side) {
    constexpr double mark_radius = 2.2;
    canvas.dot(at, mark_radius, ink);
    if (side == ZoneSide::inner) canvas.dot(at, mark_radius - 0.8, {1, 1, 1});
}

void draw_cross(Canvas& canvas, PagePoint at, double size, Stroke stroke) {
    canvas.line({at.x - size, at.y - size}, {at.x + size, at.y + size}, stroke);
    canvas.line({at.x - size, at.y + size}, {at.x + size, at.y - size}, stroke);
}

double draw_polar_legend(Canvas& canvas, PageBox box, const PolarView& view) {
    const PolarScale scale = polar_place(canvas, box, view).scale;
    LegendLine legend{canvas, {box.x, box.bottom(), box.width, 0}};
    legend.next("1 division = " + division_text(scale.division_mm()) + ", magnification " +
                    magnification_text(scale.magnification) + " (10 mm of paper to a division)",
                -3);
    legend.next_line();
    tell_traces(canvas, legend, view);
    tell_circles(canvas, legend, view);
    return legend.height();
}

} // namespace axiscal
