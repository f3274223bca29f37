#include "acquisition/documents/probing/probing_plot.hpp"

#include "acquisition/documents/pdf/plot_frame.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "analysis/probing/probing_case.hpp"

#include <algorithm>
#include <limits>

namespace axiscal {
namespace {

constexpr double least_offset_span_um = 0.05; ///< noise is never magnified beyond this
constexpr double same_distance_mm = 1e-6;     ///< of the start: one mark suffices
constexpr double room_of_distances = 24;

/// Smallest and largest of all that it was given.
struct Reach {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(const std::vector<double>& values) {
        for (const double value : values) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
};

double zero_of(const ProbingResult& document, const ProbingDelayCase& stated, std::size_t at) {
    Reach of_touches, own;
    own.take(stated.series[at].trigger_mm);
    for (std::size_t i = 0; i < document.results.size(); ++i)
        if (!document.results[i].reference &&
            same_direction(document.results[i], document.results[at]))
            of_touches.take(stated.series[i].trigger_mm);
    return of_touches.low <= of_touches.high ? of_touches.low : own.low;
}

PlotFrame frame_of_panel(const ProbingPanel& panel) {
    Reach distances, offsets;
    distances.take(panel.touches->approach_mm);
    offsets.take(panel.touches->offset_um);
    for (const ProbingTrace* reference : panel.references) {
        distances.take(reference->approach_mm);
        offsets.take(reference->offset_um);
    }
    if (distances.high - distances.low < same_distance_mm) distances.high = distances.low;
    PlotFrame frame = frame_along(distances.low, distances.high, 0.03);
    frame.y = ticks_around(offsets.low, offsets.high, 4, least_offset_span_um);
    return frame;
}

std::vector<PagePoint> placed_points(const ProbingTrace& trace, const PlotFrame& frame) {
    std::vector<PagePoint> points;
    points.reserve(trace.approach_mm.size());
    for (std::size_t i = 0; i < trace.approach_mm.size(); ++i)
        points.push_back({frame.px(trace.approach_mm[i]), frame.py(trace.offset_um[i])});
    return points;
}

/// The page's y grows downwards: the largest offset has the smallest.
RangeMark variation_mark(const ProbingDelay& figures, const std::vector<PagePoint>& points) {
    const auto [high, low] = std::ranges::minmax_element(points, {}, &PagePoint::y);
    const double variation_um = figures.variation_mm * um_a_mm;
    return {*low, *high, figures.symbol,
            fixed(variation_um, length_decimals(variation_um)) + " µm"};
}

void draw_latched_points(Canvas& canvas, const PlotFrame& frame, const ProbingPanel& panel) {
    const std::vector<PagePoint> points = placed_points(*panel.touches, frame);
    canvas.polyline(points, {forward_blue, 0.4});
    for (const PagePoint& point : points)
        canvas.dot(point, 1.4, forward_blue);
    for (const ProbingTrace* reference : panel.references)
        for (const PagePoint& point : placed_points(*reference, frame))
            canvas.ring(point, 2.2, {ink, 0.6});
    draw_range(canvas, frame, variation_mark(*panel.touches->figures, points));
}

} // namespace

std::vector<ProbingTrace> probing_traces_of(const ProbingResult& document) {
    const ProbingDelayCase stated = case_of(document.record);
    std::vector<ProbingTrace> traces;
    std::size_t first_touch = 0;
    for (std::size_t i = 0; i < document.results.size(); ++i) {
        const ProbingSeries& series = stated.series[i];
        ProbingTrace trace{&document.results[i], first_touch, series.approach_mm, {}};
        const double zero_mm = zero_of(document, stated, i);
        for (const double latched_mm : series.trigger_mm)
            trace.offset_um.push_back((latched_mm - zero_mm) * um_a_mm);
        first_touch += series.trigger_mm.size();
        traces.push_back(std::move(trace));
    }
    return traces;
}

std::vector<ProbingPanel> probing_panels_of(const std::vector<ProbingTrace>& traces) {
    std::vector<ProbingPanel> panels;
    for (const ProbingTrace& touches : traces) {
        if (touches.figures->reference) continue;
        ProbingPanel panel{&touches, {}};
        for (const ProbingTrace& other : traces)
            if (other.figures->reference && same_direction(*other.figures, *touches.figures))
                panel.references.push_back(&other);
        panels.push_back(std::move(panel));
    }
    return panels;
}

void draw_probing_panel(Canvas& canvas, PageBox box, const ProbingPanel& panel) {
    constexpr double title = 14;
    const ProbingDelay& figures = *panel.touches->figures;
    PlotFrame frame = frame_of_panel(panel);
    const double labels = widest(canvas, frame.y) + 6;
    canvas.text({box.x, box.y + 8},
                "Direction " + direction_text(figures.unit_direction) +
                    ": offset of the latched point, µm",
                {7.5, true});
    frame.box = {box.x + labels, box.y + title, box.width - labels - room_of_range,
                 box.height - title - room_of_distances};
    draw_columns(canvas, frame, true);
    draw_rows(canvas, frame);
    canvas.box(frame.box, {grey, 0.5});
    draw_latched_points(canvas, frame, panel);
    canvas.text({frame.box.right(), box.bottom() - 3}, "Approach distance a, mm", label_style,
                Align::right);
}

std::string direction_text(const std::array<double, 3>& unit_direction) {
    const auto moves = [](double part) { return part != 0; };
    const auto found = std::ranges::find_if(unit_direction, moves);
    if (std::ranges::count_if(unit_direction, moves) == 1) {
        const char axis = static_cast<char>('X' + (found - unit_direction.begin()));
        return (*found < 0 ? "\u2212" : "+") + std::string{axis};
    }
    return "(" + fixed(unit_direction[0], 3) + ", " + fixed(unit_direction[1], 3) + ", " +
           fixed(unit_direction[2], 3) + ")";
}

} // namespace axiscal
