#include "analysis/compensation/thermal_compensation.hpp"

#include "analysis/air/air_refraction.hpp"
#include "analysis/compensation/environment_history.hpp"
#include "analysis/compensation/run_at_20C_maker.hpp"
#include "analysis/positioning/completeness.hpp"
#include "analysis/rotary/rotary_position.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace axiscal {
namespace {

MonotonicTime middle_of_window(const PointRecord& point) {
    return point.window_begin + (point.window_end - point.window_begin) / 2;
}

/// The decimal that the operator gave, where the Length holds just that: 123.456 instead of
/// 123.45600000000002.
double millimetres_as_given(Length length) {
    const double plain = length.in(mm);
    const double decimal = std::round(plain * 1e7) / 1e7;
    return mm(decimal) == length ? decimal : plain;
}

Result<void> check_rotary(const RotarySetup& setup) {
    const bool table = setup.method == AngleMethod::indexing_table;
    if (!(setup.step_deg > 0) || !(setup.range_deg > 0) || (table && !(setup.arm > Length{})))
        return fail(Fault::bad_run_file,
                    "step, range or arm of the angle's artefact is not above 0");
    for (const double deviation : setup.deviations_arcsec)
        if (!std::isfinite(deviation))
            return fail(Fault::bad_run_file, "a certified deviation of the artefact is no number");
    return {};
}

Result<void> check_setup(const RunRecord& run) {
    const bool rotary = run.plan.axis_kind == AxisKind::rotary;
    if (rotary && !run.rotary)
        return fail(
            Fault::refused,
            "a rotary axis has no length to bring to 20 degC, and the run file does not say "
            "how its angle was measured");
    if (!rotary && run.rotary)
        return fail(Fault::bad_run_file, "a linear axis has no artefact of angles");
    if (rotary && run.scale)
        return fail(Fault::bad_run_file, "a rotary axis is not measured by a linear scale");
    if (run.scale && !std::isfinite(run.scale->coefficient.si()))
        return fail(Fault::bad_run_file, "the expansion coefficient of the scale is not a number");
    if (run.laser.sign != 1 && run.laser.sign != -1)
        return fail(Fault::bad_run_file, "the sign of the laser is neither +1 nor -1");
    if (!(run.laser.dead_path >= Length{}))
        return fail(Fault::bad_run_file, "the dead path of the laser is negative");
    if (!std::isfinite(run.material.coefficient.si()))
        return fail(Fault::bad_run_file, "the expansion coefficient is not a number");
    return rotary ? check_rotary(*run.rotary) : Result<void>{};
}

/// One point on its way: axis coordinates in the three stages.
struct CompensatedPoint {
    Length uncorrected; ///< as if in vacuum, or as the scale counts
    Length true_length; ///< along the axis, with the machine as warm as it is
    Length at_20C;
    double n_minus_1 = 0;
    Temperature material;
    Temperature scale; ///< of the scale that measured it
};

/// Carries what is the same for all points of a run, and gathers the remarks. Pure.
class Compensation {
public:
    Compensation(const RunRecord& run, const DatumRecord& datum)
        : run_{run}
        , datum_{datum}
        , environment_{run}
        , cosine_factor_{cosine_factor_of(run.laser)} {}

    /// Must come first: the dead path needs the index at the datum.
    Result<void> tie_datum() {
        if (!needs_air()) return {};
        AXISCAL_TRY(n_minus_1_at_datum_, refractivity_at(datum_.at, "the datum"));
        return {};
    }

    Result<CompensatedPoint> apply(const PointRecord& point) {
        const std::string what = "step " + std::to_string(point.planned.step + 1);
        const MonotonicTime at = middle_of_window(point);
        if (!std::isfinite(point.reading.si()))
            return fail(Fault::bad_run_file, what + ": the reading is not a number");
        if (run_.rotary) return angle_of(point, at, what);
        return run_.scale ? by_scale(point, at, what) : by_laser(point, at, what);
    }

    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

private:
    /// An autocollimator counts no wavelengths, nor does a scale.
    [[nodiscard]] bool needs_air() const {
        if (run_.scale) return false;
        return !run_.rotary || run_.rotary->method == AngleMethod::indexing_table;
    }

    Result<CompensatedPoint>
    by_laser(const PointRecord& point, MonotonicTime at, const std::string& what) {
        CompensatedPoint out;
        AXISCAL_TRY(out.n_minus_1, refractivity_at(at, what));
        AXISCAL_TRY(out.material, environment_.material_at(at, what));
        const Length vacuum = point.reading - datum_.reading;
        const Length in_air =
            displacement_in_air(vacuum, out.n_minus_1, n_minus_1_at_datum_, run_.laser.dead_path) *
            cosine_factor_;
        out.uncorrected = coordinate_of(vacuum * cosine_factor_);
        carry_to_20C(out, in_air);
        return out;
    }

