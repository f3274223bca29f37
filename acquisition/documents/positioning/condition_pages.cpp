#include "acquisition/documents/pdf/back_parts.hpp"
#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/pdf/plots.hpp"
#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>
#include <map>

namespace axiscal {
namespace {

// ---- environment ----------------------------------------------------------------------------

void draw_environment(Sheet& sheet, const Certificate& certificate) {
    const auto panels = environment_panels_of(certificate);
    constexpr double panel_height = 88;
    const double height = panel_height * static_cast<double>(panels.size());
    sheet.heading("Environment over the run", height);
    if (panels.empty()) sheet.text("No environment readings are recorded.");
    draw_environment_plot(sheet.canvas(), {Sheet::left, sheet.y(), Sheet::width, height}, panels);
    sheet.advance(height + 8);
}

void draw_environment_table(Sheet& sheet, const Certificate& certificate) {
    const std::vector<TableColumn> columns{{"Channel", "", Align::left, true},
                                           {"Place of the sensor", "", Align::left, true},
                                           {"Quantity", "", Align::left},
                                           {"Unit", "", Align::left},
                                           {"First", ""},
                                           {"Last", ""},
                                           {"Least", ""},
                                           {"Greatest", ""},
                                           {"Correction", "included"},
                                           {"Readings", ""}};
    std::vector<TableRow> rows;
    for (const EnvironmentSummary& summary : certificate.environment) {
        const ChannelPaper paper = paper_of(summary.kind, summary.medium);
        const auto value = [&](double stored) {
            return summary.readings > 0 ? fixed(stored * paper.factor, paper.decimals)
                                        : std::string{"–"};
        };
        rows.push_back({summary.channel, stated(summary.place), paper.quantity, paper.unit,
                        value(summary.first), value(summary.last), value(summary.minimum),
                        value(summary.maximum),
                        summary.by_table ? "by table"
                                         : fixed(summary.correction * paper.factor, paper.decimals),
                        std::to_string(summary.readings)});
    }
    sheet.table(columns, rows, 7);
}

// ---- compensation ---------------------------------------------------------------------------

void draw_compensation_summary(Sheet& sheet, const Certificate& certificate) {
    const CompensationSummary& done = certificate.compensation;
    const PaperUnits units = paper_units_of(certificate);
    const RunRecord& run = certificate.run;
    const std::string alpha =
        coefficient_text(done.expansion_per_K, done.expansion_standard_uncertainty_per_K);
    sheet.fields({{"Vacuum wavelength", fixed(done.vacuum_wavelength_nm, 6) + " nm"},
                  {"Refractivity n − 1, first → last", refractivity_text(done)},
                  {"Air formula", air_formula_text(done.air_formula) + ", CO\u2082 " +
                                      fixed(run.air.co2_ppm, 0) + " ppm unless measured"},
                  {"Material, first → last", fixed(done.material_first_degC, 2) + " → " +
                                                 fixed(done.material_last_degC, 2) + " °C"},
                  {"Expansion to 20 °C", expansion_form_text(done.expansion_form)},
                  {"Expansion coefficient α", alpha},
                  {"Feedback of the axis", stated(run.material.feedback)},
                  {"Dead path L\u2080", fixed(done.dead_path_mm, 1) + " mm"},
                  {"Largest correction for air",
                   units.of_deviation(done.largest_air_correction) + " " + units.deviation},
                  {"Cosine factor 1/cos γ", fixed(done.cosine_factor, 9)},
                  {"Largest correction to 20 °C",
                   units.of_deviation(done.largest_material_correction) + " " + units.deviation},
                  {"Axis datum", fixed(run.plan.datum.in(mm), 4) + " mm"}},
                 2);
}

void draw_formulas(Sheet& sheet, const Certificate& certificate) {
    const bool exact = certificate.compensation.expansion_form == "exact";
    sheet.text("Displacement in air since the datum: D = (D\u1d65 − (n − n\u2080) L\u2080) / n / "
               "cos γ, with D\u1d65 the count times the vacuum wavelength over the passes of the "
               "beam, n\u2080 the index at the datum, tan γ = e / 2L for a return spot that walks "
               "by e over the travel L.",
               note_style);
    sheet.text(exact ? "Expansion, exact: D at 20 °C = D / (1 + α (T − 20 °C))."
                     : "Expansion, first order: D at 20 °C = D (1 − α (T − 20 °C)).",
               note_style);
    sheet.text("Position = datum ± D at 20 °C. Air and material are the means of their channels, "
               "interpolated at the time of each point. The compensation is applied once, here; "
               "none is applied by the instrument.",
               note_style);
}

/// Means over the approaches of one target and direction, before and after.
struct CompensatedMean {
    double before = 0, after = 0;
    int count = 0;
};
using CompensatedMeans = std::map<std::pair<int, Direction>, CompensatedMean>;

CompensatedMeans compensated_means_of(const Certificate& certificate) {
    const auto& points = certificate.run.plan.points;
    const CompensationSummary& done = certificate.compensation;
    CompensatedMeans means;
    if (done.before.size() != points.size() || done.after.size() != points.size()) return means;
    for (std::size_t i = 0; i < points.size(); ++i) {
        CompensatedMean& mean = means[{points[i].target_index, points[i].direction}];
        mean.before += done.before[i];
        mean.after += done.after[i];
        ++mean.count;
    }
    for (auto& [cell, mean] : means) {
        mean.before /= mean.count;
        mean.after /= mean.count;
    }
    return means;
}

void draw_compensation_table(Sheet& sheet, const Certificate& certificate) {
    const CompensatedMeans means = compensated_means_of(certificate);
    if (means.empty()) {
        sheet.text("Deviations before and after: not stated");
        return;
    }
    const PaperUnits units = paper_units_of(certificate);
    std::vector<TableColumn> columns{{"i", ""}, {"Target P\u1d62", units.position}};
    std::vector<std::pair<Direction, const char*>> directions{{Direction::positive, "↑"}};
    if (!certificate.deviations.backward().empty())
        directions.push_back({Direction::negative, "↓"});
    for (const auto& [direction, arrow] : directions)
        for (const char* head : {"before ", "after ", "change "})
            columns.push_back({head + std::string{arrow}, units.deviation});
    std::vector<TableRow> rows;
    const auto& targets = certificate.deviations.targets();
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const int target = certificate.completeness.targets[i];
        TableRow cells{std::to_string(target + 1), units.of_position(targets[i])};
        for (const auto& [direction, arrow] : directions) {
            const auto mean = means.find({target, direction});
            const bool known = mean != means.end();
            cells.push_back(known ? units.of_deviation(mean->second.before) : "–");
            cells.push_back(known ? units.of_deviation(mean->second.after) : "–");
            cells.push_back(known ? units.of_deviation(mean->second.after - mean->second.before)
                                  : "–");
        }
        rows.push_back(std::move(cells));
    }
    constexpr std::size_t rows_kept_together = 25;
    sheet.advance(4);
    sheet.require(60 + 14 * static_cast<double>(std::min(rows.size(), rows_kept_together)));
    const std::string before = certificate.run.scale ? "by the scale at 20 °C" : "in air";
    sheet.text("Mean deviation per target " + before + " (before) and at 20 °C (after)",
               {7.5, true});
    sheet.table(columns, rows);
}

// ---- cycle, instruments, remarks ------------------------------------------------------------

/// "12.500 mm", or "12.500°" of a rotary axis.
std::string coordinate_text(const RunPlan& plan, Length coordinate, int decimals) {
    return fixed(coordinate.in(mm), decimals) + (plan.axis_kind == AxisKind::rotary ? "°" : " mm");
}

std::string target_rule(const RunPlan& plan) {
    if (!plan.seed) return "given list of positions";
    return "P\u1d62 = (i − 1) p + r, p = " + coordinate_text(plan, plan.interval, 3) +
           ", r random from seed " + std::to_string(*plan.seed);
}

std::string datum_text(const RunRecord& run) {
    if (run.datums.empty() || run.imported) return "not stated";
    const DatumRecord& datum = run.datums.back();
    return coordinate_text(run.plan, datum.coordinate, 4) + ", id " + stated(datum.id);
}

std::string approach_travel_text(const RunPlan& plan) {
    return plan.overrun > Length{} ? coordinate_text(plan, plan.overrun, 3) : "not stated";
}

std::string capture_tolerance_text(const RunPlan& plan) {
    if (!(plan.near_tolerance > Length{})) return "not stated";
    return "±" + coordinate_text(plan, plan.near_tolerance, 3);
}

/// The scale stands under the compensation.
std::string beam_text(const RunRecord& run) {
    if (run.imported) return "not stated: the readings are imported";
    if (run.scale) return "none: the reference is a linear scale";
    const LaserSetup& laser = run.laser;
    return fixed(laser.optical_fold, 0) + " passes, count " + (laser.sign > 0 ? "rises" : "falls") +
           " with the coordinate";
}

void draw_cycle(Sheet& sheet, const Certificate& certificate) {
    const RunRecord& run = certificate.run;
    const Statements& said = run.statements;
    sheet.heading("Cycle and conditions");
    sheet.fields(
        {{"Cycle", run.imported
                       ? "not stated"
                       : std::string{name_of(run.plan.cycle)} + ", pass: " + run.plan.pass},
         {"Approaches n", std::to_string(run.plan.approaches) +
                              (run.plan.bidirectional ? " in each direction" : " forward")},
         {"Targets", target_rule(run.plan)},
         {"Over-travel", approach_travel_text(run.plan)},
         {"Feed", stated(said.feed)},
         {"Dwell", stated(said.dwell)},
         {"Datum", datum_text(run)},
         {"Capture tolerance", capture_tolerance_text(run.plan)},
         {"Warm-up", stated(said.warm_up)},
         {"Offsets of the measuring line", stated(said.offsets)},
         {"Positions of idle axes", stated(said.idle_axes)},
         {"Note on the sensors", stated(said.sensor_note)},
         {"Station", stated(run.station)},
         {"Beam", beam_text(run)},
         {"Alignment of the beam",
          certificate.attachments.alignment ? "recorded: see below" : "not recorded"}},
        2);
    sheet.fields({{"Station file SHA-256", stated(run.config_hash)}}, 1);
    sheet.text(synchronisation_text(certificate), {7, false, grey});
}

void draw_import(Sheet& sheet, const ImportedReadings& imported) {
    sheet.heading("Imported, readings by others");
    sheet.fields(
        {{"File", imported.file},
         {"Form", imported.form},
         {"SHA-256 of the file", imported.sha256},
         {"Measured", stated(imported.measured)},
         {"Compensation", "as the other program made it, or the map of the import states it"}},
        1);
}

} // namespace

