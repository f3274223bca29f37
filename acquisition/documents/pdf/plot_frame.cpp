#include "acquisition/documents/pdf/plot_frame.hpp"

#include "acquisition/documents/pdf/wording.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

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

PlotFrame frame_along(double low, double high, double margin) {
    const double span = high > low ? high - low : 1;
    PlotFrame frame;
    frame.x_low = low - margin * span;
    frame.x_high = high + margin * span;
    frame.x = ticks_within(frame.x_low, frame.x_high, 10);
    return frame;
}

TimeScale time_scale_for(double span_s) {
    if (span_s < 180) return {1, "s"};
    if (span_s < 4 * 3600) return {60, "min"};
    return {3600, "h"};
}

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

void draw_range(Canvas& canvas, const PlotFrame& frame, const RangeMark& mark) {
    const double x = frame.box.right() + 9, tip = 3;
    for (const PagePoint& point : {mark.low, mark.high}) {
        canvas.line(point, {x + 4, point.y}, {grey, 0.7, true});
        canvas.dot(point, 1.6, backward_vermilion);
    }
    canvas.line({x, mark.high.y}, {x, mark.low.y}, {ink, 0.7});
    if (mark.low.y - mark.high.y > 4 * tip) {
        constexpr double up = 1.5707963267948966;
        canvas.pointer({x, mark.high.y + tip}, up, ink);
        canvas.pointer({x, mark.low.y - tip}, -up, ink);
    }
    const double middle = (mark.low.y + mark.high.y) / 2;
    canvas.text({x + 8, middle - 1}, mark.symbol, {8, true});
    canvas.text({x + 8, middle + 9}, mark.words, {8, true});
}

} // namespace axiscal
