#pragma once
// The two figures of a certificate. Both stay inside their box, labels included. Pure drawing.

#include "acquisition/documents/pdf/page.hpp"
#include "acquisition/documents/pdf/wording.hpp"

#include <vector>

namespace axiscal {

/// Deviation against target: every point faint, means solid blue with arrows right (forward) and
/// dashed vermilion with arrows left (backward), ±k s as translucent bands with thin outlines.
void draw_deviation_plot(Canvas& canvas, PageBox box, const Certificate& certificate);

/// Traces of one kind of channel.
struct EnvironmentPanel {
    ChannelPaper paper;
    std::vector<const EnvironmentTrace*> traces;
};
/// Panels in the order air temperature, material temperature, pressure, humidity, carbon dioxide;
/// kinds without a reading are left out. The pointers live as long as the certificate.
std::vector<EnvironmentPanel> environment_panels_of(const Certificate& certificate);

/// Panels under one time axis, which is named below the last one: its zero is `since`.
void draw_environment_plot(Canvas& canvas,
                           PageBox box,
                           const std::vector<EnvironmentPanel>& panels,
                           std::string_view since = "the first point");

} // namespace axiscal
