#include "analysis/straightness/run_straightness.hpp"

#include "analysis/checked_numbers.hpp"
#include "analysis/geometry/straightness.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace axiscal {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr double um_a_mm = 1000;

Result<void> check_setup(const StraightnessSetup& setup) {
    if (setup.sign != 1 && setup.sign != -1)
        return fail(Fault::bad_run_file, "the sign of the straightness is neither +1 nor -1");
    const bool wollaston = setup.method == StraightnessMethod::wollaston;
    if (wollaston && !(setup.factor > 0 && std::isfinite(setup.factor)))
        return fail(Fault::bad_run_file, "the factor of the straightness optics is not above 0");
    if (!wollaston && !(setup.base > Length{}))
        return fail(Fault::bad_run_file, "the base of the foot is not above 0");
    return {};
}

/// Each run by itself: column j of the rows, integrated, becomes column j of one row more.
Result<Rows> integrated_rows(const Rows& angles, double base_mm, const std::string& field) {
    if (angles.empty()) return Rows{};
    const std::size_t runs = angles.front().size();
    for (std::size_t i = 0; i < angles.size(); ++i)
        if (angles[i].empty() || angles[i].size() != runs)
            return refuse(Fault::bad_case, element_of(field, i),
                          "has another number of angles than the first");
    Rows rows(angles.size() + 1);
    for (std::size_t j = 0; j < runs; ++j) {
        std::vector<double> of_run;
        for (const auto& row : angles)
            of_run.push_back(row[j]);
        AXISCAL_TRY(const MeasuredLine line, line_of_angles(of_run, base_mm * um_a_mm, 0));
        for (std::size_t i = 0; i < rows.size(); ++i)
            rows[i].push_back(line.deviations[i]);
    }
    return rows;
}

Result<void> check_steps(const std::vector<double>& targets_mm, double base_mm) {
    constexpr double allowed_share = 0.01;
    if (targets_mm.empty()) return refuse(Fault::bad_case, "targets", "is empty");
    AXISCAL_CHECK(check_case_numbers(targets_mm, "targets"));
    for (std::size_t i = 1; i < targets_mm.size(); ++i)
        if (std::fabs(targets_mm[i] - targets_mm[i - 1] - base_mm) > allowed_share * base_mm)
            return refuse(Fault::bad_case, element_of("targets", i),
                          "is not one base of the foot above the one before it");
    return {};
}

/// Of each point, in the order of RunRecord::points: um across the axis, or radians.
Result<std::vector<double>> values_of(const RunRecord& run, const StraightnessSetup& setup) {
    std::vector<double> values;
    const bool wollaston = setup.method == StraightnessMethod::wollaston;
    if (wollaston && run.datums.empty())
        return fail(Fault::bad_run_file, "no datum was tied: the deviations have no zero");
    for (const PointRecord& point : run.points) {
        if (wollaston)
            values.push_back(deviation_um_of(setup, point.reading - run.datums.front().reading,
                                             usual_n_minus_1));
        else
            values.push_back(setup.sign * point.reading.in(mm)*degree.size);
    }
    return values;
}

double pooled_s(const DeviationTable& angles) {
    double squares = 0, degrees = 0;
    for (const Rows* rows : {&angles.forward, &angles.backward})
        for (const auto& row : *rows) {
            double mean = 0;
            for (const double angle : row)
                mean += angle / static_cast<double>(row.size());
            for (const double angle : row)
                squares += (angle - mean) * (angle - mean);
            degrees += static_cast<double>(row.size()) - 1;
        }
    return degrees > 0 ? std::sqrt(squares / degrees) : 0;
}

Result<ReadStraightness> of_angles(UsableReadings usable, const StraightnessSetup& setup) {
    if (!usable.completeness.left_out.empty())
        return fail(Fault::incomplete_run,
                    "a straightness of angle steps needs every angle: behind one that is left out "
                    "the line would begin anew");
    ReadStraightness out;
    out.scatter = pooled_s(usable.table);
    AngleReadings angles{std::move(usable.table.targets), std::move(usable.table.forward),
                         std::move(usable.table.backward)};
    AXISCAL_TRY(out.readings, integrated(angles, setup.base.in(mm)));
    out.completeness = std::move(usable.completeness);
    return out;
}

