// Channels with a certificate of their own: number, dates, U and the table that was applied.

#include "acquisition/documents/pdf/back_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// Lengths in micrometres; the others as their readings are printed.
std::string uncertainty_text(const ChannelCalibration& given, const ChannelRecord& channel) {
    constexpr double um_per_m = 1e6;
    const bool length = channel.kind == ChannelKind::displacement;
    const ChannelPaper paper = paper_of(channel.kind, channel.medium);
    std::string words;
    if (given.expanded_uncertainty)
        words = as_stated(*given.expanded_uncertainty * (length ? um_per_m : paper.factor)) + " " +
                (length ? "µm" : paper.unit);
    if (given.expanded_uncertainty_per_m)
        words += (words.empty() ? "" : " + ") +
                 as_stated(*given.expanded_uncertainty_per_m * um_per_m) + " µm/m";
    return words.empty() ? "not stated" : words + ", k = " + as_stated(given.coverage);
}

std::string corrections_text(const ChannelCalibration& given, const ChannelRecord& channel) {
    const ChannelPaper paper = paper_of(channel.kind, channel.medium);
    std::string words;
    for (const auto& [reading, correction] : given.corrections) {
        const std::string added = as_stated(std::abs(correction) * paper.factor);
        words += (words.empty() ? "" : "; ") + as_stated(reading * paper.factor) + " " +
                 paper.unit + ": " + (correction < 0 ? "\u2212" : "+") + added;
    }
    return words.empty() ? "none" : words;
}

std::string due_text(const std::string& due_on, const std::string& run_date) {
    return stated(due_on) + (has_expired(due_on, run_date) ? " (expired)" : "");
}

} // namespace

void draw_calibrations(Sheet& sheet,
                       const std::vector<ChannelCalibration>& calibrations,
                       const std::vector<ChannelRecord>& channels,
                       const std::string& run_date) {
    if (calibrations.empty()) return;
    std::vector<TableRow> rows;
    rows.reserve(calibrations.size());
    for (const ChannelCalibration& calibration : calibrations) {
        const auto channel = std::ranges::find(channels, calibration.channel, &ChannelRecord::id);
        if (channel == channels.end()) continue;
        rows.push_back({channel->name, stated(calibration.certificate_number),
                        stated(calibration.calibrated_on), due_text(calibration.due_on, run_date),
                        uncertainty_text(calibration, *channel),
                        corrections_text(calibration, *channel)});
    }
    sheet.heading("Certificates of channels", 60);
    sheet.table({{"Channel", "", Align::left, true},
                 {"Certificate", "", Align::left, true},
                 {"Calibrated", "", Align::left},
                 {"Due", "", Align::left},
                 {"U", "", Align::left, true},
                 {"Corrections by reading, included", "", Align::left, true}},
                rows, 7);
    sheet.text(
        "Not stated: as the instrument's. Between two readings of a certificate its correction "
        "lies on a straight line, beyond them the last one holds.",
        {7, false, grey});
}

} // namespace axiscal
