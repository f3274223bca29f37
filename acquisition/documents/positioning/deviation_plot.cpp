#include "acquisition/documents/pdf/plot_frame.hpp"
#include "acquisition/documents/pdf/plots.hpp"

#include <algorithm>
#include <limits>

namespace axiscal {
namespace {

/// One direction in paper units.
struct DirectionCurve {
    std::vector<double> targets, means, half_bands; ///< half_bands empty for n = 1
    const std::vector<std::vector<double>>* points = nullptr;
    double factor = 1;
    Colour colour;
    double arrow = 1;
    bool dashed = false;
};

DirectionCurve curve_of(const Certificate& certificate, Direction direction, double factor) {
    const bool forward = direction == Direction::positive;
    DirectionCurve curve;
    curve.points = forward ? &certificate.deviations.forward() : &certificate.deviations.backward();
    curve.factor = factor;
    curve.colour = forward ? forward_blue : backward_vermilion;
    curve.arrow = forward ? 1 : -1;
    curve.dashed = !forward;
    for (const PositionRow& row : certificate.result.positions) {
        const auto& s = forward ? row.s_forward : row.s_backward;
        curve.targets.push_back(row.target);
        curve.means.push_back((forward ? row.mean_forward : row.mean_backward.value_or(0)) *
                              factor);
        if (s) curve.half_bands.push_back(certificate.result.cover_factor * *s * factor);
    }
    if (curve.half_bands.size() != curve.means.size()) curve.half_bands.clear();
    return curve;
}

std::vector<DirectionCurve> curves_of(const Certificate& certificate, double factor) {
    std::vector<DirectionCurve> curves{curve_of(certificate, Direction::positive, factor)};
    if (!certificate.deviations.backward().empty())
        curves.push_back(curve_of(certificate, Direction::negative, factor));
    return curves;
}

Ticks deviation_ticks(const std::vector<DirectionCurve>& curves,
                      const std::vector<SetAside>& set_aside,
                      double factor) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    const auto take = [&](double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    };
    for (const DirectionCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.means.size(); ++i) {
            const double half = curve.half_bands.empty() ? 0 : curve.half_bands[i];
            take(curve.means[i] - half);
            take(curve.means[i] + half);
        }
        for (const auto& row : *curve.points)
            for (const double value : row)
                take(value * curve.factor);
    }
    for (const SetAside& reading : set_aside)
        take(reading.deviation * factor);
    const double span = high - low;
    if (low > 0 && low < 2 * span) low = 0; // show zero unless it would flatten the curves
    if (high < 0 && -high < 2 * span) high = 0;
    return ticks_around(low, high, 6, 0.5);
}

std::vector<PagePoint>
trace(const PlotFrame& frame, const DirectionCurve& curve, double half_bands) {
    std::vector<PagePoint> points;
    for (std::size_t i = 0; i < curve.means.size(); ++i) {
        const double shift = half_bands == 0 ? 0 : half_bands * curve.half_bands[i];
        points.push_back({frame.px(curve.targets[i]), frame.py(curve.means[i] + shift)});
    }
    return points;
}

void draw_band(Canvas& canvas, const PlotFrame& frame, const DirectionCurve& curve) {
    if (curve.half_bands.empty()) return;
    const std::vector<PagePoint> upper = trace(frame, curve, 1), lower = trace(frame, curve, -1);
    std::vector<PagePoint> border = upper;
    border.insert(border.end(), lower.rbegin(), lower.rend());
    canvas.area(border, curve.colour, 0.14);
    canvas.polyline(upper, {curve.colour, 0.35});
    canvas.polyline(lower, {curve.colour, 0.35});
}

void draw_curve(Canvas& canvas, const PlotFrame& frame, const DirectionCurve& curve) {
    const double spacing =
        frame.box.width / static_cast<double>(std::max<std::size_t>(1, curve.targets.size()));
    for (std::size_t i = 0; i < curve.points->size(); ++i)
        for (const double value : (*curve.points)[i])
            canvas.dot({frame.px(curve.targets[i]), frame.py(value * curve.factor)},
                       std::clamp(spacing * 0.06, 0.7, 1.3), curve.colour, 0.4);
    canvas.polyline(trace(frame, curve, 0), {curve.colour, 1.1, curve.dashed});
    for (const PagePoint& at : trace(frame, curve, 0))
        canvas.arrow(at, curve.arrow, curve.colour, std::clamp(spacing * 0.22, 1.3, 2.6));
}

