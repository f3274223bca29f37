#include "acquisition/publish/report/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace axiscal {
namespace {

constexpr TextStyle tick_style{7}, label_style{7.5};

/// Data coordinates to page coordinates.
struct PlotFrame {
    PageBox box;
    double x_low = 0, x_high = 1;
    Ticks x, y;
    [[nodiscard]] double px(double value) const {
        return box.x + (value - x_low) / (x_high - x_low) * box.width;
    }
    [[nodiscard]] double py(double value) const {
        return box.bottom() - (value - y.first) / (y.last - y.first) * box.height;
    }
};

double widest(Canvas& canvas, const Ticks& ticks) {
    double found = 0;
    for (const double value : ticks.all())
        found = std::max(found, canvas.width_of(fixed(value, ticks.decimals), tick_style));
    return found;
}

void draw_rows(Canvas& canvas, const PlotFrame& frame) {
    for (const double value : frame.y.all()) {
        const bool zero = std::abs(value) < frame.y.step * 1e-6;
        canvas.line({frame.box.x, frame.py(value)}, {frame.box.right(), frame.py(value)},
                    {zero ? grey : pale, zero ? 0.7 : 0.4});
        canvas.text({frame.box.x - 4, frame.py(value) + 2.5}, fixed(value, frame.y.decimals),
                    tick_style, Align::right);
    }
}

void draw_columns(Canvas& canvas, const PlotFrame& frame, bool labels) {
    for (const double value : frame.x.all()) {
        canvas.line({frame.px(value), frame.box.y}, {frame.px(value), frame.box.bottom()},
                    {pale, 0.4});
        if (labels)
            canvas.text({frame.px(value), frame.box.bottom() + 9}, fixed(value, frame.x.decimals),
                        tick_style, Align::centre);
    }
}

// ---- deviation plot -------------------------------------------------------------------------

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

Ticks deviation_ticks(const std::vector<DirectionCurve>& curves) {
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
    const double span = high - low;
    if (low > 0 && low < 2 * span) low = 0; // show zero unless it would flatten the curves
    if (high < 0 && -high < 2 * span) high = 0;
    return ticks_around(low, high, 6, 0.5);
}

/// A frame that leaves a little air on both sides of the data.
PlotFrame frame_along(double low, double high, double margin) {
    const double span = high > low ? high - low : 1;
    PlotFrame frame;
    frame.x_low = low - margin * span;
    frame.x_high = high + margin * span;
    frame.x = ticks_within(frame.x_low, frame.x_high, 10);
    return frame;
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

// ---- environment plot -----------------------------------------------------------------------

struct TimeScale {
    double seconds_per_unit = 1;
    std::string unit = "s";
};

TimeScale time_scale_for(double seconds) {
    if (seconds < 180) return {1, "s"};
    if (seconds < 4 * 3600) return {60, "min"};
    return {3600, "h"};
}

std::pair<double, double> range_of(const std::vector<EnvironmentPanel>& panels, bool of_time) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const EnvironmentPanel& panel : panels)
        for (const EnvironmentTrace* drawn : panel.traces)
            for (const double value : of_time ? drawn->seconds : drawn->values) {
                low = std::min(low, of_time ? value : value * panel.paper.factor);
                high = std::max(high, of_time ? value : value * panel.paper.factor);
            }
    return {low, high};
}

/// Channels of a panel stay apart by colour and by dash.
Stroke channel_stroke(std::size_t index) {
    constexpr std::array<Colour, 4> colours{forward_blue, backward_vermilion,
                                            Colour{0.0, 0.62, 0.45}, Colour{0.8, 0.475, 0.655}};
    return {colours[index % colours.size()], 0.9, (index / colours.size()) % 2 == 1};
}

constexpr double legend_line = 9.5, legend_sample = 14;

/// Names of the channels with a sample of their line, flowing over lines of `width`.
/// @returns the height used; draws only when `drawn`.
double legend_of(
    Canvas& canvas, const EnvironmentPanel& panel, PagePoint top_left, double width, bool drawn) {
    double x = top_left.x, y = top_left.y + legend_line;
    const std::string title = panel.paper.quantity + ", " + panel.paper.unit;
    if (drawn) canvas.text({x, y - 2}, title, {7.5, true});
    x += canvas.width_of(title, {7.5, true}) + 12;
    for (std::size_t i = 0; i < panel.traces.size(); ++i) {
        const double room = std::min(canvas.width_of(panel.traces[i]->channel, tick_style) + 0.5,
                                     width - legend_sample - 4);
        if (x + legend_sample + 4 + room > top_left.x + width) {
            x = top_left.x;
            y += legend_line;
        }
        if (drawn) {
            canvas.line({x, y - 4.5}, {x + legend_sample, y - 4.5}, channel_stroke(i));
            canvas.paragraph({x + legend_sample + 4, y - 8.6}, room, panel.traces[i]->channel,
                             tick_style, 1);
        }
        x += legend_sample + 4 + room + 12;
    }
    return y - top_left.y + 5;
}

