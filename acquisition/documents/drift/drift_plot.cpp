#include "acquisition/documents/drift/drift_plot.hpp"

#include "acquisition/documents/pdf/plot_frame.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

constexpr double seconds_a_minute = 60;
constexpr double least_span_um = 0.05; ///< or arcsec: no plot magnifies noise beyond this
constexpr double room_of_times = 24;

/// "1.70 µm", "0.612″".
std::string drift_figure(const RunDrift& drift, double range) {
    const std::string unit = drift_unit_on_paper(drift);
    return fixed(range, length_decimals(range)) + (unit == "µm" ? " " : "") + unit;
}

std::string resting_axis_text(const RunDrift& drift) {
    if (drift.of_bar) return "Ballbar at rest, change of its reading";
    return std::string{"Axis at rest, change of its coordinate"} +
           (drift.unit == "um" ? " at 20 °C" : "");
}

/// Where the lowest and the highest reading lie, and E_VE between them.
RangeMark range_mark_of(const RunDrift& drift, const PlotFrame& frame, double per_minute) {
    const DriftSeries& axis = drift.axis;
    const auto [low, high] = std::ranges::minmax_element(axis.readings);
    const auto point = [&](std::vector<double>::const_iterator at) {
        const auto index = static_cast<std::size_t>(at - axis.readings.begin());
        return PagePoint{frame.px(axis.times[index] * per_minute), frame.py(*at)};
    };
    return {point(low), point(high), "E_VE", drift_figure(drift, drift.eve.range)};
}

/// The hour in which the range is largest.
void shade_hour(Canvas& canvas, const PlotFrame& frame, const RunDrift& drift, double per_minute) {
    const auto& times = drift.axis.times;
    if (times.back() - times.front() <= drift.window_min) return;
    const double begin = frame.px(times[drift.window.first] * per_minute);
    const double end = frame.px(times[drift.window.last] * per_minute);
    canvas.area({{begin, frame.box.y},
                 {end, frame.box.y},
                 {end, frame.box.bottom()},
                 {begin, frame.box.bottom()}},
                forward_blue, 0.09);
    canvas.text({(begin + end) / 2, frame.box.y + 9},
                "ETVE " + drift_figure(drift, drift.window.range), tick_style, Align::centre);
}

EnvironmentTrace
trace_of(std::string name, ChannelKind kind, Medium medium, const DriftSeries& series) {
    DriftSeries drawn = as_drawn(series);
    for (double& time : drawn.times)
        time *= seconds_a_minute;
    return {std::move(name), kind, medium, std::move(drawn.times), std::move(drawn.readings)};
}

bool goes_there(const EnvironmentTrace& drawn, ChannelKind kind, Medium medium) {
    return drawn.kind == kind && (kind != ChannelKind::temperature || drawn.medium == medium);
}

} // namespace

void draw_drift_plot(Canvas& canvas, PageBox box, const RunDrift& drift) {
    const DriftSeries& axis = drift.axis;
    const double begin_s = axis.times.front() * seconds_a_minute;
    const double end_s = axis.times.back() * seconds_a_minute;
    const TimeScale scale = time_scale_for(end_s - begin_s);
    const double per_minute = seconds_a_minute / scale.seconds_per_unit;
    PlotFrame frame =
        frame_along(begin_s / scale.seconds_per_unit, end_s / scale.seconds_per_unit, 0.01);
    const auto [low, high] = std::ranges::minmax(axis.readings);
    frame.y = ticks_around(low, high, 6, least_span_um);
    const double labels = widest(canvas, frame.y) + 6;
    constexpr double title = 14;
    canvas.text({box.x, box.y + 8}, resting_axis_text(drift) + ", " + drift_unit_on_paper(drift),
                {7.5, true});
    frame.box = {box.x + labels, box.y + title, box.width - labels - room_of_range,
                 box.height - title - room_of_times};
    shade_hour(canvas, frame, drift, per_minute);
    draw_columns(canvas, frame, true);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    const DriftSeries drawn = as_drawn(axis);
    std::vector<PagePoint> points;
    points.reserve(drawn.times.size());
    for (std::size_t i = 0; i < drawn.times.size(); ++i)
        points.push_back({frame.px(drawn.times[i] * per_minute), frame.py(drawn.readings[i])});
    canvas.polyline(points, {forward_blue, 0.9});
    draw_range(canvas, frame, range_mark_of(drift, frame, per_minute));
    canvas.text({frame.box.right(), box.bottom() - 3},
                "Time since the beginning of the test, " + scale.unit, label_style, Align::right);
}

