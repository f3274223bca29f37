#include "acquisition/documents/straightness/straightness_plot.hpp"

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/straightness/across_plot.hpp"
#include "acquisition/documents/straightness/straightness_wording.hpp"

#include <algorithm>

namespace axiscal {
namespace {

AcrossCurve curve_of_line(const BudgetedLine& line) {
    AcrossCurve curve = across_curve_of(std::string{line.name}, line.found.line);
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
    AcrossCurve curve =
        across_curve_of(straightness_name_on_paper(name_of(reference)), found, mean.line);
    curve.stroke = {grey, 0.7};
    if (reference == main_reference) curve.stroke = {ink, 0.8};
    if (reference == LineReference::minimum_zone) curve.stroke.dashed = true;
    return curve;
}

/// Every value less that of the main reference line there.
void take_off_reference(AcrossCurve& curve, const ReferenceLine& reference) {
    for (std::size_t i = 0; i < curve.values_um.size(); ++i)
        curve.values_um[i] -=
            reference.offset + reference.slope * curve.targets_mm[i] * um_in_a_mm_across;
}

} // namespace

void draw_straightness_plot(Canvas& canvas, PageBox box, const StraightnessResult& result) {
    std::vector<AcrossCurve> curves = measured_curves(result, false);
    for (const LineReference reference : line_references)
        curves.push_back(curve_of_reference(result, reference));
    PlotFrame frame = frame_of_across(curves);
    place_across_frame(canvas, frame, box);
    draw_across_curves(canvas, box, frame, curves,
                       result.mirror ? "Mean of both positions of the mirror, µm"
                                     : "Deviation as measured, µm");
}

void draw_straightness_residuals(Canvas& canvas, PageBox box, const StraightnessResult& result) {
    const StraightnessLine& mean = result.mean().found;
    const ReferenceLine& reference = line_against(mean.against, main_reference);
    std::vector<AcrossCurve> curves = measured_curves(result, true);
    for (AcrossCurve& curve : curves)
        take_off_reference(curve, reference);
    PlotFrame frame = frame_of_across(curves);
    place_across_frame(canvas, frame, box);
    draw_across_curves(canvas, box, frame, curves,
                       "About the " + reference_on_paper(main_reference) + ", µm");
    const auto [low, high] = std::ranges::minmax_element(reference.residuals);
    const auto point = [&](std::vector<double>::const_iterator at) {
        const auto i = static_cast<std::size_t>(at - reference.residuals.begin());
        return PagePoint{frame.px(mean.line.positions[i] / um_in_a_mm_across), frame.py(*at)};
    };
    draw_range(canvas, frame,
               {point(low), point(high), straightness_symbol_of(result),
                fixed(reference.straightness, straightness_decimals(result)) + " µm"});
}

} // namespace axiscal
