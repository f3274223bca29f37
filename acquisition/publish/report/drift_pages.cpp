#include "acquisition/publish/report/drift_pages.hpp"

#include "acquisition/publish/report/back_parts.hpp"
#include "acquisition/publish/report/certificate_pages.hpp"
#include "acquisition/publish/report/drift_plot.hpp"
#include "analysis/certificate_expiry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axiscal {
namespace {

std::string place_words(const RunDrift& drift) {
    return fixed(drift.setup.place.in(mm), 3) + " mm";
}

std::string next_due(const RunRecord& run) {
    return run.statements.next_due.empty() ? one_year_after(run.closed.utc_ns)
                                           : run.statements.next_due;
}

std::vector<StatedField> draw_identity(Sheet& sheet, const DriftDocument& document) {
    const RunRecord& run = document.run;
    const Statements& said = run.statements;
    const std::string started = iso8601_utc(run.opened.utc_ns);
    const std::string finished = iso8601_utc(run.closed.utc_ns);
    constexpr std::size_t length_of_date = 10;
    auto shortened =
        sheet.fields({{"Laboratory", stated(said.laboratory)},
                      {"Certificate number", stated(said.certificate_number)},
                      {"Customer", stated(said.customer)},
                      {"Measured", measured_span(started, finished)},
                      {"Place", stated(said.place)},
                      {"Issued on", finished.substr(0, length_of_date)},
                      {"Machine", stated(said.machine)},
                      {"Next calibration due", next_due(run)},
                      {"Maker", stated(said.machine_maker)},
                      {"Procedure", stated(said.procedure)},
                      {"Serial number", stated(said.machine_serial)},
                      {"Control compensation", stated(said.control_compensation)},
                      {"Axis", stated(said.axis) + ", at rest at " + place_words(document.drift)},
                      {"Reference temperature", "20 °C; E_VE and ETVE hold there"}},
                     2, 2);
    sheet.advance(5);
    return shortened;
}

void draw_figures(Sheet& sheet, const RunDrift& drift) {
    const int decimals = drift_decimals(drift.eve.range);
    const auto minute = [&](std::size_t index) { return fixed(drift.axis.times[index], 2); };
    const auto row = [&](const char* symbol, const std::string& words, const DriftRange& found) {
        return TableRow{symbol, words, fixed(found.range, decimals), minute(found.first),
                        minute(found.last)};
    };
    const std::string hour = fixed(drift.window_min, 0) + " min";
    const std::vector<TableRow> rows{
        row("E_VE", "Environmental variation: range over the whole test", drift.eve),
        {"u(E_VE)", "Standard uncertainty from it, E_VE / (2 √3)",
         fixed_up(drift.eve.u_eve, decimals), "", ""},
        row("ETVE", "Largest range within any " + hour, drift.window),
        {"", "Last reading against the first", fixed(drift.end_change, decimals), "", ""},
        {"", "Range as read, without any compensation", fixed(drift.as_read.range, decimals), "",
         ""}};
    sheet.advance(3);
    sheet.table({{"", "", Align::left},
                 {"Figure", "", Align::left},
                 {"Value, µm", ""},
                 {"From, min", ""},
                 {"To, min", ""}},
                rows);
}

/// Intervals that the figures do not know.
std::string gaps_words(const RunDrift& drift) {
    std::string words;
    if (drift.missing > 0)
        words = std::to_string(drift.missing) + " of " +
                std::to_string(drift.setup.duration / drift.setup.interval) +
                " intervals have no good reading of the length. ";
    if (drift.without_air > 0)
        words += std::to_string(drift.without_air) +
                 " readings without fresh air or material beside them are left out.";
    return words;
}

void draw_rule(Sheet& sheet, const RunDrift& drift) {
    sheet.text("E_VE: largest minus smallest coordinate of the resting axis at 20 °C, "
               "as a run would have given it. ETVE: the same within an hour. Positive changes go "
               "towards + of the coordinate. What is left after the compensation is the "
               "environment's share: machine, set-up and sensors together.",
               note_style);
    const auto& times = drift.axis.times;
    if (times.back() - times.front() < drift.window_min)
        sheet.text("The test is shorter than " + fixed(drift.window_min, 0) +
                       " min: ETVE is the range of the whole test.",
                   note_style);
    if (const std::string gaps = gaps_words(drift); !gaps.empty())
        sheet.text(gaps, {7.5, true, backward_vermilion});
}

TableRow channel_row(const ChannelDrift& channel) {
    const ChannelPaper paper = drift_paper_of(channel.kind, channel.medium);
    const bool length = channel.kind == ChannelKind::displacement;
    const auto& readings = channel.series.readings;
    const auto value = [&](double stored) {
        return readings.empty() ? std::string{"–"} : fixed(stored * paper.factor, paper.decimals);
    };
    const double correction = length ? metre(channel.correction).in(um) : channel.correction;
    return {channel.name,
            stated(channel.place),
            paper.quantity,
            paper.unit,
            value(readings.empty() ? 0 : readings.front()),
            value(readings.empty() ? 0 : readings.back()),
            value(channel.total.range),
            value(channel.window.range),
            fixed(correction * paper.factor, paper.decimals),
            std::to_string(readings.size())};
}

std::string expansion_words(const MaterialSetup& material) {
    std::string words = fixed(material.coefficient.si() * 1e6, 2) + " µm/(m·K)";
    if (material.standard_uncertainty)
        return words + ", standard uncertainty " +
               fixed(material.standard_uncertainty->si() * 1e6, 2);
    return words + ", uncertainty not stated";
}

/// What read the resting axis; three fields each.
std::array<StatedField, 3> fields_of_laser(const RunRecord& run) {
    const bool ciddor = run.air.formula == AirFormula::ciddor;
    return {{{"Vacuum wavelength", fixed(run.laser.vacuum_wavelength.in(nm), 6) + " nm"},
             {"Air formula", air_formula_words(ciddor ? "ciddor" : "edlen") + ", CO\u2082 " +
                                 fixed(run.air.co2_ppm, 0) + " ppm unless measured"},
             {"Dead path L\u2080", fixed(run.laser.dead_path.in(mm), 1) + " mm"}}};
}

std::array<StatedField, 3> fields_of_scale(const ScaleSetup& scale) {
    const std::string u = scale.standard_uncertainty
                              ? fixed(scale.standard_uncertainty->si() * 1e6, 2) + " µm/(m·K)"
                              : "not stated";
    return {{{"Reference", "linear scale, " + fixed(scale.resolution.in(um), 4) + " µm a count"},
             {"Coefficient of the scale", fixed(scale.coefficient.si() * 1e6, 2) + " µm/(m·K)"},
             {"Its standard uncertainty", u}}};
}

std::string carried_words(bool by_scale) {
    return by_scale ? "scale and material on the distance from the datum. "
                    : "air on the whole path from the interferometer (dead path included), "
                      "material on the distance from the datum. ";
}

void draw_setup(Sheet& sheet, const DriftDocument& document) {
    const RunRecord& run = document.run;
    const Statements& said = run.statements;
    const RunDrift& drift = document.drift;
    const auto reference = run.scale ? fields_of_scale(*run.scale) : fields_of_laser(run);
    sheet.heading("Test and conditions");
    sheet.fields({{"Place of rest", place_words(drift)},
                  {"Duration", duration_words(drift.setup.duration)},
                  {"Interval", duration_words(drift.setup.interval)},
                  {"Readings of the length",
                   std::to_string(drift.axis.times.size()) + " of " +
                       std::to_string(drift.setup.duration / drift.setup.interval)},
                  reference[0],
                  reference[1],
                  {"Expansion coefficient α", expansion_words(run.material)},
                  {"Feedback of the axis", stated(run.material.feedback)},
                  reference[2],
                  {"Axis datum", fixed(run.plan.datum.in(mm), 4) + " mm"},
                  {"Warm-up", stated(said.warm_up)},
                  {"Positions of idle axes", stated(said.idle_axes)},
                  {"Offsets of the measuring line", stated(said.offsets)},
                  {"Note on the sensors", stated(said.sensor_note)},
                  {"Station", stated(run.station)},
                  {"Alignment of the beam",
                   document.attachments.alignment ? "recorded: see below" : "not recorded"}},
                 2);
    sheet.fields({{"Station file SHA-256", stated(run.config_hash)}}, 1);
    sheet.text(
        "Each reading of the " + std::string{run.scale ? "scale" : "laser"} +
            " is a mean over the capture window of the station file and is carried to 20 °C as "
            "every point of a run is, " +
            carried_words(run.scale.has_value()) +
            "Other channels are as last read in each interval.",
        note_style);
}

} // namespace

