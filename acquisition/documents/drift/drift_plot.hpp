#pragma once
// A drift test against time. Both figures stay inside their box, labels included. Pure drawing.

#include "acquisition/documents/pdf/plots.hpp"
#include "analysis/drift/run_drift.hpp"

#include <vector>

namespace axiscal {

/// The coordinate of the resting axis: its lowest and highest reading carried to the right, where
/// their distance is E_VE; the hour of ETVE shaded where the test is longer than that.
void draw_drift_plot(Canvas& canvas, PageBox box, const RunDrift& drift);

/// The other channels as traces ("weather/pressure"), lengths as change in um; those without a
/// reading are left out.
std::vector<EnvironmentTrace> drift_traces_of(const RunDrift& drift);

/// The resting axis as a run would give it, and as read; of a ballbar its reading: the uppermost
/// panel of the channels. Its pointers live as long as the traces.
std::vector<EnvironmentTrace> drift_axis_traces_of(const RunDrift& drift);
EnvironmentPanel drift_axis_panel_of(const RunDrift& drift,
                                     const std::vector<EnvironmentTrace>& traces);

/// Panels of the other channels in the order lengths, material, air, other temperatures, pressure,
/// humidity, carbon dioxide, strength. The pointers live as long as the traces.
std::vector<EnvironmentPanel> drift_panels_of(const std::vector<EnvironmentTrace>& traces);

/// How a channel of a drift test is written: as of the environment, but lengths in um, and a
/// temperature without a medium by no medium's name. Pure.
ChannelPaper drift_paper_of(ChannelKind kind, Medium medium);

/// Of the figures of the axis: "µm" | "″". Pure.
std::string drift_unit_on_paper(const RunDrift& drift);

/// Of more than 2000 readings the lowest and the highest of each thousandth of them, in order: what
/// a page of paper can show. Pure.
DriftSeries as_drawn(const DriftSeries& series);

} // namespace axiscal
