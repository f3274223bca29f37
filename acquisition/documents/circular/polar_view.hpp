#pragma once
// What a polar plot of a circle shows, in millimetres and degrees, and the scale that it is drawn
// to. Pure: no drawing here.

#include "analysis/circular/circular_certificate.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct PolarPoint {
    double angle_rad = 0;
    double deviation_mm = 0; ///< radius about the plot's centre minus the nominal one
};

/// One trace in pieces: a gap in angle is not bridged. Of a trace of many readings first, least,
/// greatest and last of each tenth of a degree: nothing that stands out is lost.
struct PolarTrace {
    Sense sense = Sense::ccw;
    std::vector<std::vector<PolarPoint>> pieces;
    double start_rad = 0, end_rad = 0; ///< of the first and the last reading as listed
};

/// A control point, numbered as in the table beside the plot.
struct PolarMark {
    PolarPoint at;
    Sense sense = Sense::ccw;
    ZoneSide side = ZoneSide::outer;
    int number = 1;
};

struct PolarZone {
    double outer_mm = 0, inner_mm = 0;
};

struct PolarView {
    AxisNames axes{"X", "Y"};
    double x_mm = 0, y_mm = 0; ///< the plot's centre, from the set-up's
    bool about_zone = true;    ///< false where the zone's centre lies beyond the set-up: no ring
    std::vector<PolarTrace> traces;
    std::optional<PolarZone> zone; ///< circles about the plot's centre
    std::vector<PolarMark> marks;
    PolarPoint fitted; ///< least squares centre from the plot's: direction and distance
    double low_mm = 0, high_mm = 0;
    /// What the heavy circle stands for, minus the nominal radius: 0, or the least squares radius
    /// where the nominal circle lies too far off to show the form beside it.
    double base_mm = 0;
    std::optional<double> overshoot_deg;
};

/// About the centre of the minimum zone of one sense, or of both.
PolarView polar_view_of(const CircularCertificate& certificate, Sense sense);
PolarView polar_view_of_both(const CircularCertificate& certificate);

/// A step of 1, 2 or 5 times a power of ten, at most `value`. @param value  above 0
double round_down_125(double value);

/// How a view is drawn: base circle and magnification, 10 mm of paper to a division.
struct PolarScale {
    static constexpr double division_paper_mm = 10;
    double plot_pt = 0, base_pt = 0; ///< radii on the page
    double magnification = 1;        ///< 1, 2 or 5 times a power of ten
    [[nodiscard]] double division_mm() const { return division_paper_mm / magnification; }
    /// @param above_base_mm  deviation minus PolarView::base_mm
    [[nodiscard]] double radius_pt(double above_base_mm) const;
};

/// The largest magnification at which everything from low to high stays inside the plot and
/// outside its middle; 100 000 at most.
PolarScale polar_scale(double plot_radius_pt, double low_mm, double high_mm);

/// "5000:1", "1:2"
std::string magnification_text(double magnification);
/// "2 µm", "0.5 mm"
std::string division_text(double division_mm);

} // namespace axiscal