std::vector<EnvironmentTrace> drift_traces_of(const RunDrift& drift) {
    std::vector<EnvironmentTrace> traces;
    traces.reserve(drift.channels.size());
    for (const ChannelDrift& channel : drift.channels)
        if (!channel.series.readings.empty())
            traces.push_back(
                trace_of(full_name_of(channel), channel.kind, channel.medium, channel.series));
    return traces;
}

std::vector<EnvironmentTrace> drift_axis_traces_of(const RunDrift& drift) {
    const auto trace = [](const char* name, const DriftSeries& series) {
        return trace_of(name, ChannelKind::displacement, Medium::none, series);
    };
    if (drift.of_bar) return {trace("as read", drift.bare)};
    return {trace(drift.unit == "um" ? "at 20 °C" : "in air", drift.axis),
            trace("as read", drift.bare)};
}

EnvironmentPanel drift_axis_panel_of(const RunDrift& drift,
                                     const std::vector<EnvironmentTrace>& traces) {
    EnvironmentPanel panel{{drift.of_bar ? "Ballbar at rest, change" : "Axis at rest, change",
                            drift_unit_on_paper(drift), 1, length_decimals(drift.eve.range),
                            least_span_um},
                           {}};
    for (const EnvironmentTrace& drawn : traces)
        panel.traces.push_back(&drawn);
    return panel;
}

std::vector<EnvironmentPanel> drift_panels_of(const std::vector<EnvironmentTrace>& traces) {
    constexpr std::array<std::pair<ChannelKind, Medium>, 9> order{
        {{ChannelKind::displacement, Medium::none},
         {ChannelKind::temperature, Medium::material},
         {ChannelKind::temperature, Medium::air},
         {ChannelKind::temperature, Medium::none},
         {ChannelKind::pressure, Medium::none},
         {ChannelKind::humidity, Medium::none},
         {ChannelKind::carbon_dioxide, Medium::none},
         {ChannelKind::strength, Medium::none},
         {ChannelKind::angle, Medium::none}}};
    std::vector<EnvironmentPanel> panels;
    for (const auto& [kind, medium] : order) {
        EnvironmentPanel panel{drift_paper_of(kind, medium), {}};
        for (const EnvironmentTrace& drawn : traces)
            if (goes_there(drawn, kind, medium)) panel.traces.push_back(&drawn);
        if (!panel.traces.empty()) panels.push_back(std::move(panel));
    }
    return panels;
}

ChannelPaper drift_paper_of(ChannelKind kind, Medium medium) {
    ChannelPaper paper = paper_of(kind, medium);
    if (kind == ChannelKind::displacement) return {"Further length, change", "µm", 1, 2, 0.1};
    if (kind == ChannelKind::temperature && medium == Medium::none)
        paper.quantity = "Further temperature";
    return paper;
}

std::string drift_unit_on_paper(const RunDrift& drift) {
    return drift.unit == "arcsec" ? "″" : "µm";
}

DriftSeries as_drawn(const DriftSeries& series) {
    constexpr std::size_t most = 2000, parts = most / 2;
    const std::size_t count = series.times.size();
    if (count <= most) return series;
    DriftSeries drawn;
    drawn.times.reserve(most);
    drawn.readings.reserve(most);
    const auto take = [&](std::size_t i) {
        drawn.times.push_back(series.times[i]);
        drawn.readings.push_back(series.readings[i]);
    };
    for (std::size_t part = 0; part < parts; ++part) {
        const auto begin =
            series.readings.begin() + static_cast<std::ptrdiff_t>(part * count / parts);
        const auto end =
            series.readings.begin() + static_cast<std::ptrdiff_t>((part + 1) * count / parts);
        const auto [low, high] = std::minmax_element(begin, end);
        const auto first = static_cast<std::size_t>(std::min(low, high) - series.readings.begin());
        const auto second = static_cast<std::size_t>(std::max(low, high) - series.readings.begin());
        take(first);
        if (second != first) take(second);
    }
    return drawn;
}

} // namespace axiscal
