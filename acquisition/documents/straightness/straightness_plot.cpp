#include "acquisition/documents/straightness/straightness_plot.hpp"

#include "acquisition/documents/pdf/plot_frame.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"

#include <algorithm>
#include <limits>

namespace axiscal {
namespace {

constexpr double um_in_a_mm = 1000;
constexpr double least_span_across_um = 0.05; ///< noise is never magnified beyond this
constexpr double room_of_targets = 24;

/// One line of values over the targets, mm and um.
struct AcrossCurve {
    std::string words;
    std::vector<double> targets_mm, values_um;
    Stroke stroke;
    double arrow = 0; ///< +1 forward, -1 backward; 0: no marks
};

AcrossCurve curve_of_line(const BudgetedLine& line) {
    AcrossCurve curve{std::string{line.name}, {}, line.found.line.deviations, {ink, 1.1}, 0};
    for (const double position_um : line.found.line.positions)
        curve.targets_mm.push_back(position_um / um_in_a_mm);
    if (line.name == "mean") return curve;
    const bool forward = line.name == "forward";
    curve.stroke = forward ? Stroke{forward_blue, 1.1} : Stroke{backward_vermilion, 1.1, true};
    curve.arrow = forward ? 1 : -1;
    return curve;
}

/// Of two directions they are drawn, of one that alone; the mean of both where it is asked for.
std::vector<AcrossCurve> measured_curves(const StraightnessResult& result, bool with_mean) {
    std::vector<AcrossCurve> curves;
    for (const BudgetedLine& line : result.lines)
        if (line.name != "mean" || (with_mean && result.figures.backward))
            curves.push_back(curve_of_line(line));
    return curves;
}

AcrossCurve curve_of_reference(const StraightnessResult& result, LineReference reference) {
    const StraightnessLine& mean = result.mean().found;
    const ReferenceLine& found = line_against(mean.against, reference);
    AcrossCurve curve{straightness_name_on_paper(name_of(reference)), {}, {}, {grey, 0.7}, 0};
    if (reference == main_reference) curve.stroke = {ink, 0.8};
    if (reference == LineReference::minimum_zone) curve.stroke.dashed = true;
    for (const double position_um : {mean.line.positions.front(), mean.line.positions.back()}) {
        curve.targets_mm.push_back(position_um / um_in_a_mm);
        curve.values_um.push_back(found.offset + found.slope * position_um);
    }
    return curve;
}

/// Every value less that of the main reference line there.
void take_off_reference(AcrossCurve& curve, const ReferenceLine& reference) {
    for (std::size_t i = 0; i < curve.values_um.size(); ++i)
        curve.values_um[i] -= reference.offset + reference.slope * curve.targets_mm[i] * um_in_a_mm;
}

PlotFrame frame_of_curves(const std::vector<AcrossCurve>& curves) {
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

void place_frame(Canvas& canvas, PlotFrame& frame, PageBox box) {
    constexpr double title = 14;
    const double labels = widest(canvas, frame.y) + 6;
    frame.box = {box.x + labels, box.y + title, box.width - labels - room_of_range,
                 box.height - title - room_of_targets};
}

std::vector<PagePoint> points_of_curve(const AcrossCurve& curve, const PlotFrame& frame) {
    std::vector<PagePoint> points;
    for (std::size_t i = 0; i < curve.values_um.size(); ++i)
        points.push_back({frame.px(curve.targets_mm[i]), frame.py(curve.values_um[i])});
    return points;
}

void draw_across_curve(Canvas& canvas, const PlotFrame& frame, const AcrossCurve& curve) {
    const std::vector<PagePoint> points = points_of_curve(curve, frame);
    canvas.polyline(points, curve.stroke);
    if (curve.arrow == 0) return;
    for (const PagePoint& point : points)
        canvas.arrow(point, curve.arrow, curve.stroke.colour, 2);
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

void draw_curves(Canvas& canvas,
                 PageBox box,
                 const PlotFrame& frame,
                 const std::vector<AcrossCurve>& curves,
                 const std::string& title) {
    canvas.text({box.x, box.y + 8}, title, {7.5, true});
    draw_columns(canvas, frame, true);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    for (const AcrossCurve& curve : curves)
        draw_across_curve(canvas, frame, curve);
    draw_names_of_curves(canvas, {box.right(), box.y + 8}, curves);
    canvas.text({frame.box.right(), box.bottom() - 3}, "Target position, mm", label_style,
                Align::right);
}

} // namespace

void draw_straightness_plot(Canvas& canvas, PageBox box, const StraightnessResult& result) {
    std::vector<AcrossCurve> curves = measured_curves(result, false);
    for (const LineReference reference : line_references)
        curves.push_back(curve_of_reference(result, reference));
    PlotFrame frame = frame_of_curves(curves);
    place_frame(canvas, frame, box);
    draw_curves(canvas, box, frame, curves, "Deviation as measured, µm");
}

void draw_straightness_residuals(Canvas& canvas, PageBox box, const StraightnessResult& result) {
    const StraightnessLine& mean = result.mean().found;
    const ReferenceLine& reference = line_against(mean.against, main_reference);
    std::vector<AcrossCurve> curves = measured_curves(result, true);
    for (AcrossCurve& curve : curves)
        take_off_reference(curve, reference);
    PlotFrame frame = frame_of_curves(curves);
    place_frame(canvas, frame, box);
    draw_curves(canvas, box, frame, curves,
                "About the " + reference_on_paper(main_reference) + ", µm");
    const auto [low, high] = std::ranges::minmax_element(reference.residuals);
    const auto point = [&](std::vector<double>::const_iterator at) {
        const auto i = static_cast<std::size_t>(at - reference.residuals.begin());
        return PagePoint{frame.px(mean.line.positions[i] / um_in_a_mm), frame.py(*at)};
    };
    draw_range(canvas, frame,
               {point(low), point(high), straightness_symbol_of(result),
                fixed(reference.straightness, straightness_decimals(result)) + " µm"});
}

} // namespace axiscal