    Result<CompensatedPoint>
    by_scale(const PointRecord& point, MonotonicTime at, const std::string& what) {
        CompensatedPoint out;
        AXISCAL_TRY(out.scale, environment_.scale_at(at, what));
        AXISCAL_TRY(out.material, environment_.material_at(at, what));
        const Length counted = point.reading - datum_.reading;
        out.uncorrected = coordinate_of(counted);
        carry_to_20C(out, displacement_by_scale(counted, run_.scale->coefficient, out.scale));
        return out;
    }

    /// `length`: true displacement since the datum, with the machine as warm as it is.
    void carry_to_20C(CompensatedPoint& out, Length length) const {
        out.true_length = coordinate_of(length);
        out.at_20C = coordinate_of(displacement_at_20C(length, run_.material.coefficient,
                                                       out.material, run_.material.form));
    }

    /// Air acts on the rest alone; an angle does not expand.
    Result<CompensatedPoint>
    angle_of(const PointRecord& point, MonotonicTime at, const std::string& what) {
        CompensatedPoint out;
        out.material = reference_temperature;
        if (needs_air()) {
            AXISCAL_TRY(out.n_minus_1, refractivity_at(at, what));
        }
        const Length target =
            run_.plan.targets[static_cast<std::size_t>(point.planned.target_index)];
        const int index = artefact_index(*run_.rotary, datum_.coordinate, target);
        const auto position = [&](double n_minus_1) {
            return rotary_position(*run_.rotary, run_.laser.sign, datum_, point.reading, n_minus_1,
                                   index);
        };
        const auto in_vacuum = position(0), in_air = position(out.n_minus_1);
        for (const auto* found : {&in_vacuum, &in_air})
            if (!*found) return fail(Fault::bad_run_file, what + ": " + found->error().detail);
        out.uncorrected = *in_vacuum;
        out.true_length = out.at_20C = *in_air;
        return out;
    }

    Result<double> refractivity_at(MonotonicTime at, const std::string& what) {
        AXISCAL_TRY(const AirState air, environment_.air_at(at, what));
        const auto found = refractivity_of(run_.air.formula, air);
        if (!found)
            return fail(Fault::bad_run_file,
                        what + ": " + found.error().field + " " + found.error().detail);
        for (const std::string& remark : found->remarks)
            if (std::ranges::find(remarks_, remark) == remarks_.end()) remarks_.push_back(remark);
        return found->n_minus_1;
    }

    [[nodiscard]] Length coordinate_of(Length displacement) const {
        return datum_.coordinate + (run_.laser.sign > 0 ? displacement : -displacement);
    }

