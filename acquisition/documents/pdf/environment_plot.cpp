#include "acquisition/documents/pdf/plot_frame.hpp"
#include "acquisition/documents/pdf/plots.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace axiscal {
namespace {

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

} // namespace

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
                           const std::vector<EnvironmentPanel>& panels,
                           std::string_view since) {
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
    canvas.text({box.right() - 8, box.bottom() - 2},
                "Time since " + std::string{since} + ", " + scale.unit, label_style, Align::right);
}

} // namespace axiscal
