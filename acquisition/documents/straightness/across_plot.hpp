#pragma once
// Deviations across an axis over its targets, as they are drawn. What is drawn stays inside its
// box, labels included. Pure.

#include "acquisition/documents/pdf/plot_frame.hpp"
#include "acquisition/documents/straightness/across_run_file.hpp"

#include <string>
#include <vector>

namespace axiscal {

inline constexpr double um_in_a_mm_across = 1000;

/// One line of values over the targets, mm and um.
struct AcrossCurve {
    std::string words;
    std::vector<double> targets_mm, values_um;
    Stroke stroke;
    double arrow = 0;    ///< +1 forward, -1 backward; 0: no marks
    bool dotted = false; ///< a dot at each target
};

/// A measured line, solid.
AcrossCurve across_curve_of(std::string words, const MeasuredLine& line);
/// From the first to the last target of `line`.
AcrossCurve
across_curve_of(std::string words, const ReferenceLine& reference, const MeasuredLine& line);

/// As long as the first of them; as high as all. Its box is still none.
PlotFrame frame_of_across(const std::vector<AcrossCurve>& curves);
/// Leaves room for title and numbers. @param right  of the frame; draw_range() needs that much
void place_across_frame(Canvas& canvas,
                        PlotFrame& frame,
                        PageBox box,
                        double right = room_of_range);
/// Frame, curves, their names in the line of the title.
void draw_across_curves(Canvas& canvas,
                        PageBox box,
                        const PlotFrame& frame,
                        const std::vector<AcrossCurve>& curves,
                        const std::string& title);

} // namespace axiscal
