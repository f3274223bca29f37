#include "acquisition/run/retake_plan.hpp"

#include "acquisition/run/resume.hpp"

#include <set>

namespace axiscal {

std::vector<PlannedPoint> points_to_take_again(const RunRecord& run,
                                               const RunRevisions& revisions) {
    std::set<int> settled;
    for (const auto* readings : {&run.points, &revisions.superseded})
        for (const PointRecord& point : *readings)
            settled.insert(point.step);
    for (const EventRecord& event : run.events)
        if (const auto step = skipped_step(event)) settled.insert(*step);
    std::vector<PlannedPoint> left;
    for (const RetakeRecord& retake : revisions.retakes)
        for (const RetakePoint& point : retake.points) {
            const auto planned = static_cast<std::size_t>(point.planned_step);
            if (!settled.contains(point.step) && planned < run.plan.points.size())
                left.push_back(run.plan.points[planned]);
        }
    return left;
}

} // namespace axiscal
