#include "acquisition/documents/probing/probing_pages.hpp"

#include "acquisition/documents/pdf/back_parts.hpp"
#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/front_parts.hpp"
#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/probing/probing_plot.hpp"

#include <algorithm>
#include <iterator>

namespace axiscal {
namespace {

std::string feed_of_probing(const ProbingRecord& record) {
    return as_stated(record.feed_mm_per_min) + " mm/min";
}

std::string tick_text(const ProbingRecord& record) {
    const double tick_um = feed_mm_per_ms(record) * um_a_mm;
    return fixed(tick_um, length_decimals(tick_um)) + " µm";
}

/// The largest figure of all directions.
std::string main_figure(const std::vector<ProbingDelay>& results) {
    const ProbingDelay* largest = nullptr;
    for (const ProbingDelay& result : results)
        if (!result.reference && (!largest || result.variation_mm > largest->variation_mm))
            largest = &result;
    if (!largest) return "no figure";
    const double value_um = largest->variation_mm * um_a_mm;
    return largest->symbol + " = " + fixed(value_um, length_decimals(value_um)) +
           " µm, U not evaluated";
}

FrontAnswer answer_of(const ProbingResult& document) {
    const Statements& said = document.run.statements;
    return {"Probe " + stated(document.record.probe) + ", " + machine_in_answer(said),
            dates_of_test(document.run).issued_on,
            verdict_on_paper(document.conformity, symbol_as_it_is), main_figure(document.results)};
}

/// The log of a control has no clock: what is known is when it was read.
std::vector<StatedField> draw_identity(Sheet& sheet, const ProbingResult& document) {
    const RunRecord& run = document.run;
    const ProbingRecord& record = document.record;
    CertificateDates dates = dates_of_test(run);
    dates.measured = "log read " + readable_instant(iso8601_utc(run.closed.utc_ns));
    auto fields = identity_fields(run.statements, dates);
    fields.push_back({"Probing feed", feed_of_probing(record)});
    fields.push_back({"Probe", stated(record.probe)});
    fields.push_back({"Feed × 1 ms", tick_text(record)});
    fields.push_back({"Signal path", stated(record.signal_path)});
    auto shortened = sheet.fields(fields, 2, 2);
    sheet.advance(5);
    return shortened;
}

/// References stand beside the touches of their direction, or by themselves where there are none.
bool has_row(const ProbingDelay& series, const std::vector<ProbingDelay>& all) {
    return !series.reference || std::ranges::none_of(all, [&](const ProbingDelay& other) {
        return !other.reference && same_direction(other, series);
    });
}

TableRow figures_row(const ProbingDelay& found, int decimals) {
    const auto in_um = [](const std::optional<double>& value_mm, int digits) {
        return value_mm ? fixed(*value_mm * um_a_mm, digits) : std::string{"–"};
    };
    return {found.symbol,
            direction_text(found.unit_direction),
            std::to_string(found.touches),
            in_um(found.variation_mm, decimals),
            fixed(found.variation_ms, 3),
            "U not evaluated",
            in_um(found.standard_deviation_mm, decimals + 1),
            in_um(found.reference_repeatability_mm, decimals),
            in_um(found.net_variation_mm, decimals),
            found.period_ms ? fixed(*found.period_ms, 3) : "–"};
}

void draw_figures(Sheet& sheet, const std::vector<ProbingDelay>& results) {
    double largest_mm = 0;
    for (const ProbingDelay& found : results)
        largest_mm = std::max(largest_mm, found.variation_mm);
    std::vector<TableRow> rows;
    for (const ProbingDelay& found : results)
        if (has_row(found, results))
            rows.push_back(figures_row(found, length_decimals(largest_mm * um_a_mm)));
    sheet.advance(3);
    sheet.table({{"Figure", "", Align::left},
                 {"Direction", "", Align::left},
                 {"Touches", ""},
                 {"Variation", "µm"},
                 {"Variation", "ms"},
                 {"Uncertainty", "", Align::left},
                 {"s", "µm"},
                 {"E_0", "µm"},
                 {"Net", "µm"},
                 {"Saw-tooth", "ms"}},
                rows);
}

void draw_meaning(Sheet& sheet, const ProbingResult& document) {
    sheet.text("E_TD: largest minus smallest point that the control latched along the direction, "
               "over touches from growing distances; in ms: over the feed. s: standard deviation. "
               "E_0: the variation of the references, touched from one distance, which no delay "
               "effect moves. Net: √(E_TD² − E_0²), for information. Plot: touches are dots, "
               "references rings.",
               note_style);
    sheet.text("Servo tick: at " + feed_of_probing(document.record) + " the tip moves " +
                   tick_text(document.record) +
                   " in 1 ms. A control that latches at ticks of 1 ms alone shows up to that with "
                   "a probe without fault; its own cycle shows as a saw-tooth.",
               {7.5});
    for (const std::string& words : saw_tooth_words(document.results))
        sheet.text(words, {7.5});
    sheet.text("Preliminary: these figures have no uncertainty budget.",
               {7.5, true, backward_vermilion});
}

void draw_panels(Sheet& sheet, const std::vector<ProbingPanel>& panels, double height) {
    for (const ProbingPanel& panel : panels) {
        sheet.require(height);
        draw_probing_panel(sheet.canvas(), {Sheet::left, sheet.y(), Sheet::width, height}, panel);
        sheet.advance(height);
    }
}

/// @returns whether the panels had room above the signatures.
bool draw_front_panels(Sheet& sheet, const std::vector<ProbingPanel>& panels) {
    constexpr double largest = 130;
    const double room = sheet.remaining() - signature_height - 6;
    const auto count = static_cast<double>(panels.size());
    if (panels.empty() || room < count * least_panel_height) return false;
    draw_panels(sheet, panels, std::min(room / count, largest));
    return true;
}

std::vector<TableRow> touch_rows(const ProbingTrace& trace, const ProbingResult& document) {
    const auto [low, high] = std::ranges::minmax_element(trace.offset_um);
    const double um_per_ms = feed_mm_per_ms(document.record) * um_a_mm;
    std::vector<TableRow> rows;
    for (std::size_t i = 0; i < trace.offset_um.size(); ++i) {
        const ProbingTouch& touch = document.record.touches[trace.first_touch + i];
        const auto at = trace.offset_um.begin() + static_cast<std::ptrdiff_t>(i);
        const bool varies = *low < *high;
        rows.push_back({std::to_string(trace.first_touch + i + 1),
                        direction_text(trace.figures->unit_direction),
                        touch.reference ? "reference" : "touch", fixed(touch.approach.in(mm), 4),
                        fixed(touch.latched[0].in(mm), 6), fixed(touch.latched[1].in(mm), 6),
                        fixed(touch.latched[2].in(mm), 6), fixed(*at, 3), fixed(*at / um_per_ms, 3),
                        varies && at == low    ? "smallest"
                        : varies && at == high ? "largest"
                                               : ""});
    }
    return rows;
}

void draw_touch_table(Sheet& sheet,
                      const std::vector<ProbingTrace>& traces,
                      const ProbingResult& document) {
    std::vector<TableRow> rows;
    for (const ProbingTrace& trace : traces)
        std::ranges::move(touch_rows(trace, document), std::back_inserter(rows));
    sheet.heading("Every touch");
    sheet.table({{"No.", ""},
                 {"Direction", "", Align::left},
                 {"Kind", "", Align::left},
                 {"Distance a", "mm"},
                 {"Latched X", "mm"},
                 {"Latched Y", "mm"},
                 {"Latched Z", "mm"},
                 {"Offset", "µm"},
                 {"Offset", "ms"},
                 {"In its series", "", Align::left}},
                rows, 7);
    sheet.text("a: from the start to the zeroed face. Offset: along the direction, against the "
               "smallest point that touches from growing distances latched in it, so that a later "
               "latch is larger; in ms: over the feed.",
               note_style);
}

std::string distances_of(const ProbingRecord& record) {
    if (record.touches.empty()) return "none";
    const auto [low, high] = std::ranges::minmax_element(
        record.touches, {}, [](const ProbingTouch& touch) { return touch.approach.in(mm); });
    return fixed(low->approach.in(mm), 4) + " to " + fixed(high->approach.in(mm), 4) + " mm";
}

} // namespace

ProbingFront draw_probing_front_page(Sheet& sheet, const ProbingResult& document) {
    const RunRecord& run = document.run;
    draw_front_title(sheet, {"Probing test", run.statements.state,
                             "Variation of the time delay of a touch probe, by ISO 230-10, 6.9¹",
                             answer_of(document)});
    ProbingFront front;
    front.shortened = draw_identity(sheet, document);
    draw_figures(sheet, document.results);
    draw_meaning(sheet, document);
    sheet.advance(6);
    const auto traces = probing_traces_of(document);
    front.plotted = draw_front_panels(sheet, probing_panels_of(traces));
    sheet.require(signature_height + 4);
    draw_signatures(sheet, run.statements,
                    {{"Run", stated(run.run_id)},
                     {"Run file SHA-256", stated(document.run_file_sha256)},
                     {"Result SHA-256", stated(document.result_digest)},
                     {"Software", "axiscal, version " + stated(run.software_version)}},
                    "Traceability: the figures are differences of positions of the machine's own "
                    "control; no instrument took part.");
    return front;
}

void draw_probing_touches(Sheet& sheet, const ProbingResult& document, const ProbingFront& front) {
    sheet.new_page();
    const auto traces = probing_traces_of(document);
    const auto panels = probing_panels_of(traces);
    if (!front.plotted && !panels.empty()) {
        constexpr double usual = 130;
        sheet.heading("Latched points against the approach distance", usual);
        draw_panels(sheet, panels, usual);
    }
    draw_touch_table(sheet, traces, document);
}

void draw_probing_conditions(Sheet& sheet,
                             const ProbingResult& document,
                             const ProbingFront& front) {
    const RunRecord& run = document.run;
    draw_conformity(sheet, document.conformity, symbol_as_it_is);
    const auto references =
        std::ranges::count(document.record.touches, true, &ProbingTouch::reference);
    const auto all = static_cast<std::ptrdiff_t>(document.record.touches.size());
    sheet.heading("Test and conditions");
    sheet.fields({{"Touches from growing distances", std::to_string(all - references)},
                  {"References", std::to_string(references)},
                  {"Approach distances", distances_of(document.record)},
                  {"Warm-up", stated(run.statements.warm_up)},
                  {"Station", stated(run.station)}},
                 2);
    sheet.fields({{"Station file SHA-256", stated(run.config_hash)}}, 1);
    sheet.text("¹ Purpose and set-up are those of ISO 230-10, 6.9; the operator states counts and "
               "steps, and this station names the symbols. They were not compared with the printed "
               "clause. The constant part of the delay is absorbed where the stylus is "
               "calibrated at the same feed, and is not seen here. The figures hold for this feed.",
               note_style);
    std::vector<std::string> remarks;
    if (!run.plan.remark.empty()) remarks.push_back(run.plan.remark);
    draw_remarks(sheet, remarks, front.shortened);
    draw_events(sheet, run.events, run.opened);
}

std::vector<std::string> saw_tooth_words(const std::vector<ProbingDelay>& results) {
    std::string found;
    std::vector<std::pair<std::string, std::string>> lacking; // reason, symbols
    for (const ProbingDelay& series : results) {
        if (series.reference) continue;
        if (series.period_ms) {
            found += (found.empty() ? "" : ", ") + series.symbol + " " +
                     fixed(*series.period_ms, 3) + " ms (standard uncertainty " +
                     fixed_up(series.period_standard_uncertainty_ms.value_or(0), 3) + " ms)";
            continue;
        }
        const auto same = std::ranges::find(lacking, series.no_period,
                                            &std::pair<std::string, std::string>::first);
        if (same == lacking.end())
            lacking.emplace_back(series.no_period, series.symbol);
        else
            same->second += ", " + series.symbol;
    }
    std::vector<std::string> words;
    if (!found.empty())
        words.push_back("Saw-tooth found: " + found +
                        ". The control latches at ticks of its own, that far apart.");
    for (const auto& [reason, symbols] : lacking)
        words.emplace_back(symbols).append(": no period is stated: ").append(reason).append(".");
    return words;
}

} // namespace axiscal
