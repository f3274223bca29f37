#include "acquisition/documents/straightness/across_plot.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace axiscal {
namespace {

constexpr double least_span_across_um = 0.05; ///< noise is never magnified beyond this
constexpr double room_of_targets = 24;

std::vector<PagePoint> points_of_curve(const AcrossCurve& curve, const PlotFrame& frame) {
    std::vector<PagePoint> points;
    for (std::size_t i = 0; i < curve.values_um.size(); ++i)
        points.push_back({frame.px(curve.targets_mm[i]), frame.py(curve.values_um[i])});
    return points;
}

void draw_one_across(Canvas& canvas, const PlotFrame& frame, const AcrossCurve& curve) {
    const std::vector<PagePoint> points = points_of_curve(curve, frame);
    canvas.polyline(points, curve.stroke);
    for (const PagePoint& point : points) {
        if (curve.arrow != 0) canvas.arrow(point, curve.arrow, curve.stroke.colour, 2);
        if (curve.dotted) canvas.dot(point, 1.8, curve.stroke.colour);
    }
}

/// Right-aligned on one line above the frame.
void draw_names_of_curves(Canvas& canvas,
                          PagePoint right_end,
                          const std::vector<AcrossCurve>& curves) {
    constexpr double sample = 18, gap = 8;
    double x = right_end.x;
    for (std::size_t i = curves.size(); i-- > 0;) {
        x -= canvas.text({x, right_end.y}, curves[i].words, tick_style, Align::right) + 3;
        canvas.line({x - sample, right_end.y - 2.4}, {x, right_end.y - 2.4}, curves[i].stroke);
        x -= sample + gap;
    }
}

} // namespace

AcrossCurve across_curve_of(std::string words, const MeasuredLine& line) {
    AcrossCurve curve{std::move(words), {}, line.deviations, {ink, 1.1}};
    for (const double position_um : line.positions)
        curve.targets_mm.push_back(position_um / um_in_a_mm_across);
    return curve;
}

AcrossCurve
across_curve_of(std::string words, const ReferenceLine& reference, const MeasuredLine& line) {
    AcrossCurve curve{std::move(words), {}, {}, {ink, 0.8}};
    for (const double position_um : {line.positions.front(), line.positions.back()}) {
        curve.targets_mm.push_back(position_um / um_in_a_mm_across);
        curve.values_um.push_back(reference.offset + reference.slope * position_um);
    }
    return curve;
}

PlotFrame frame_of_across(const std::vector<AcrossCurve>& curves) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const AcrossCurve& curve : curves) {
        const auto [least, greatest] = std::ranges::minmax(curve.values_um);
        low = std::min(low, least);
        high = std::max(high, greatest);
    }
    const auto& targets = curves.front().targets_mm;
    PlotFrame frame = frame_along(targets.front(), targets.back(), 0.03);
    frame.y = ticks_around(low, high, 5, least_span_across_um);
    return frame;
}

void place_across_frame(Canvas& canvas, PlotFrame& frame, PageBox box, double right) {
    constexpr double title = 14;
    const double labels = widest(canvas, frame.y) + 6;
    frame.box = {box.x + labels, box.y + title, box.width - labels - right,
                 box.height - title - room_of_targets};
}

void draw_across_curves(Canvas& canvas,
                        PageBox box,
                        const PlotFrame& frame,
                        const std::vector<AcrossCurve>& curves,
                        const std::string& title) {
    canvas.text({box.x, box.y + 8}, title, {7.5, true});
    draw_columns(canvas, frame, true);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    for (const AcrossCurve& curve : curves)
        draw_one_across(canvas, frame, curve);
    draw_names_of_curves(canvas, {box.right(), box.y + 8}, curves);
    canvas.text({frame.box.right(), box.bottom() - 3}, "Target position, mm", label_style,
                Align::right);
}

} // namespace axiscal
