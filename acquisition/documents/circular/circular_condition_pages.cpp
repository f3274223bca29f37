#include "acquisition/documents/circular/circular_pages.hpp"
#include "acquisition/documents/circular/circular_units.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"
#include "acquisition/documents/pdf/back_parts.hpp"
#include "acquisition/documents/pdf/conformity_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axiscal {
namespace {

std::string or_not_stated(const std::optional<double>& value, const std::string& unit) {
    return value ? compact_number(*value) + unit : "not stated";
}

std::string centre_text(const CircularConditions& conditions) {
    if (!conditions.centre_mm) return "not stated";
    const auto& centre = *conditions.centre_mm;
    return "X " + compact_number(centre[0]) + ", Y " + compact_number(centre[1]) + ", Z " +
           compact_number(centre[2]) + " mm";
}

std::string count_text(const std::optional<int>& count) {
    return count ? std::to_string(*count) + " of each sense" : "not stated";
}

/// "Start, CCW" beside "Start, CW".
void add_senses(std::vector<StatedField>& fields, const CircularTest& test) {
    const auto add = [&](const char* key, const auto& words_of) {
        for (const CircularTrace& trace : test.traces)
            fields.push_back({std::string{key} + (trace.sense == Sense::ccw ? ", CCW" : ", CW"),
                              words_of(trace)});
    };
    add("Start", start_text);
    add("End", end_text);
    add("Readings",
        [](const CircularTrace& trace) { return std::to_string(trace.angle_rad.size()); });
}

std::string senses_in_order(const CircularTest& test) {
    std::string words;
    for (const CircularTrace& trace : test.traces)
        words += (words.empty() ? "" : ", then ") + sense_name(trace.sense);
    return words;
}

/// A record without a filter does not tell whether there was none: nobody stated it.
std::string filter_on_paper(const CircularCertificate& certificate) {
    const auto& effect = certificate.capture_effect;
    if (effect && !is_changed(effect->capture)) return "not stated";
    return stated(certificate.measured.conditions.filter);
}

void draw_conditions(Sheet& sheet, const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const CircularConditions& conditions = measured.conditions;
    const Statements& said = measured.run.statements;
    std::vector<StatedField> fields{
        {"Nominal diameter", compact_number(2 * measured.test.nominal_radius_mm) + " mm"},
        {"Feed along the path", feed_text(measured.test.feed_mm_per_s)},
        {"Plane", measured.axes[0] + measured.axes[1] + ": CCW turns +" + measured.axes[0] +
                      " to +" + measured.axes[1]},
        {"Senses, as driven", senses_in_order(measured.test)},
        {"Centre X, Y, Z", centre_text(conditions)},
        {"Offset to the tool reference", stated(conditions.tool_offset)},
        {"Positions of idle axes", stated(said.idle_axes)},
        {"Offset to the workpiece reference", stated(conditions.work_offset)},
        {"Circles evaluated", count_text(conditions.repeats)},
        {"Circles to warm up", count_text(conditions.warm_up)},
        {"Feed-in and feed-out", stated(conditions.feed_in)},
        {"Overshoot before and after", or_not_stated(conditions.overshoot_deg, "°")},
        {"Readings from", measured.test.source == SignalSource::feedback
                              ? "feedback signals of the machine"
                              : "an instrument outside the machine"},
        {"Sampling rate", or_not_stated(conditions.sample_rate_hz, " Hz")},
        {"Filter, averaging", filter_on_paper(certificate)},
        {"Angle of a reading", stated(conditions.angle_origin)},
        {"Control compensation used", stated(said.control_compensation)},
        {"Warm-up", stated(said.warm_up)}};
    add_senses(fields, measured.test);
    sheet.heading("Test conditions", 180);
    sheet.fields(fields, 2);
    if (!certificate.capture_effect)
        sheet.text("All readings count, spikes at reversals included; a filter changes G.",
                   note_style);
}

std::string expansion_text(double alpha_per_K) {
    constexpr double micro = 1e6;
    return compact_number(alpha_per_K * micro) + " µm/(m·K)";
}

void draw_temperatures(Sheet& sheet, const CircularCertificate& certificate) {
    const CircularMeasurement& measured = certificate.measured;
    const CircularConditions& conditions = measured.conditions;
    sheet.heading("Temperatures and compensation to 20 °C", 60);
    std::vector<StatedField> fields{{"Air", temperature_text(conditions.air)},
                                    {"Instrument (bar)", temperature_text(conditions.bar)},
                                    {"Machine", temperature_text(conditions.machine)}};
    if (const auto& bar = measured.expansion) {
        fields.push_back(
            {"Bar, calibrated length L", compact_number(bar->bar_length_mm, 9) + " mm"});
        fields.push_back({"Bar, expansion α", expansion_text(bar->bar_alpha_per_K)});
        fields.push_back({"Machine, expansion α", expansion_text(bar->machine_alpha_per_K)});
        fields.push_back(
            {"Correction in F and D",
             micrometres(certificate.parameters.correction_mm.value_or(0), 2, true) + " µm"});
    } else {
        fields.push_back({"Correction in F and D", "none: as measured"});
    }
    sheet.fields(fields, 2);
    sheet.text("F and D at 20 °C = as read + L α (θ − 20 °C) of the bar − R α (θ − 20 °C) of the "
               "machine. G and G(b) do not feel it.",
               note_style);
}

/// @param circles  at least one
std::string synchronisation_text(const std::vector<CircleCapture>& circles) {
    Synchronisation worst;
    for (const CircleCapture& circle : circles) {
        if (!circle.synchronisation)
            return "Synchronisation error: not stated; no uncertainty of the readings' time is "
                   "known.";
        if (circle.synchronisation->error_um >= worst.error_um) worst = *circle.synchronisation;
    }
    return "Synchronisation error: at most " + fixed_up(worst.error_um, 4) +
           " µm, the speed of the radius times the standard uncertainty u(t) of the readings' "
           "time, there " +
           fixed_up(seconds_of(worst.time_uncertainty) * 1e6, 1) + " µs.";
}

void draw_circles(Sheet& sheet, const CircularCertificate& certificate) {
    std::vector<TableRow> rows;
    for (const CircleCapture& circle : certificate.measured.run.circles)
        rows.push_back({circle.trace.sense == Sense::ccw ? "CCW" : "CW",
                        std::to_string(circle.repeat), circle.warm_up ? "warm-up" : "evaluated",
                        std::to_string(circle.trace.angle_rad.size()),
                        circle.start == StartMethod::trigger ? "trigger" : "feed-in step",
                        fixed(circle.residual_mm * um_per_mm, 1),
                        fixed(circle.speed_residual * 100, 3), std::to_string(circle.missing)});
    if (rows.empty()) return;
    sheet.heading("Circles driven", 60);
    sheet.table({{"Sense", "", Align::left},
                 {"No.", ""},
                 {"Use", "", Align::left},
                 {"Readings", ""},
                 {"Start found by", "", Align::left},
                 {"Path residual", "µm"},
                 {"Speed residual", "%"},
                 {"Missing readings", ""}},
                rows, 7);
    sheet.text("Path residual: time found from the begin to the end of the circle minus the "
               "programmed one, times the feed. " +
                   synchronisation_text(certificate.measured.run.circles),
               note_style);
}

double standard_deviation_of(const std::vector<double>& values, double mean) {
    double squares = 0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

void draw_repeats(Sheet& sheet, const CircularCertificate& certificate) {
    if (certificate.of_repeats.empty()) return;
    constexpr std::size_t most = 8; // columns that a page holds
    const std::size_t count = certificate.of_repeats.begin()->second.size();
    std::vector<TableColumn> columns{{"Figure", "", Align::left}, {"Mean circle", "µm"}};
    for (std::size_t i = 0; i < std::min(count, most); ++i)
        columns.push_back({"Circle " + std::to_string(i + 1), "µm"});
    columns.push_back({"s", "µm"});
    std::vector<TableRow> rows;
    for (const CircularFigureLine& line : figure_lines(certificate)) {
        const std::vector<double>& values = certificate.of_repeats.at(line.key);
        double mean = 0;
        for (const double value : values)
            mean += value / static_cast<double>(values.size());
        TableRow row{line.symbol + " " + line.index, fixed(line.value_mm * um_per_mm, 2)};
        for (std::size_t i = 0; i < std::min(count, most); ++i)
            row.push_back(fixed(values[i] * um_per_mm, 2));
        row.push_back(fixed(standard_deviation_of(values, mean) * um_per_mm, 2));
        rows.push_back(std::move(row));
    }
    sheet.heading("Repeats", 60);
    sheet.text("The certificate's figures are those of the mean circle: the repeats' readings "
               "averaged angle by angle. s: standard deviation over the repeats.",
               note_style);
    sheet.table(columns, rows, 7);
}

/// Without the requests of circles, which stand under "Circles driven".
std::vector<EventRecord> events_on_paper(const CircularRun& run) {
    std::vector<EventRecord> events;
    for (const EventRecord& event : run.events)
        if (event.kind != EventKind::note || event.sequence == 0) events.push_back(event);
    return events;
}

} // namespace

void draw_circular_condition_pages(Sheet& sheet,
                                   const CircularCertificate& certificate,
                                   const std::vector<StatedField>& shortened) {
    const CircularRun& run = certificate.measured.run;
    draw_conformity(sheet, certificate.conformity, circular_symbols(certificate));
    draw_conditions(sheet, certificate);
    draw_capture_effect(sheet, certificate);
    draw_temperatures(sheet, certificate);
    if (!certificate.measured.taken_elsewhere) draw_circles(sheet, certificate);
    draw_repeats(sheet, certificate);
    draw_circular_uncertainty(sheet, certificate);
    if (std::ranges::find(shortened, "Instruments", &StatedField::key) != shortened.end())
        draw_instruments(sheet, run.instruments, iso_date_of(certificate.measured));
    draw_calibrations(sheet, run.calibrations, run.channels, iso_date_of(certificate.measured));
    draw_remarks(sheet, certificate.remarks, shortened);
    draw_events(sheet, events_on_paper(run), run.opened);
    if (!certificate.measured.taken_elsewhere)
        sheet.fields(
            {{"Station", stated(run.station)}, {"Station file SHA-256", stated(run.config_hash)}},
            1);
}

} // namespace axiscal
