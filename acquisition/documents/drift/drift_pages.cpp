#include "acquisition/documents/drift/drift_pages.hpp"

#include "acquisition/documents/drift/drift_plot.hpp"
#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "analysis/quantity/counted.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>

namespace axiscal {
namespace {

FrontAnswer answer_of(const DriftResult& document) {
    const RunRecord& run = document.run;
    const RunDrift& drift = document.drift;
    const std::string value = fixed(drift.eve.range, length_decimals(drift.eve.range));
    return {drift_subject_text(document) + ", " + machine_in_answer(run.statements),
            dates_of_test(run).issued_on, verdict_on_paper(document.conformity, symbol_as_it_is),
            "E_VE = " + value + " " + drift_unit_on_paper(drift) + ", U not evaluated"};
}

std::vector<StatedField> draw_identity(Sheet& sheet, const DriftResult& document) {
    const RunRecord& run = document.run;
    auto fields = identity_fields(run.statements, dates_of_test(run));
    if (document.drift.of_bar) {
        fields.push_back({"Ballbar", full_name_of(document.drift.reading) + ", at rest; plane " +
                                         stated(run.statements.axis)});
        fields.push_back({"Reference temperature", "none: taken as read"});
    } else {
        fields.push_back(
            {"Axis", stated(run.statements.axis) + ", at rest at " + drift_place_text(document)});
        fields.push_back({"Reference temperature", run.rotary ? "none: an angle does not expand"
                                                              : "20 °C; E_VE and ETVE hold there"});
    }
    auto shortened = sheet.fields(fields, 2, 2);
    sheet.advance(5);
    return shortened;
}

void draw_figures(Sheet& sheet, const RunDrift& drift) {
    const int decimals = length_decimals(drift.eve.range);
    const auto minute = [&](std::size_t index) { return fixed(drift.axis.times[index], 2); };
    const auto row = [&](const char* symbol, const std::string& words, const DriftRange& found) {
        return TableRow{symbol, words, fixed(found.range, decimals), minute(found.first),
                        minute(found.last)};
    };
    const std::string hour = fixed(drift.window_min, 0) + " min";
    std::vector<TableRow> rows{
        row("E_VE", "Environmental variation: range over the whole test", drift.eve),
        {"u(E_VE)", "Standard uncertainty from it, E_VE / (2 √3)",
         fixed_up(drift.eve.u_eve, decimals), "", ""},
        row("ETVE", "Largest range within any " + hour, drift.window),
        {"", "Last reading against the first", fixed(drift.end_change, decimals), "", ""},
        {"", "Slope of the straight line through all readings, in an hour",
         drift.slope_per_h ? fixed(*drift.slope_per_h, decimals) : "–", "", ""}};
    if (!drift.of_bar)
        rows.push_back({"", "Range as read, without any compensation",
                        fixed(drift.as_read.range, decimals), "", ""});
    sheet.advance(3);
    sheet.table({{"", "", Align::left},
                 {"Figure", "", Align::left},
                 {"Value, " + drift_unit_on_paper(drift), ""},
                 {"From, min", ""},
                 {"To, min", ""}},
                rows);
}

/// What a reading of the axis needs beside it.
const char* surroundings_words(const RunRecord& run) {
    if (run.rotary) return "air";
    return run.scale ? "temperature of scale and material" : "air or material";
}

std::string refused_text(const RefusedReadings& refused) {
    const bool one = refused.count == 1;
    const std::string from = fixed(refused.first_min, 2) + " min";
    return counted(refused.count, "reading") +
           (one ? " at " + from : " from " + from + " to " + fixed(refused.last_min, 2) + " min") +
           " cannot be evaluated and " +
           (one ? "is left out. The reason: " : "are left out. The first: ") + refused.reason +
           (refused.reason.ends_with('.') ? " " : ". ");
}

/// Intervals that the figures do not know.
std::string gaps_text(const DriftResult& document) {
    const RunDrift& drift = document.drift;
    std::string words;
    if (drift.missing > 0)
        words = std::to_string(drift.missing) + " of " +
                std::to_string(drift.setup.duration / drift.setup.interval) +
                " intervals have no good reading of the length. ";
    if (drift.without_air > 0)
        words +=
            counted(drift.without_air, "reading") + " without fresh " +
            surroundings_words(document.run) +
            (drift.without_air == 1 ? " beside it is left out. " : " beside them are left out. ");
    for (const RefusedReadings& refused : drift.refused)
        words += refused_text(refused);
    if (!drift.refused.empty())
        words += "They may have been the extremes: E_VE and ETVE may be too small, and no budget "
                 "takes E_VE of this test.";
    return words;
}

/// @param by  of the paper that the budget follows
std::string budget_text(const RunDrift& drift, const char* of_what, const std::string& by) {
    const char* rest = " of this test is informative.";
    if (!drift.refused.empty()) return std::string{"Every figure and channel"} + rest;
    return std::string{"The budget of later "} + of_what + " takes E_VE (" + by +
           "); every other figure and channel" + rest;
}

std::string bar_rule_text(const DriftResult& document) {
    return "E_VE: largest minus smallest reading of the ballbar at rest. ETVE: the same within an "
           "hour. Positive changes: the reading rises. It is taken as it is, as in a circular "
           "test; neither air nor expansion is taken out. All of it is the environment's share: "
           "machine, bar and set-up together. " +
           budget_text(document.drift, "circular tests", drift_budget_by(document));
}

std::string rule_text(const DriftResult& document) {
    if (document.drift.of_bar) return bar_rule_text(document);
    const bool rotary = document.run.rotary.has_value();
    return std::string{"E_VE: largest minus smallest coordinate of the resting axis"} +
           (rotary ? "" : " at 20 °C") +
           ", as a run would have given it. ETVE: the same within an hour. Positive changes go "
           "towards + of the coordinate. " +
           (rotary ? "What is left after the air is taken out"
                   : "What is left after the compensation") +
           " is the environment's share: machine, set-up and sensors together. " +
           budget_text(document.drift, "runs",
                       std::string{"ISO 230-2, annex "} + (rotary ? "B" : "A"));
}

void draw_rule(Sheet& sheet, const DriftResult& document) {
    const RunDrift& drift = document.drift;
    sheet.text(rule_text(document), note_style);
    const auto& times = drift.axis.times;
    if (times.back() - times.front() < drift.window_min)
        sheet.text("The test is shorter than " + fixed(drift.window_min, 0) +
                       " min: ETVE is the range of the whole test.",
                   note_style);
    if (const std::string gaps = gaps_text(document); !gaps.empty())
        sheet.text(gaps, {7.5, true, backward_vermilion});
}

} // namespace

std::string duration_text(Duration duration) {
    using namespace std::chrono_literals;
    constexpr std::pair<Duration, const char*> units[]{{1h, " h"}, {1min, " min"}, {1s, " s"}};
    for (const auto& [unit, name] : units)
        if (duration >= unit && duration % unit == Duration{})
            return std::to_string(duration / unit) + name;
    return fixed(seconds_of(duration), 3) + " s";
}

std::string drift_subject_text(const DriftResult& document) {
    const std::string axis = stated(document.run.statements.axis);
    if (!document.drift.of_bar) return "axis " + axis;
    return "ballbar, plane " + axis;
}

std::string drift_place_text(const DriftResult& document) {
    return fixed(document.drift.setup.place.in(mm), 3) + (document.run.rotary ? "°" : " mm");
}

std::vector<StatedField> draw_drift_front_page(Sheet& sheet, const DriftResult& document) {
    const RunRecord& run = document.run;
    const RunDrift& drift = document.drift;
    const std::string rested = drift.of_bar ? "(ISO/TR 230-9) and ETVE (ISO 230-3) of a ballbar"
                               : run.rotary ? "(ISO 230-2) and ETVE (ISO 230-3) of a rotary axis"
                                            : "(ISO 230-2) and ETVE (ISO 230-3) of a linear axis";
    draw_front_title(sheet, {"Drift test", run.statements.state,
                             "Environmental variation E_VE " + rested + " at rest, " +
                                 duration_text(drift.setup.duration) + ", a reading each " +
                                 duration_text(drift.setup.interval),
                             answer_of(document)});
    auto shortened = draw_identity(sheet, document);
    draw_front_instruments(sheet, run.instruments, run_date_of(run), shortened);
    draw_figures(sheet, drift);
    draw_rule(sheet, document);
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

} // namespace axiscal
