// How a linear scale measured the axis: count, own expansion, formula.
#include "acquisition/documents/positioning/certificate_pages.hpp"

namespace axiscal {
namespace {

std::string from_to_degC(double first, double last) {
    return fixed(first, 2) + " → " + fixed(last, 2) + " °C";
}

void draw_scale_formulas(Sheet& sheet, const CompensationSummary& done) {
    sheet.text("Reference: linear scale. Nothing is corrected for air. True length since the "
               "datum: D = C (1 + β (S − 20 °C)), with C the count times the length of one, β the "
               "coefficient of the scale and S its temperature.",
               note_style);
    sheet.text(done.expansion_form == "exact"
                   ? "Expansion, exact: D at 20 °C = D / (1 + α (T − 20 °C))."
                   : "Expansion, first order: D at 20 °C = D (1 − α (T − 20 °C)).",
               note_style);
    sheet.text("Position = datum ± D at 20 °C. Scale and material are the means of their channels, "
               "interpolated at the time of each point. The compensation is applied once, here; "
               "none is applied by the instrument.",
               note_style);
}

} // namespace

void draw_scale(Sheet& sheet, const Certificate& certificate) {
    const CompensationSummary& done = certificate.compensation;
    const PaperUnits units = paper_units_of(certificate);
    const RunRecord& run = certificate.run;
    const ScaleSummary scale = done.scale.value_or(ScaleSummary{});
    sheet.fields(
        {{"Reference", "linear scale, " + fixed(scale.resolution_um, 4) + " µm a count"},
         {"Count of the scale",
          std::string{run.laser.sign > 0 ? "rises" : "falls"} + " with the coordinate"},
         {"Scale, first → last", from_to_degC(scale.first_degC, scale.last_degC)},
         {"Material, first → last",
          from_to_degC(done.material_first_degC, done.material_last_degC)},
         {"Coefficient β of the scale",
          coefficient_text(scale.expansion_per_K, scale.expansion_standard_uncertainty_per_K)},
         {"Expansion coefficient α",
          coefficient_text(done.expansion_per_K, done.expansion_standard_uncertainty_per_K)},
         {"Largest scale correction",
          units.of_deviation(scale.largest_correction) + " " + units.deviation},
         {"Largest correction to 20 °C",
          units.of_deviation(done.largest_material_correction) + " " + units.deviation},
         {"Expansion to 20 °C", expansion_form_text(done.expansion_form)},
         {"Feedback of the axis", stated(run.material.feedback)},
         {"Axis datum", fixed(run.plan.datum.in(mm), 4) + " mm"}},
        2);
    draw_scale_formulas(sheet, done);
}

} // namespace axiscal
