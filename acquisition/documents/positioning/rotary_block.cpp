// How the angle of a rotary axis was measured: artefact, instrument, formula, set-up.
#include "acquisition/documents/positioning/certificate_pages.hpp"
#include "analysis/rotary/rotary_position.hpp"

#include <algorithm>

namespace axiscal {
namespace {

std::string artefact_text(const RotarySetup& rotary) {
    const std::string positions = std::to_string(positions_of_a_turn(rotary));
    return rotary.method == AngleMethod::polygon
               ? "polygon, " + positions + " faces, read by an autocollimator"
               : "indexing table, " + positions + " positions of " + fixed(rotary.step_deg, 4) +
                     "°, under an angular interferometer";
}

std::string deviation_text(const RotarySetup& rotary) {
    if (rotary.deviations_arcsec.empty()) return "not stated, taken as 0";
    const auto [low, high] = std::ranges::minmax(rotary.deviations_arcsec);
    return fixed(low, 2) + "″ to " + fixed(high, 2) + "″, taken out; counted " +
           (rotary.certificate_with_axis ? "with" : "against") + " the axis";
}

/// `typed`: by a person; else the autocollimator is an instrument of the station.
std::string faces_text(bool typed) {
    return std::string{typed ? "At each target a person read the face that stands before the "
                               "autocollimator and typed the reading a: "
                             : "At each target the autocollimator was read in a still window: a is "
                               "what it showed of the face before it; "} +
           "angle = k 360° / faces + a − (d(k) − d(0)) with the certified deviation d(k) of "
           "face k. Nothing shows " +
           (typed ? "that the axis stood still, or from which side it came"
                  : "from which side the axis came") +
           ". An angle does not expand: nothing was brought to 20 °C.";
}

} // namespace

void draw_angle(Sheet& sheet, const Certificate& certificate) {
    const RotarySetup& rotary = *certificate.run.rotary;
    const CompensationSummary& done = certificate.compensation;
    const PaperUnits units = paper_units_of(certificate);
    const bool table = rotary.method == AngleMethod::indexing_table;
    sheet.heading("Measurement of the angle", 110);
    std::vector<StatedField> fields{{"Artefact", artefact_text(rotary)},
                                    {"Certified deviations", deviation_text(rotary)},
                                    {"Run-out of the set-up", stated(rotary.run_out)},
                                    {"Largest angle read", "±" + fixed(rotary.range_deg, 3) + "°"}};
    if (table) {
        fields.push_back({"Distance of the reflectors S", fixed(rotary.arm.in(mm), 4) + " mm"});
        fields.push_back({"Vacuum wavelength", fixed(done.vacuum_wavelength_nm, 6) + " nm"});
        fields.push_back({"Refractivity n − 1, first → last", refractivity_text(done)});
        fields.push_back({"Air formula", air_formula_text(done.air_formula)});
        fields.push_back({"Largest correction for air",
                          units.of_deviation(done.largest_air_correction) + " " + units.deviation});
    }
    sheet.fields(fields, 1);
    sheet.text(
        table ? "At each target the table was turned back by k of its steps: angle = angle at the "
                "datum + k step + rest − (d(k) − d(0)), rest = asin((D − D\u2080) / (n S)) "
                "with the displacement D between the reflectors in vacuum wavelengths and the "
                "certified deviation d(k) of the table. The counting of the interferometer was "
                "unbroken from the datum to the last target. An angle does not expand: nothing was "
                "brought to 20 °C."
              : faces_text(certificate.run.laser.instrument.empty()),
        note_style);
}

} // namespace axiscal
