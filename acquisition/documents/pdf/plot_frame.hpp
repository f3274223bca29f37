#pragma once
// What every plot has: an axis with round marks, and a frame that data lie in.

#include "acquisition/documents/pdf/page.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Round marks of a plot's axis: `first`, `first + step` ... up to `last`. Pure.
struct Ticks {
    double first = 0, last = 1, step = 1;
    int decimals = 0;
    [[nodiscard]] std::vector<double> all() const;
};
/// Ticks that enclose [low, high] by steps of 1, 2 or 5 times a power of ten, about `parts` of
/// them. A span below `least_span` is widened evenly.
Ticks ticks_around(double low, double high, int parts, double least_span = 0);

/// Round marks inside [low, high] only: for an axis that ends with its data. Pure.
Ticks ticks_within(double low, double high, int parts);

inline constexpr TextStyle tick_style{7}, label_style{7.5};

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

/// A frame that leaves a little air on both sides of the data.
PlotFrame frame_along(double low, double high, double margin);

/// Seconds, minutes or hours, as the span asks for.
struct TimeScale {
    double seconds_per_unit = 1;
    std::string unit = "s";
};
TimeScale time_scale_for(double span_s);

/// Of the marks' numbers.
double widest(Canvas& canvas, const Ticks& ticks);
void draw_rows(Canvas& canvas, const PlotFrame& frame);
void draw_columns(Canvas& canvas, const PlotFrame& frame, bool labels);

/// The lowest and the highest point of a plot, and what their distance is called and measures.
struct RangeMark {
    PagePoint low, high;
    std::string symbol, words;
};
inline constexpr double room_of_range = 62; ///< right of the frame, for the mark
/// Both points carried to the right of the frame, and their distance there.
void draw_range(Canvas& canvas, const PlotFrame& frame, const RangeMark& mark);

} // namespace axiscal
