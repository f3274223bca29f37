#include "acquisition/documents/squareness/squareness_plot.hpp"

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/squareness/squareness_wording.hpp"
#include "acquisition/documents/straightness/across_plot.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"

#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using AcrossCurves = std::vector<AcrossCurve>;

/// On a copier the two differ by dots and dashes.
AcrossCurves curves_about_mean(const SquareLine& line) {
    const MeasuredLine& measured = line.found.line;
    AcrossCurve means = across_curve_of("mean", measured);
    means.dotted = true;
    AcrossCurve fitted =
        across_curve_of(reference_on_paper(main_reference),
                        line_against(line.found.against, main_reference), measured);
    fitted.stroke = {grey, 1.1, true};
    const double mean_um =
        std::accumulate(measured.deviations.begin(), measured.deviations.end(), 0.0) /
        static_cast<double>(measured.deviations.size());
    for (AcrossCurve* curve : {&means, &fitted})
        for (double& value_um : curve->values_um)
            value_um -= mean_um;
    return {std::move(fitted), std::move(means)};
}

std::string title_of_line(const SquareLine& line, const SquarenessResult& result) {
    const double slope = line_against(line.found.against, main_reference).slope;
    return stated(line.recorded.axis) + " in direction " + stated(line.recorded.across) +
           " about its mean, µm; slope " + um_per_m_on_paper(slope, squareness_decimals(result));
}

void draw_square_line(Canvas& canvas,
                      PageBox box,
                      const AcrossCurves& curves,
                      const Ticks& heights,
                      const std::string& title) {
    constexpr double right_of_frame = 10; // half of the last number
    PlotFrame frame = frame_of_across(curves);
    frame.y = heights;
    place_across_frame(canvas, frame, box, right_of_frame);
    draw_across_curves(canvas, box, frame, curves, title);
}

} // namespace

void draw_squareness_plot(Canvas& canvas, PageBox box, const SquarenessResult& result) {
    constexpr double gap = 4;
    const SquareLine &first = result.lines[0], &second = result.lines[1];
    const AcrossCurves above = curves_about_mean(first), below = curves_about_mean(second);
    AcrossCurves both = above;
    both.insert(both.end(), below.begin(), below.end());
    const Ticks heights = frame_of_across(both).y;
    box.height = (box.height - gap) / 2;
    draw_square_line(canvas, box, above, heights, title_of_line(first, result));
    box.y += box.height + gap;
    draw_square_line(canvas, box, below, heights, title_of_line(second, result));
}

} // namespace axiscal