std::string duration_words(Duration duration) {
    using namespace std::chrono_literals;
    constexpr std::pair<Duration, const char*> units[]{{1h, " h"}, {1min, " min"}, {1s, " s"}};
    for (const auto& [unit, name] : units)
        if (duration >= unit && duration % unit == Duration{})
            return std::to_string(duration / unit) + name;
    return fixed(seconds_of(duration), 3) + " s";
}

std::vector<StatedField> draw_drift_front_page(Sheet& sheet, const DriftDocument& document) {
    const RunRecord& run = document.run;
    const RunDrift& drift = document.drift;
    draw_front_title(sheet, {"Drift test", run.statements.state,
                             "Environmental variation E_VE (ISO 230-2) and ETVE (ISO 230-3) of a "
                             "linear axis at rest, " +
                                 duration_words(drift.setup.duration) + ", a reading each " +
                                 duration_words(drift.setup.interval)});
    auto shortened = draw_identity(sheet, document);
    draw_front_instruments(sheet, run.instruments, run_date_of(run), shortened);
    draw_figures(sheet, drift);
    draw_rule(sheet, drift);
    constexpr double largest_plot = 340;
    sheet.advance(6);
    const double room = sheet.remaining() - signature_height - 4;
    draw_drift_plot(sheet.canvas(),
                    {Sheet::left, sheet.y(), Sheet::width, std::min(room, largest_plot)}, drift);
    draw_signatures(sheet, run.statements,
                    {{"Run", stated(run.run_id)},
                     {"Run file SHA-256", stated(document.run_file_sha256)},
                     {"Result SHA-256", stated(document.result_digest)},
                     {"Software", "axiscal, version " + stated(run.software_version)}});
    return shortened;
}

