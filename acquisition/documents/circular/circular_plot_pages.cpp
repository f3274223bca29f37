// Each sense by itself, and the two little tables that stand beside its plot.

#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"
#include "acquisition/documents/circular/polar_plot.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

std::string pair_of(double x_mm, double y_mm, int decimals) {
    return micrometres(x_mm, decimals, true) + ", " + micrometres(y_mm, decimals, true) + " µm";
}

std::string radius_text(double above_mm, int decimals) {
    return "R " + std::string{above_mm < 0 ? "\u2212 " : "+ "} +
           micrometres(std::fabs(above_mm), decimals) + " µm";
}

std::vector<StatedField> pairs_of(const CircularCertificate& certificate, Sense sense) {
    const SenseFigures& figures = *certificate.parameters.of(sense);
    const CircularTrace& trace = *certificate.measured.test.find(sense);
    const CircularDeviation& deviation = figures.G;
    const int digits = deviation_decimals(certificate);
    const bool external = certificate.measured.test.source == SignalSource::external;
    std::vector<StatedField> pairs{
        {"Width of the minimum zone", micrometres(deviation.minimum_zone_mm, digits) + " µm"},
        {"Range about l. s. centre", micrometres(deviation.least_squares_mm, digits) + " µm"}};
    if (external) {
        pairs.push_back({"F max", micrometres(figures.F.max_mm, digits, true) + " µm"});
        pairs.push_back({"F min", micrometres(figures.F.min_mm, digits, true) + " µm"});
    }
    pairs.push_back({"Zone, outer circle", radius_text(deviation.ring.outer_mm, digits)});
    pairs.push_back({"Zone, inner circle", radius_text(deviation.ring.inner_mm, digits)});
    pairs.push_back({"Least squares radius", radius_text(deviation.fitted.radius_mm, digits)});
    pairs.push_back({"Zone centre", pair_of(deviation.ring.x_mm, deviation.ring.y_mm, digits)});
    pairs.push_back({"Least squares (l. s.) centre",
                     pair_of(deviation.fitted.x_mm, deviation.fitted.y_mm, digits)});
    pairs.push_back({"Start", start_text(trace)});
    pairs.push_back({"End", end_text(trace)});
    pairs.push_back({"Readings", std::to_string(trace.angle_rad.size())});
    pairs.push_back({"Arc covered", fixed(figures.cover.arc_deg, 1) + "°" +
                                        (figures.cover.full_circle ? ", full circle" : "")});
    return pairs;
}

void draw_sense_plot(Sheet& sheet, const CircularCertificate& certificate, Sense sense) {
    constexpr double plot_width = 316, plot_height = 292, legend_room = 36, gap = 14;
    const SenseFigures& figures = *certificate.parameters.of(sense);
    const std::string direction = plane_of(certificate.measured.axes, sense);
    const bool feedback = certificate.measured.test.source == SignalSource::feedback;
    sheet.heading(std::string{sense == Sense::ccw ? "Counter-clockwise" : "Clockwise"} + ": " +
                      (feedback ? "Gf " : "G ") + direction + " = " +
                      micrometres(figures.G.minimum_zone_mm, deviation_decimals(certificate)) +
                      " µm",
                  plot_height + legend_room);
    Canvas& canvas = sheet.canvas();
    const PageBox plot{Sheet::left, sheet.y(), plot_width, plot_height};
    const PolarView view = polar_view_of(certificate, sense);
    draw_polar_plot(canvas, plot, view);
    const double legend = draw_polar_legend(canvas, plot, view);
    const double x = plot.right() + gap;
    PageBox column{x, plot.y + 8, Sheet::right - x, plot_height};
    column.y += draw_pairs(canvas, column, pairs_of(certificate, sense)) + 12;
    canvas.text({x, column.y}, "Control points of the zone", {7.5, true});
    column.y += 4;
    column.y += draw_control_points(canvas, column, certificate, figures.G);
    if (!view.about_zone)
        canvas.paragraph({x, column.y + 4}, column.width,
                         "The zone's centre lies farther than R from the set-up's: drawn about the "
                         "latter, without its circles.",
                         {7, false, grey});
    sheet.advance(plot_height + legend + 6);
}

} // namespace

double draw_pairs(Canvas& canvas, PageBox column, const std::vector<StatedField>& pairs) {
    constexpr TextStyle key_style{7, false, grey}, value_style{7.5};
    constexpr double line = 11.5, gap = 6;
    double y = column.y;
    for (const auto& [key, value] : pairs) {
        const double key_width = canvas.text({column.x, y}, key, key_style);
        if (key_width + gap + canvas.width_of(value, value_style) > column.width) y += line - 2;
        canvas.text({column.right(), y}, value, value_style, Align::right);
        y += line;
    }
    return y - column.y;
}

double draw_control_points(Canvas& canvas,
                           PageBox column,
                           const CircularCertificate& certificate,
                           const CircularDeviation& deviation) {
    constexpr TextStyle style{7}, head{6.5, false, grey};
    constexpr double line = 10;
    const double angle_right = column.x + column.width * 0.58;
    double y = column.y + 8;
    canvas.text({column.x, y}, "No., sense, side", head);
    canvas.text({angle_right, y}, "angle", head, Align::right);
    canvas.text({column.right(), y}, "r − R, µm", head, Align::right);
    const CircularTest& test = certificate.measured.test;
    int number = 0;
    for (const RingPoint& point : deviation.ring.control_points) {
        y += line;
        const CircularTrace* trace = test.find(point.sense);
        const bool outer = point.side == ZoneSide::outer;
        canvas.text({column.x, y},
                    std::to_string(++number) + "  " + (point.sense == Sense::ccw ? "CCW" : "CW") +
                        ", " + (outer ? "outer" : "inner"),
                    style);
        canvas.text({angle_right, y},
                    fixed(folded_angle(trace->angle_rad[point.index]) * degrees_per_radian, 2) +
                        "°",
                    style, Align::right);
        canvas.text({column.right(), y},
                    micrometres(outer ? deviation.ring.outer_mm : deviation.ring.inner_mm,
                                deviation_decimals(certificate) + 1, true),
                    style, Align::right);
    }
    return y + 4 - column.y;
}

void draw_circular_plot_pages(Sheet& sheet, const CircularCertificate& certificate) {
    sheet.new_page();
    for (const CircularTrace& trace : certificate.measured.test.traces)
        draw_sense_plot(sheet, certificate, trace.sense);
}

} // namespace axiscal