/// Readings that no figure uses: a cross, the excluded ones in a ring.
void draw_set_aside(Canvas& canvas,
                    const PlotFrame& frame,
                    const Certificate& certificate,
                    double factor) {
    constexpr double arm = 2.2;
    for (const SetAside& reading : certificate.set_aside) {
        const auto target = static_cast<std::size_t>(reading.planned.target_index);
        const Colour colour =
            reading.planned.direction == Direction::positive ? forward_blue : backward_vermilion;
        const double x = frame.px(certificate.planned_targets[target]),
                     y = frame.py(reading.deviation * factor);
        canvas.line({x - arm, y - arm}, {x + arm, y + arm}, {colour, 0.8});
        canvas.line({x - arm, y + arm}, {x + arm, y - arm}, {colour, 0.8});
        if (!reading.superseded) canvas.box({x - arm, y - arm, 2 * arm, 2 * arm}, {colour, 0.8});
    }
}

std::string legend_of_points(const Certificate& certificate) {
    const auto replaced = std::ranges::count(certificate.set_aside, true, &SetAside::superseded);
    const auto excluded = std::ssize(certificate.set_aside) - replaced;
    std::string words;
    if (certificate.result.approaches > 1) words = "faint points: every single deviation";
    const auto add = [&words](const std::string& more) {
        words += (words.empty() ? "" : ";  ") + more;
    };
    if (replaced > 0) add("×: replaced (" + std::to_string(replaced) + ")");
    if (excluded > 0) add("boxed ×: excluded (" + std::to_string(excluded) + ")");
    return words;
}

/// Right-aligned on one line; returns where it begins.
double draw_legend(Canvas& canvas,
                   const std::vector<DirectionCurve>& curves,
                   PagePoint right_end,
                   double cover_factor) {
    double x = right_end.x;
    for (std::size_t i = curves.size(); i-- > 0;) {
        const DirectionCurve& curve = curves[i];
        std::string words = curve.arrow > 0 ? "forward ↑: mean" : "backward ↓: mean";
        if (!curve.half_bands.empty()) words += " ±" + fixed(cover_factor, 0) + "s";
        x -= canvas.text({x, right_end.y}, words, label_style, Align::right) + 4;
        const double y = right_end.y - 2.6;
        canvas.line({x - 24, y}, {x, y}, {curve.colour, 1.1, curve.dashed});
        canvas.arrow({x - 12, y}, curve.arrow, curve.colour);
        x -= 24 + 14;
    }
    return x;
}

} // namespace

void draw_deviation_plot(Canvas& canvas, PageBox box, const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const auto curves = curves_of(certificate, units.deviation_factor);
    const auto [low, high] = std::ranges::minmax(certificate.planned_targets);
    PlotFrame frame = frame_along(low, high, 0.025);
    frame.y = deviation_ticks(curves, certificate.set_aside, units.deviation_factor);
    const double labels = widest(canvas, frame.y) + 6;
    frame.box = {box.x + labels, box.y + 13, box.width - labels - 8, box.height - 13 - 22};
    draw_columns(canvas, frame, true);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    for (const DirectionCurve& curve : curves)
        draw_band(canvas, frame, curve);
    for (const DirectionCurve& curve : curves)
        draw_curve(canvas, frame, curve);
    draw_set_aside(canvas, frame, certificate, units.deviation_factor);
    canvas.text({box.x, box.y + 8}, "Deviation (actual − target), " + units.deviation, {7.5, true});
    draw_legend(canvas, curves, {frame.box.right(), box.y + 8}, certificate.result.cover_factor);
    canvas.text({frame.box.right(), box.bottom() - 2}, "Target position, " + units.position,
                label_style, Align::right);
    if (const std::string words = legend_of_points(certificate); !words.empty())
        canvas.text({frame.box.x, box.bottom() - 2}, words, {7, false, grey});
}

} // namespace axiscal
