#pragma once
// From readings in vacuum wavelengths, or of a linear scale, to deviations at 20 degC: the only
// road from a run to metrics. Pure.

#include "analysis/positioning/completeness.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/temperature.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// What a linear scale in the laser's place did; its largest correction in the result's unit.
struct ScaleSummary {
    double resolution_um = 0, expansion_per_K = 0;
    std::optional<double> expansion_standard_uncertainty_per_K;
    double first_degC = 0, last_degC = 0, largest_correction = 0;
};

/// What compensation did to the readings; deviations in the result's unit before and after.
struct CompensationSummary {
    std::string air_formula, expansion_form;
    double refractive_index_minus_1_first = 0, refractive_index_minus_1_last = 0;
    double material_first_degC = 0, material_last_degC = 0;
    double expansion_per_K = 0;
    std::optional<double> expansion_standard_uncertainty_per_K;
    double dead_path_mm = 0, cosine_factor = 1, vacuum_wavelength_nm = 0;
    std::optional<ScaleSummary> scale; ///< then nothing was done for air, and nothing is told of it
    /// per plan order: deviation corrected for air, or for the scale's own expansion, but not to
    /// 20 degC, and after.
    std::vector<double> before, after;
    double largest_air_correction = 0, largest_material_correction = 0; ///< result unit
    std::vector<std::string> remarks; ///< e.g. air outside the range of the formula
};

/// Displacement of the reflector, away from the interferometer, since the datum.
/// @param vacuum_displacement  N lambda_v / fold since the datum, rising as the path lengthens.
/// @param n_minus_1, n_minus_1_at_datum  refractivity now and when the datum was tied.
/// From n (L_d + D) - n_0 L_d = D_vac:  D = (D_vac - (n - n_0) L_d) / n.
Length displacement_in_air(Length vacuum_displacement,
                           double n_minus_1,
                           double n_minus_1_at_datum,
                           Length dead_path);

/// 1 / cos(gamma) of a beam whose return spot walks by e over the travel L; a retroreflector
/// doubles the walk, so tan(gamma) = e / (2 L). Without a travel: 1.
double cosine_factor_of(const LaserSetup& laser);

/// True length of what a scale counts: it grows itself, and its counts with it, so that
/// D (1 + alpha_S (T_S - 20 degC)).
Length displacement_by_scale(Length counted, Expansion coefficient, Temperature scale);

/// What `displacement` would be with the material at 20 degC: D (1 - alpha dT) first order,
/// D / (1 + alpha dT) exact. They differ by D (alpha dT)^2.
Length displacement_at_20C(Length displacement,
                           Expansion coefficient,
                           Temperature material,
                           ExpansionForm form);

struct Compensated {
    RunAt20C deviations; ///< mm
    CompensationSummary summary;
    std::vector<SetAside> set_aside; ///< superseded and excluded readings, by plan order
    Completeness completeness;
    std::vector<double> targets; ///< of the whole plan, as they were given: mm or deg
};

/// Position = datum coordinate + sign * displacement at 20 degC since the datum; deviation =
/// position - target. The expansion acts on the distance from the datum, which is taken as the
/// fixed point of the material: a constant shift cancels in every parameter of ISO 230-2.
/// Air (temperature, pressure, humidity, CO2 where measured) and material are the mean of their
/// channels, each interpolated linearly in time at the middle of the point's window, and at the
/// datum for the dead path. Before the first and after the last reading the nearest one holds.
/// @errors Fault::incomplete_run, datum_lost (check_complete); environment_stale naming channel
/// and step when a channel's nearer reading is further than AirSetup::oldest, or when a kind has no
/// channel; bad_run_file for values that cannot be; refused for a rotary axis of which nothing says
/// how its angle was measured.
/// Of a linear scale (RunRecord::scale) nothing is corrected for air, dead path or beam; the
/// displacement is displacement_by_scale() with the scale's temperature of the point's time.
/// Of a rotary axis (RunRecord::rotary) position is that of rotary_position() with the air of the
/// point's time and the artefact at the position of its target; nothing expands, unit "deg".
Result<Compensated> compensate_to_20C(const RunRecord& run);
/// Excluded readings enter no row: rows then hold the readings that remain, in the order of their
/// approaches. A run that was not closed as complete gives what its readings allow: see
/// usable_readings(). @errors also Fault::incomplete_run of usable_readings() and check_points().
Result<Compensated> compensate_to_20C(const RunRecord& run, const RunRevisions& revisions);

} // namespace axiscal