void draw_drift_channels(Sheet& sheet, const RunDrift& drift) {
    sheet.new_page();
    const std::vector<EnvironmentTrace> traces = drift_traces_of(drift);
    const auto panels = drift_panels_of(traces);
    constexpr double usual = 88, room_of_heading = 24;
    const double height =
        std::min(usual * static_cast<double>(panels.size()), sheet.remaining() - room_of_heading);
    sheet.heading("All channels over the test", panels.empty() ? 20 : height);
    if (panels.empty()) {
        sheet.text("No other channel was recorded.");
        return;
    }
    draw_environment_plot(sheet.canvas(), {Sheet::left, sheet.y(), Sheet::width, height}, panels,
                          "the beginning of the test");
    sheet.advance(height + 8);
    std::vector<TableRow> rows;
    rows.reserve(drift.channels.size());
    for (const ChannelDrift& channel : drift.channels)
        rows.push_back(channel_row(channel));
    sheet.table({{"Channel", "", Align::left, true},
                 {"Place of the sensor", "", Align::left, true},
                 {"Quantity", "", Align::left},
                 {"Unit", "", Align::left},
                 {"First", ""},
                 {"Last", ""},
                 {"Range", ""},
                 {"Within an hour", ""},
                 {"Correction", "included"},
                 {"Readings", ""}},
                rows, 7);
}

void draw_drift_conditions(Sheet& sheet,
                           const DriftDocument& document,
                           const std::vector<StatedField>& shortened) {
    const RunRecord& run = document.run;
    draw_calibrations(sheet, run.calibrations, run.channels, run_date_of(run));
    draw_setup(sheet, document);
    draw_alignment(sheet, document.attachments.alignment);
    if (std::ranges::find(shortened, "Instruments", &StatedField::key) != shortened.end())
        draw_instruments(sheet, run.instruments, run_date_of(run));
    std::vector<std::string> remarks;
    if (!run.plan.remark.empty()) remarks.push_back(run.plan.remark);
    draw_remarks(sheet, remarks, shortened);
    draw_events(sheet, run.events, run.opened);
}

} // namespace axiscal