void draw_panel(Canvas& canvas,
                const EnvironmentPanel& panel,
                const PlotFrame& frame,
                const TimeScale& scale,
                bool last) {
    draw_columns(canvas, frame, last);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    for (std::size_t i = 0; i < panel.traces.size(); ++i) {
        const EnvironmentTrace& drawn = *panel.traces[i];
        std::vector<PagePoint> points;
        for (std::size_t k = 0; k < drawn.values.size(); ++k)
            points.push_back({frame.px(drawn.seconds[k] / scale.seconds_per_unit),
                              frame.py(drawn.values[k] * panel.paper.factor)});
        if (points.size() == 1)
            canvas.dot(points.front(), 1.4, channel_stroke(i).colour);
        else
            canvas.polyline(points, channel_stroke(i));
    }
}

double round_step(double span, int parts) {
    const double decade = std::pow(10.0, std::floor(std::log10(span / parts)));
    const double share = span / parts / decade;
    return decade * (share <= 1.1 ? 1 : share <= 2.2 ? 2 : share <= 5.5 ? 5 : 10);
}

int decimals_of(double step) {
    return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

} // namespace

std::vector<double> Ticks::all() const {
    std::vector<double> values;
    const int count = static_cast<int>(std::lround((last - first) / step));
    for (int i = 0; i <= count; ++i)
        values.push_back(first + i * step);
    return values;
}

Ticks ticks_around(double low, double high, int parts, double least_span) {
    const double widen = std::max(0.0, (least_span - (high - low)) / 2);
    low -= widen;
    high += widen;
    if (!(high > low)) high = low + 1;
    const double step = round_step(high - low, parts);
    return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step,
            decimals_of(step)};
}

Ticks ticks_within(double low, double high, int parts) {
    if (!(high > low)) high = low + 1;
    const double step = round_step(high - low, parts);
    return {std::ceil(low / step - 1e-9) * step, std::floor(high / step + 1e-9) * step, step,
            decimals_of(step)};
}

void draw_deviation_plot(Canvas& canvas, PageBox box, const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const auto curves = curves_of(certificate, units.deviation_factor);
    const auto [low, high] = std::ranges::minmax(certificate.deviations.targets());
    PlotFrame frame = frame_along(low, high, 0.025);
    frame.y = deviation_ticks(curves);
    const double labels = widest(canvas, frame.y) + 6;
    frame.box = {box.x + labels, box.y + 13, box.width - labels - 8, box.height - 13 - 22};
    draw_columns(canvas, frame, true);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    for (const DirectionCurve& curve : curves)
        draw_band(canvas, frame, curve);
    for (const DirectionCurve& curve : curves)
        draw_curve(canvas, frame, curve);
    canvas.text({box.x, box.y + 8}, "Deviation (actual − target), " + units.deviation, {7.5, true});
    draw_legend(canvas, curves, {frame.box.right(), box.y + 8}, certificate.result.cover_factor);
    canvas.text({frame.box.right(), box.bottom() - 2}, "Target position, " + units.position,
                label_style, Align::right);
    if (certificate.result.approaches > 1)
        canvas.text({frame.box.x, box.bottom() - 2}, "faint points: every single deviation",
                    {7, false, grey});
}

std::vector<EnvironmentPanel> environment_panels_of(const Certificate& certificate) {
    constexpr std::array<std::pair<ChannelKind, Medium>, 5> order{
        {{ChannelKind::temperature, Medium::air},
         {ChannelKind::temperature, Medium::material},
         {ChannelKind::pressure, Medium::air},
         {ChannelKind::humidity, Medium::air},
         {ChannelKind::carbon_dioxide, Medium::air}}};
    std::vector<EnvironmentPanel> panels;
    for (const auto& [kind, medium] : order) {
        EnvironmentPanel panel{paper_of(kind, medium), {}};
        for (const EnvironmentTrace& drawn : certificate.traces) {
            const bool other_temperature =
                kind == ChannelKind::temperature && drawn.medium != medium;
            if (drawn.kind == kind && !other_temperature && !drawn.values.empty())
                panel.traces.push_back(&drawn);
        }
        if (!panel.traces.empty()) panels.push_back(std::move(panel));
    }
    return panels;
}

void draw_environment_plot(Canvas& canvas,
                           PageBox box,
                           const std::vector<EnvironmentPanel>& panels) {
    if (panels.empty()) return;
    const auto [begin_s, end_s] = range_of(panels, true);
    const TimeScale scale = time_scale_for(end_s - begin_s);
    PlotFrame frame =
        frame_along(begin_s / scale.seconds_per_unit, end_s / scale.seconds_per_unit, 0.01);
    std::vector<Ticks> values;
    double labels = 0, legends = 0;
    for (const EnvironmentPanel& panel : panels) {
        const auto [low, high] = range_of({panel}, false);
        values.push_back(ticks_around(low, high, 4, panel.paper.least_span));
        labels = std::max(labels, widest(canvas, values.back()) + 6);
        legends += legend_of(canvas, panel, {box.x, 0}, box.width, false);
    }
    constexpr double gap = 5, time_labels = 22;
    const auto count = static_cast<double>(panels.size());
    const double height = (box.height - legends - gap * (count - 1) - time_labels) / count;
    double y = box.y;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        y += legend_of(canvas, panels[i], {box.x, y}, box.width, true);
        frame.box = {box.x + labels, y, box.width - labels - 8, height};
        frame.y = values[i];
        draw_panel(canvas, panels[i], frame, scale, i + 1 == panels.size());
        y += height + gap;
    }
    canvas.text({box.right() - 8, box.bottom() - 2}, "Time since the first point, " + scale.unit,
                label_style, Align::right);
}

} // namespace axiscal