    const RunRecord& run_;
    const DatumRecord& datum_;
    EnvironmentHistory environment_;
    double n_minus_1_at_datum_ = 0;
    double cosine_factor_;
    std::vector<std::string> remarks_;
};

void remark_on_artefact(const RotarySetup& setup, std::vector<std::string>& remarks) {
    if (!setup.deviations_arcsec.empty()) return;
    remarks.emplace_back(setup.method == AngleMethod::polygon
                             ? "The certified deviations of the polygon's faces are not stated: "
                               "they are taken as 0."
                             : "The certified deviations of the indexing table are not stated: "
                               "they are taken as 0.");
}

ScaleSummary summary_of_scale(const ScaleSetup& scale) {
    ScaleSummary summary;
    summary.resolution_um = scale.resolution.in(um);
    summary.expansion_per_K = scale.coefficient.si();
    if (scale.standard_uncertainty)
        summary.expansion_standard_uncertainty_per_K = scale.standard_uncertainty->si();
    return summary;
}

CompensationSummary summary_of_setup(const RunRecord& run) {
    CompensationSummary summary;
    if (!run.scale) {
        summary.air_formula = name_of(run.air.formula);
        summary.vacuum_wavelength_nm = run.laser.vacuum_wavelength.in(nm);
    }
    if (run.rotary) { // the rest keeps the values of a length that does not expand
        summary.material_first_degC = summary.material_last_degC =
            reference_temperature.in_celsius();
        remark_on_artefact(*run.rotary, summary.remarks);
        return summary;
    }
    if (run.scale) summary.scale = summary_of_scale(*run.scale);
    summary.expansion_form = name_of(run.material.form);
    summary.expansion_per_K = run.material.coefficient.si();
    if (run.material.standard_uncertainty)
        summary.expansion_standard_uncertainty_per_K = run.material.standard_uncertainty->si();
    if (run.scale) return summary;
    summary.dead_path_mm = run.laser.dead_path.in(mm);
    summary.cosine_factor = cosine_factor_of(run.laser);
    return summary;
}

void add_to_summary(CompensationSummary& summary, const CompensatedPoint& point, Length target) {
    if (summary.after.empty()) {
        summary.refractive_index_minus_1_first = point.n_minus_1;
        summary.material_first_degC = point.material.in_celsius();
        if (summary.scale) summary.scale->first_degC = point.scale.in_celsius();
    }
    if (summary.scale) summary.scale->last_degC = point.scale.in_celsius();
    summary.refractive_index_minus_1_last = point.n_minus_1;
    summary.material_last_degC = point.material.in_celsius();
    summary.before.push_back((point.true_length - target).in(mm));
    summary.after.push_back((point.at_20C - target).in(mm));
    const double reference_mm = abs(point.true_length - point.uncorrected).in(mm);
    const double material_mm = abs(point.at_20C - point.true_length).in(mm);
    double& largest =
        summary.scale ? summary.scale->largest_correction : summary.largest_air_correction;
    largest = std::max(largest, reference_mm);
    summary.largest_material_correction =
        std::max(summary.largest_material_correction, material_mm);
}

std::vector<double> targets_as_given(const RunPlan& plan) {
    std::vector<double> targets;
    targets.reserve(plan.targets.size());
    for (const Length target : plan.targets)
        targets.push_back(millimetres_as_given(target));
    return targets;
}

/// Every cell of the table is planned exactly once, and nothing else is.
Result<void> check_cells(const RunPlan& plan) {
    const std::size_t directions = plan.bidirectional ? 2 : 1;
    std::vector<int> seen(plan.targets.size() * directions *
                          static_cast<std::size_t>(std::max(plan.approaches, 0)));
    for (const PlannedPoint& point : plan.points) {
        const bool known = point.target_index >= 0 &&
                           static_cast<std::size_t>(point.target_index) < plan.targets.size() &&
                           point.approach >= 0 && point.approach < plan.approaches &&
                           (plan.bidirectional || point.direction == Direction::positive);
        if (!known)
            return fail(Fault::bad_run_file, "step " + std::to_string(point.step + 1) +
                                                 " of the plan lies outside its table");
        const std::size_t side = point.direction == Direction::positive ? 0 : directions - 1;
        const std::size_t row = static_cast<std::size_t>(point.target_index) * directions + side;
        ++seen[row * static_cast<std::size_t>(plan.approaches) +
               static_cast<std::size_t>(point.approach)];
    }
    if (seen.empty() || std::ranges::any_of(seen, [](int count) { return count != 1; }))
        return fail(Fault::bad_run_file,
                    "the plan does not hold every approach of every target exactly once");
    return {};
}

/// The datum of a run that may be compensated.
Result<const DatumRecord*> checked_datum_of(const RunRecord& run) {
    const auto points = run.complete ? check_complete(run) : check_points(run);
    for (const auto& check : {points, check_setup(run), check_cells(run.plan)})
        if (!check) return tl::unexpected(check.error());
    const std::string& id = run.points.front().datum_id;
    const auto datum = std::ranges::find(run.datums, id, &DatumRecord::id);
    if (datum == run.datums.end())
        return fail(Fault::bad_run_file, "the datum '" + id + "' is not in the run file");
    if (!std::isfinite(datum->reading.si()) || !std::isfinite(datum->coordinate.si()))
        return fail(Fault::bad_run_file, "the datum '" + id + "' is not a number");
    return &*datum;
}

/// Why a reading was replaced: the first retake after it that names its point.
std::string reason_of_retake(const RunRevisions& revisions, const PointRecord& point) {
    for (const RetakeRecord& retake : revisions.retakes)
        for (const RetakePoint& wanted : retake.points)
            if (wanted.planned_step == point.planned.step && wanted.step > point.step)
                return retake.reason;
    return "taken again";
}

const ExclusionRecord* exclusion_of(const RunRevisions& revisions, const PointRecord& point) {
    const auto found = std::ranges::find(revisions.exclusions, point.step, &ExclusionRecord::step);
    return found == revisions.exclusions.end() ? nullptr : &*found;
}

/// The exclusion that went before a retake is told, too.
std::string reason_of_replacement(const RunRevisions& revisions, const PointRecord& point) {
    const ExclusionRecord* exclusion = exclusion_of(revisions, point);
    return reason_of_retake(revisions, point) +
           (exclusion != nullptr ? " (excluded before: " + exclusion->reason + ")" : "");
}

/// What others compensated is taken as it is.
Result<Compensated> imported_deviations(const RunRecord& run, const RunRevisions& revisions) {
    AXISCAL_CHECK(run.complete ? check_complete(run) : check_points(run));
    AXISCAL_CHECK(check_cells(run.plan));
    if (!revisions.exclusions.empty() || !revisions.superseded.empty())
        return fail(Fault::refused, "imported readings are neither left out nor taken again here: "
                                    "mend the file, and import it anew");
    CompensationSummary summary;
    for (const PointRecord& point : run.points) {
        if (!std::isfinite(point.reading.si()))
            return fail(Fault::bad_run_file, "step " + std::to_string(point.planned.step + 1) +
                                                 ": the reading is not a number");
        summary.after.push_back(point.reading.in(mm));
    }
    std::vector<double> targets = targets_as_given(run.plan);
    const bool rotary = run.plan.axis_kind == AxisKind::rotary;
    AXISCAL_TRY(UsableReadings usable,
                usable_readings(run, revisions, summary.after, targets, rotary ? "deg" : "mm"));
    return Compensated{RunAt20CMaker::make(std::move(usable.table), "imported: readings by others"),
                       std::move(summary),
                       {},
                       std::move(usable.completeness),
                       std::move(targets)};
}

} // namespace

