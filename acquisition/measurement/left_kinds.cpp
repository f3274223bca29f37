#include "acquisition/measurement/left_kinds.hpp"

#include "acquisition/measurement/circular/take_over_circles.hpp"
#include "acquisition/measurement/drift/take_over_drift.hpp"
#include "acquisition/measurement/positioning/take_over_positioning.hpp"

#include <utility>

namespace axiscal {

bool is_driven_by_cnc(TestKind kind) {
    switch (kind) {
    case TestKind::positioning:
    case TestKind::circular:
    case TestKind::probing: return true;
    case TestKind::drift: return false;
    }
    return true;
}

/// A station opens no probing: a file of one that lies there is held against the axis.
Task<Result<TakenOver>> take_over_left(const PositioningContext& context, LeftRun left) {
    switch (left.contents.run.kind) {
    case TestKind::circular: return take_over_circles(context, std::move(left));
    case TestKind::drift: return take_over_drift(std::move(left));
    case TestKind::positioning:
    case TestKind::probing: break;
    }
    return take_over_positioning(context, std::move(left));
}

Result<void> may_be_added_to(const RunSummary& newest) {
    switch (newest.kind) {
    case TestKind::drift:
        return fail(Fault::no_run_armed,
                    "the last test, " + newest.run_id +
                        ", is a drift test of an earlier start: a run before it cannot be added "
                        "to, arm a new one");
    case TestKind::circular:
        return fail(Fault::no_run_armed, "the last run, " + newest.run_id +
                                             ", is a circular test: its circles are driven again");
    case TestKind::positioning:
    case TestKind::probing: break;
    }
    return {};
}

} // namespace axiscal