void draw_condition_pages(Sheet& sheet,
                          const Certificate& certificate,
                          const std::vector<StatedField>& shortened) {
    sheet.new_page();
    draw_conformity(sheet, certificate.conformity, positioning_symbol);
    draw_other_standards(sheet, certificate);
    draw_environment(sheet, certificate);
    draw_environment_table(sheet, certificate);
    draw_calibrations(sheet, certificate.run.calibrations, certificate.run.channels,
                      run_date_of(certificate.run));
    if (certificate.run.imported) {
        draw_import(sheet, *certificate.run.imported);
    } else if (certificate.run.rotary) {
        draw_angle(sheet, certificate);
    } else {
        sheet.heading("Compensation to 20 °C", 120);
        if (certificate.run.scale) {
            draw_scale(sheet, certificate);
        } else {
            draw_compensation_summary(sheet, certificate);
            draw_formulas(sheet, certificate);
        }
        draw_compensation_table(sheet, certificate);
    }
    if (!certificate.run.imported) draw_uncertainty(sheet, certificate);
    draw_cycle(sheet, certificate);
    draw_alignment(sheet, certificate.attachments.alignment);
    if (std::ranges::find(shortened, "Instruments", &StatedField::key) != shortened.end())
        draw_instruments(sheet, certificate.run.instruments, run_date_of(certificate.run));
    draw_remarks(sheet, certificate.remarks, shortened);
    draw_events(sheet, certificate.run.events, certificate.run.opened);
}

} // namespace axiscal
