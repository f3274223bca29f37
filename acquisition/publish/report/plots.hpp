#pragma once
// The two figures of a certificate. Both stay inside their box, labels included. Pure drawing.

#include "acquisition/publish/report/page.hpp"
#include "acquisition/publish/report/wording.hpp"

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

/// Deviation against target: every point faint, means solid blue with arrows right (forward) and
/// dashed vermilion with arrows left (backward), ±k s as translucent bands with thin outlines.
void draw_deviation_plot(Canvas& canvas, PageBox box, const Certificate& certificate);

/// Round marks inside [low, high] only: for an axis that ends with its data. Pure.
Ticks ticks_within(double low, double high, int parts);

/// Traces of one kind of channel.
struct EnvironmentPanel {
    ChannelPaper paper;
    std::vector<const EnvironmentTrace*> traces;
};
/// Panels in the order air temperature, material temperature, pressure, humidity, carbon dioxide;
/// kinds without a reading are left out. The pointers live as long as the certificate.
std::vector<EnvironmentPanel> environment_panels_of(const Certificate& certificate);

/// Panels under one time axis, which is named below the last one.
void draw_environment_plot(Canvas& canvas,
                           PageBox box,
                           const std::vector<EnvironmentPanel>& panels);

} // namespace axiscal