std::optional<double>
standard_of(const std::optional<Ratio>& expanded, double k, const std::optional<Ratio>& limit) {
    if (expanded) return expanded->si() / k;
    if (limit) return limit->si() / std::numbers::sqrt3;
    return std::nullopt;
}

} // namespace

Result<double> wollaston_factor(double angle_rad) {
    constexpr double smallest_deg = 0.01, largest_deg = 10;
    AXISCAL_CHECK(check_case_number(angle_rad, "angle"));
    if (angle_rad < smallest_deg * degree.size || angle_rad > largest_deg * degree.size)
        return refuse(Fault::bad_case, "angle", "of the prism's beams is not 0.01 to 10 degrees");
    return 1 / (2 * std::sin(angle_rad / 2));
}

double deviation_um_of(const StraightnessSetup& setup, Length since_datum, double n_minus_1) {
    return setup.sign * setup.factor * since_datum.in(um) / (1 + n_minus_1);
}

Result<StraightnessReadings> integrated(const AngleReadings& readings, double base_mm) {
    AXISCAL_CHECK(check_positive(base_mm, "base"));
    AXISCAL_CHECK(check_steps(readings.targets_mm, base_mm));
    if (readings.forward_rad.size() != readings.targets_mm.size())
        return refuse(Fault::bad_case, "forward", "has not one row a target");
    if (!readings.backward_rad.empty() &&
        readings.backward_rad.size() != readings.targets_mm.size())
        return refuse(Fault::bad_case, "backward", "has not one row a target");
    StraightnessReadings out;
    for (std::size_t i = 0; i <= readings.targets_mm.size(); ++i)
        out.targets_mm.push_back(readings.targets_mm.front() + base_mm * static_cast<double>(i));
    AXISCAL_TRY(out.forward_um, integrated_rows(readings.forward_rad, base_mm, "forward"));
    AXISCAL_TRY(out.backward_um, integrated_rows(readings.backward_rad, base_mm, "backward"));
    return out;
}

Result<ReadStraightness> read_straightness(const RunRecord& run,
                                           const RunRevisions& revisions,
                                           const StraightnessSetup& setup) {
    AXISCAL_CHECK(check_setup(setup));
    AXISCAL_CHECK(run.complete ? check_complete(run) : check_points(run));
    AXISCAL_TRY(const std::vector<double> values, values_of(run, setup));
    std::vector<double> targets_mm;
    for (const Length target : run.plan.targets)
        targets_mm.push_back(target.in(mm));
    const bool wollaston = setup.method == StraightnessMethod::wollaston;
    AXISCAL_TRY(
        UsableReadings usable,
        usable_readings(run, revisions, values, std::move(targets_mm), wollaston ? "um" : "rad"));
    if (!wollaston) return of_angles(std::move(usable), setup);
    ReadStraightness out;
    out.readings = {std::move(usable.table.targets), std::move(usable.table.forward),
                    std::move(usable.table.backward)};
    out.completeness = std::move(usable.completeness);
    return out;
}

StraightnessInputs inputs_of(const StraightnessSetup& setup, double scatter, int readings_a_mean) {
    const StraightnessStatement& stated = setup.uncertainty;
    StraightnessInputs in;
    in.wollaston = setup.method == StraightnessMethod::wollaston;
    in.readings_a_mean = readings_a_mean;
    in.scatter = scatter;
    if (in.wollaston) {
        in.factor_u = standard_of(stated.factor_U, stated.factor_k, stated.factor_limit);
        in.mirror_limit_um_per_m2 = stated.mirror_limit_um_per_m2;
        in.mirror_reversed = setup.reversal.has_value();
        if (setup.resolution > Length{}) in.resolution = setup.factor * setup.resolution.in(um);
        if (stated.eve) in.eve = stated.eve->in(um);
        return in;
    }
    in.base_um = setup.base.in(um);
    if (stated.angle_U) in.angle_u_rad = stated.angle_U->in(radian) / stated.angle_k;
    if (stated.base_U) in.base_u = (*stated.base_U / setup.base) / stated.base_k;
    if (setup.angle_resolution > Angle{}) in.resolution = setup.angle_resolution.in(radian);
    if (stated.eve_angle) in.eve = stated.eve_angle->in(radian);
    return in;
}

} // namespace axiscal
