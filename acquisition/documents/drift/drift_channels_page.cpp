// Every channel of a drift test against time, and its figures.
#include "acquisition/documents/drift/drift_pages.hpp"
#include "acquisition/documents/drift/drift_plot.hpp"

#include <algorithm>
#include <iterator>

namespace axiscal {
namespace {

TableRow channel_row(const ChannelDrift& channel) {
    const ChannelPaper paper = drift_paper_of(channel.kind, channel.medium);
    const bool length = channel.kind == ChannelKind::displacement;
    const auto& readings = channel.series.readings;
    const auto value = [&](double stored) {
        return readings.empty() ? std::string{"–"} : fixed(stored * paper.factor, paper.decimals);
    };
    const double correction = length ? metre(channel.correction).in(um) : channel.correction;
    const std::string slope =
        channel.slope_per_h ? fixed(*channel.slope_per_h * paper.factor, paper.decimals + 1) : "–";
    return {full_name_of(channel),
            stated(channel.place),
            paper.quantity + ", " + paper.unit,
            value(readings.empty() ? 0 : readings.front()),
            value(readings.empty() ? 0 : readings.back()),
            value(channel.total.range),
            value(channel.window.range),
            slope,
            fixed(correction * paper.factor, paper.decimals),
            std::to_string(readings.size())};
}

void draw_channel_table(Sheet& sheet, const RunDrift& drift) {
    std::vector<TableRow> rows{channel_row(drift.reading)};
    rows.reserve(drift.channels.size() + 1);
    for (const ChannelDrift& channel : drift.channels)
        rows.push_back(channel_row(channel));
    sheet.table({{"Channel", "", Align::left, true},
                 {"Place", "", Align::left, true},
                 {"Quantity", "", Align::left},
                 {"First", ""},
                 {"Last", ""},
                 {"Range", ""},
                 {"Within", "an hour"},
                 {"Slope", "in an hour"},
                 {"Correction", "included"},
                 {"Readings", ""}},
                rows, 7);
    sheet.text(std::string{drift.of_bar ? "The first line is the ballbar."
                                        : "The first line is what measures the axis, as counted."} +
                   " The range of a length is its E_VE, u = E_VE / (2 √3). Slope: of the "
                   "least-squares line. A channel without a reading stayed silent. All of this "
                   "table is informative.",
               note_style);
}

} // namespace

void draw_drift_channels(Sheet& sheet, const RunDrift& drift) {
    sheet.new_page();
    const std::vector<EnvironmentTrace> of_axis = drift_axis_traces_of(drift);
    const std::vector<EnvironmentTrace> traces = drift_traces_of(drift);
    std::vector<EnvironmentPanel> panels{drift_axis_panel_of(drift, of_axis)};
    std::ranges::move(drift_panels_of(traces), std::back_inserter(panels));
    constexpr double usual = 88, room_of_heading = 24;
    const double height =
        std::min(usual * static_cast<double>(panels.size()), sheet.remaining() - room_of_heading);
    sheet.heading("All channels over the test", height);
    draw_environment_plot(sheet.canvas(), {Sheet::left, sheet.y(), Sheet::width, height}, panels,
                          "the beginning of the test");
    sheet.advance(height + 8);
    draw_channel_table(sheet, drift);
}

} // namespace axiscal
