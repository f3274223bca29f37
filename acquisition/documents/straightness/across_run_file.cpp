#include "acquisition/documents/straightness/across_run_file.hpp"

#include "analysis/record/run_clock.hpp"
#include "analysis/straightness/run_straightness.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace axiscal {
namespace {

/// It ends, as far as anybody knows, with its last reading.
ClockTie end_of_open_across(const RunRecord& run) {
    const auto last = std::ranges::max_element(run.points, {}, &PointRecord::window_end);
    const MonotonicTime at = last->window_end;
    return {at, tie_of_points(run.opened, run.events).utc_ns_at(at), at};
}

Duration settle_times(RunRecord& run, RunRevisions& revisions, bool closed) {
    if (!closed) {
        run.complete = false;
        run.closing_reason = "the run is still open";
        run.closed = end_of_open_across(run);
    }
    const Duration off =
        tell_times_by_one_clock(run.opened, run.events, revisions.retakes, run.closed);
    tell_orders_by_one_clock(run.opened, run.events, revisions.orders);
    return off;
}

Result<void>
check_across_run(const std::string& path, const RunFileContents& contents, TestKind kind) {
    const std::string name{name_of(kind)};
    if (contents.attachments.setup.index() != static_cast<std::size_t>(kind))
        return fail(Fault::bad_run_file, path + " has no row " + name);
    if (contents.run.plan.axis_kind == AxisKind::rotary)
        return fail(Fault::bad_run_file,
                    path + " is a " + name + " of a rotary axis: there is none");
    if (contents.run.points.empty())
        return fail(Fault::incomplete_run, path + " holds no reading yet");
    return {};
}

} // namespace

const ReferenceLine& line_against(const Straightness& against, LineReference reference) {
    switch (reference) {
    case LineReference::end_points: return against.end_points;
    case LineReference::least_squares: return against.least_squares;
    case LineReference::minimum_zone: break;
    }
    return against.minimum_zone.line;
}

const StraightnessSetup& AcrossRun::optics() const {
    if (const auto* square = std::get_if<SquarenessSetup>(&attachments.setup))
        return square->optics;
    return std::get<StraightnessSetup>(attachments.setup);
}

Result<Duration> take_across_run(AcrossRun& taken,
                                 const std::string& path,
                                 RunFileContents contents,
                                 TestKind kind) {
    AXISCAL_CHECK(check_across_run(path, contents, kind));
    const Duration clock_off = settle_times(contents.run, contents.revisions, contents.closed);
    taken.run = std::move(contents.run);
    taken.revisions = std::move(contents.revisions);
    taken.attachments = std::move(contents.attachments);
    return clock_off;
}

Result<double> read_across_run(AcrossRun& taken) {
    AXISCAL_TRY(ReadStraightness read,
                read_straightness(taken.run, taken.revisions, taken.optics()));
    AXISCAL_TRY(taken.figures, evaluate_straightness(read.readings, RowLengths::any));
    taken.readings = std::move(read.readings);
    taken.completeness = std::move(read.completeness);
    const bool wollaston = taken.optics().method == StraightnessMethod::wollaston;
    return wollaston ? taken.figures.pooled_s_um.value_or(0) : read.scatter;
}

} // namespace axiscal
