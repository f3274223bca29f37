#include "analysis/record/synchronisation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace axiscal {

std::optional<Synchronisation> synchronisation_of(double slope_um_per_s,
                                                  std::optional<Duration> uncertainty) {
    if (!uncertainty || *uncertainty <= Duration{}) return std::nullopt;
    return Synchronisation{*uncertainty, std::abs(slope_um_per_s) * seconds_of(*uncertainty)};
}

SynchronisationUnit synchronisation_unit_of(const RunRecord& run) {
    constexpr double arcsec_per_millidegree = 3.6;
    if (run.rotary && run.rotary->method == AngleMethod::polygon)
        return {"arcsec", arcsec_per_millidegree};
    return {"um", 1};
}

SynchronisationSummary
summarize_synchronisation(const RunRecord& run, const std::vector<SynchronisationRecord>& records) {
    SynchronisationSummary summary;
    summary.captures = static_cast<int>(run.points.size() + run.datums.size());
    std::set<int> steps{-1}; // that of every datum
    for (const PointRecord& point : run.points)
        steps.insert(point.step);
    for (const SynchronisationRecord& record : records) {
        if (!record.stated || !steps.contains(record.step)) continue; // taken again since
        ++summary.stated;
        if (!summary.largest || record.stated->error_um > summary.largest->stated->error_um)
            summary.largest = record;
    }
    return summary;
}

const SynchronisationRecord*
synchronisation_of_step(const std::vector<SynchronisationRecord>& records, int step) {
    const auto found = std::ranges::find(records, step, &SynchronisationRecord::step);
    return found == records.end() || step < 0 ? nullptr : &*found;
}

} // namespace axiscal