Length displacement_in_air(Length vacuum_displacement,
                           double n_minus_1,
                           double n_minus_1_at_datum,
                           Length dead_path) {
    return (vacuum_displacement - dead_path * (n_minus_1 - n_minus_1_at_datum)) / (1 + n_minus_1);
}

double cosine_factor_of(const LaserSetup& laser) {
    if (!(laser.beam_walk_travel > Length{})) return 1;
    const double tangent = laser.beam_walk / (laser.beam_walk_travel * 2);
    return std::sqrt(1 + tangent * tangent);
}

Length displacement_by_scale(Length counted, Expansion coefficient, Temperature scale) {
    return counted * (1 + (coefficient * (scale - reference_temperature)).si());
}

Length displacement_at_20C(Length displacement,
                           Expansion coefficient,
                           Temperature material,
                           ExpansionForm form) {
    const double strain = (coefficient * (material - reference_temperature)).si();
    return form == ExpansionForm::exact ? displacement / (1 + strain)
                                        : displacement - displacement * strain;
}

Result<Compensated> compensate_to_20C(const RunRecord& run) {
    return compensate_to_20C(run, {});
}

Result<Compensated> compensate_to_20C(const RunRecord& run, const RunRevisions& revisions) {
    if (run.imported) return imported_deviations(run, revisions);
    AXISCAL_TRY(const DatumRecord* datum, checked_datum_of(run));
    Compensation compensation{run, *datum};
    if (auto tied = compensation.tie_datum(); !tied) return tl::unexpected(tied.error());
    CompensationSummary summary = summary_of_setup(run);
    std::vector<SetAside> set_aside;
    for (const PointRecord& point : run.points) {
        AXISCAL_TRY(const CompensatedPoint compensated, compensation.apply(point));
        const auto index = static_cast<std::size_t>(point.planned.target_index);
        add_to_summary(summary, compensated, run.plan.targets[index]);
        if (const ExclusionRecord* exclusion = exclusion_of(revisions, point))
            set_aside.push_back(
                {point.planned, point.step, summary.after.back(), false, exclusion->reason});
    }
    for (const PointRecord& point : revisions.superseded) {
        AXISCAL_TRY(const CompensatedPoint compensated, compensation.apply(point));
        const auto index = static_cast<std::size_t>(point.planned.target_index);
        set_aside.push_back({point.planned, point.step,
                             (compensated.at_20C - run.plan.targets[index]).in(mm), true,
                             reason_of_replacement(revisions, point)});
    }
    std::ranges::stable_sort(set_aside, {},
                             [](const SetAside& reading) { return reading.planned.step; });
    std::vector<double> targets = targets_as_given(run.plan);
    AXISCAL_TRY(UsableReadings usable,
                usable_readings(run, revisions, summary.after, targets, run.rotary ? "deg" : "mm"));
    for (const std::string& remark : compensation.remarks())
        summary.remarks.push_back(remark);
    const std::string provenance =
        run.rotary ? "none_needed: an angle does not expand" : "compensated_to_20C";
    return Compensated{RunAt20CMaker::make(std::move(usable.table), provenance), std::move(summary),
                       std::move(set_aside), std::move(usable.completeness), std::move(targets)};
}

} // namespace axiscal
