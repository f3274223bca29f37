#include "analysis/setup/run_course.hpp"

#include "analysis/air/air_refraction.hpp"
#include "analysis/compensation/environment_history.hpp"

#include <algorithm>
#include <string>

namespace axiscal {
namespace {

MonotonicTime middle_of(const PointRecord& point) {
    return point.window_begin + (point.window_end - point.window_begin) / 2;
}

Result<double>
refractivity_at(const RunRecord& run, const EnvironmentHistory& history, MonotonicTime at) {
    AXISCAL_TRY(const AirState air, history.air_at(at, "the course of the run"));
    AXISCAL_TRY(const Refractivity found, refractivity_of(run.air.formula, air));
    return found.n_minus_1;
}

Result<CoursePoint> course_point(const RunRecord& run,
                                 const EnvironmentHistory& history,
                                 const PointRecord& point,
                                 double n_minus_1_at_datum) {
    const MonotonicTime at = middle_of(point);
    CoursePoint out;
    out.planned = point.planned;
    out.cell =
        2 * point.planned.target_index + (point.planned.direction == Direction::positive ? 0 : 1);
    out.seconds = seconds_of(at - middle_of(run.points.front()));
    const Length target = run.plan.targets[static_cast<std::size_t>(point.planned.target_index)];
    out.distance_m = (target - run.plan.datum).in(mm) / 1e3;
    AXISCAL_TRY(const Temperature material, history.material_at(at, "the course of the run"));
    out.material_K = (material - reference_temperature).si();
    if (run.scale) return out;
    AXISCAL_TRY(const double n_minus_1, refractivity_at(run, history, at));
    out.index_ppm = run.laser.sign * (n_minus_1 - n_minus_1_at_datum) * 1e6;
    return out;
}

bool is_excluded(const RunRevisions& revisions, const PointRecord& point) {
    return std::ranges::find(revisions.exclusions, point.step, &ExclusionRecord::step) !=
           revisions.exclusions.end();
}

} // namespace

Result<RunCourse> course_of(const RunRecord& run,
                            const RunRevisions& revisions,
                            const std::vector<double>& deviations_mm) {
    if (run.rotary) return fail(Fault::refused, "the course of a rotary axis is not looked at");
    if (deviations_mm.size() != run.points.size() || run.points.empty())
        return fail(Fault::internal, "a course needs one deviation for each point");
    const EnvironmentHistory history{run};
    const auto datum = std::ranges::find(run.datums, run.points.front().datum_id, &DatumRecord::id);
    double n_minus_1_at_datum = 0;
    if (!run.scale) {
        const MonotonicTime tied =
            datum == run.datums.end() ? run.points.front().window_begin : datum->at;
        AXISCAL_TRY(n_minus_1_at_datum, refractivity_at(run, history, tied));
    }
    RunCourse course;
    for (std::size_t i = 0; i < run.points.size(); ++i) {
        if (is_excluded(revisions, run.points[i])) continue;
        AXISCAL_TRY(CoursePoint point,
                    course_point(run, history, run.points[i], n_minus_1_at_datum));
        point.deviation_um = deviations_mm[i] * 1e3;
        course.points.push_back(point);
    }
    std::ranges::stable_sort(course.points, {}, &CoursePoint::seconds);
    return course;
}

} // namespace axiscal
