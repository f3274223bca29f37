#include "acquisition/measurement/circular/take_over_circles.hpp"

#include "acquisition/measurement/circular/circle_measurement.hpp"
#include "acquisition/measurement/circular/circle_resume.hpp"
#include "acquisition/measurement/circular/left_circles.hpp"

#include <utility>

namespace axiscal {

/// One that was driven to its end is closed as complete. The CNC heard of its last request, or
/// will: Recovery tells it again.
Task<Result<TakenOver>> take_over_circles(CncContext context, LeftRun left) {
    co_await ballbar_is_back(context);
    CircleResume verdict = judge_left_circles(context, left.contents);
    TakenOver taken;
    switch (verdict.decision) {
    case CircleResume::Decision::go_on: break;
    case CircleResume::Decision::close_complete:
        taken.closing.reason = "Every circle was driven.";
        taken.closing.as = LeftClosing::As::complete;
        co_return taken;
    case CircleResume::Decision::close_incomplete:
        taken.closing.reason = std::move(verdict.sentence);
        taken.closing.fault = verdict.fault;
        co_return taken;
    }
    AXISCAL_CO_TRY(taken.test, co_await CircleMeasurement::reopen(context, std::move(left.path),
                                                                  std::move(left.contents),
                                                                  std::move(verdict)));
    co_return taken;
}

} // namespace axiscal
