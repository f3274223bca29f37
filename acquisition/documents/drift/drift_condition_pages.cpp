// What a drift test was made with, and what happened meanwhile.
#include "acquisition/documents/drift/drift_pages.hpp"
#include "acquisition/documents/pdf/back_parts.hpp"
#include "acquisition/documents/pdf/conformity_block.hpp"
#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "analysis/drift/resting_axis.hpp"
#include "analysis/record/certificate_expiry.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

/// What read the resting axis; three fields each.
std::array<StatedField, 3> fields_of_laser(const RunRecord& run) {
    const bool ciddor = run.air.formula == AirFormula::ciddor;
    return {{{"Vacuum wavelength", fixed(run.laser.vacuum_wavelength.in(nm), 6) + " nm"},
             {"Air formula", air_formula_text(ciddor ? "ciddor" : "edlen") + ", CO\u2082 " +
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

std::array<StatedField, 3> fields_of_table(const RunRecord& run, const RotarySetup& rotary) {
    return {{{"Vacuum wavelength", fixed(run.laser.vacuum_wavelength.in(nm), 6) + " nm"},
             {"Distance of the reflectors S", fixed(rotary.arm.in(mm), 4) + " mm"},
             {"Step of the indexing table", fixed(rotary.step_deg, 4) + "°"}}};
}

std::array<StatedField, 3> fields_of_reference(const RunRecord& run) {
    if (run.rotary) return fields_of_table(run, *run.rotary);
    return run.scale ? fields_of_scale(*run.scale) : fields_of_laser(run);
}

std::string carried_text(const RunRecord& run, bool of_bar) {
    if (of_bar) return " and is taken as it is, as in a circular test. ";
    if (run.rotary)
        return " and becomes an angle as every point of a run does, with the reflectors taken as "
               "square to the beam while the axis stands at its datum. An angle does not expand. ";
    return std::string{" and is carried to 20 °C as every point of a run is, "} +
           (run.scale ? "scale and material on the distance from the datum. "
                      : "air on the whole path from the interferometer (dead path included), "
                        "material on the distance from the datum. ");
}

/// What a material has to do with it.
std::array<StatedField, 2> fields_of_material(const RunRecord& run) {
    if (run.rotary)
        return {{{"Expansion coefficient α", "none: an angle does not expand"},
                 {"Table", std::string{run.rotary->by_hand ? "turned by hand" : "driven"} +
                               "; not turned during the test"}}};
    const auto& stated_u = run.material.standard_uncertainty;
    const auto u_per_K = stated_u ? std::optional{stated_u->si()} : std::nullopt;
    return {{{"Expansion coefficient α", coefficient_text(run.material.coefficient.si(), u_per_K)},
             {"Feedback of the axis", stated(run.material.feedback)}}};
}

std::string drift_datum_text(const RunRecord& run) {
    return fixed(run.plan.datum.in(mm), 4) + (run.rotary ? "°" : " mm");
}

std::string readings_of_planned(const RunDrift& drift) {
    return std::to_string(drift.axis.times.size()) + " of " +
           std::to_string(drift.setup.duration / drift.setup.interval);
}

std::vector<StatedField> fields_of_bar_test(const DriftResult& document) {
    const Statements& said = document.run.statements;
    const RunDrift& drift = document.drift;
    return {{"Ballbar", full_name_of(drift.reading)},
            {"Plane", stated(said.axis)},
            {"Duration", duration_text(drift.setup.duration)},
            {"Interval", duration_text(drift.setup.interval)},
            {"Readings of the length", readings_of_planned(drift)},
            {"Compensation", "none: as read"},
            {"Warm-up", stated(said.warm_up)},
            {"Positions of idle axes", stated(said.idle_axes)},
            {"Note on the sensors", stated(said.sensor_note)},
            {"Station", stated(document.run.station)}};
}

std::vector<StatedField> fields_of_axis_test(const DriftResult& document) {
    const RunRecord& run = document.run;
    const Statements& said = run.statements;
    const RunDrift& drift = document.drift;
    const auto reference = fields_of_reference(run);
    const auto material = fields_of_material(run);
    return {{"Place of rest", drift_place_text(document)},
            {"Duration", duration_text(drift.setup.duration)},
            {"Interval", duration_text(drift.setup.interval)},
            {"Readings of the length", readings_of_planned(drift)},
            reference[0],
            reference[1],
            material[0],
            material[1],
            reference[2],
            {"Axis datum", drift_datum_text(run)},
            {"Warm-up", stated(said.warm_up)},
            {"Positions of idle axes", stated(said.idle_axes)},
            {"Offsets of the measuring line", stated(said.offsets)},
            {"Note on the sensors", stated(said.sensor_note)},
            {"Station", stated(run.station)},
            {"Alignment of the beam",
             document.attachments.alignment ? "recorded: see below" : "not recorded"}};
}

void draw_setup(Sheet& sheet, const DriftResult& document) {
    const RunRecord& run = document.run;
    const bool of_bar = document.drift.of_bar;
    sheet.heading("Test and conditions");
    sheet.fields(of_bar ? fields_of_bar_test(document) : fields_of_axis_test(document), 2);
    sheet.fields({{"Station file SHA-256", stated(run.config_hash)}}, 1);
    const std::string_view watched = of_bar ? "ballbar" : reference_word_of(run);
    sheet.text("Each reading of the " + std::string{watched} +
                   " is a mean over the capture window" + (of_bar ? "" : " of the station file") +
                   carried_text(run, of_bar) + "Other channels are as last read in each interval.",
               note_style);
}

} // namespace

void draw_drift_conditions(Sheet& sheet,
                           const DriftResult& document,
                           const std::vector<StatedField>& shortened) {
    draw_conformity(sheet, document.conformity, symbol_as_it_is);
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
