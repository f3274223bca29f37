// A circular test that was open when the last daemon ended: it goes on, or is closed with the
// reason.
#include "acquisition/station/station.hpp"

#include "acquisition/measurement/another_boot.hpp"
#include "acquisition/measurement/circular/left_circles.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <utility>

namespace axiscal {

Task<Result<void>> Station::resume_or_close_circles(std::string path, RunFileContents contents) {
    const CncContext context = cnc_context();
    co_await ballbar_is_back(context);
    CircleResume verdict = judge_left_circles(context, contents);
    switch (verdict.decision) {
    case CircleResume::Decision::go_on:
        co_return co_await resume_circles(std::move(path), std::move(contents), std::move(verdict));
    case CircleResume::Decision::close_complete:
        co_return co_await close_driven_circles(std::move(path));
    case CircleResume::Decision::close_incomplete: break;
    }
    co_return co_await close_left_over(std::move(path), std::move(verdict.sentence), verdict.fault,
                                       false);
}

Task<Result<void>>
Station::resume_circles(std::string path, RunFileContents contents, CircleResume verdict) {
    const CncContext context = cnc_context();
    AXISCAL_CO_TRY(const std::shared_ptr<CircleMeasurement> test,
                   co_await CircleMeasurement::reopen(context, std::move(path), std::move(contents),
                                                      std::move(verdict)));
    begin_circles(test);
    co_return co_await test->go_on();
}

/// The CNC heard of its last request, or will: publish_done_of_closed() tells it again.
Task<Result<void>> Station::close_driven_circles(std::string path) {
    const auto stored = co_await journal_.summarize(path);
    if (auto reopened = co_await journal_.reopen(path); !reopened)
        co_return tl::unexpected<Error>(reopened.error());
    if (stored) note_another_boot(measurement_context(), stored->boot_id, boot_id_);
    const std::string reason = "Every circle was driven.";
    record(EventKind::closed, reason);
    if (auto closed = co_await files_.close_for_now(true, reason); !closed) {
        co_await journal_.let_go();
        co_return closed;
    }
    note("The open run " + path + " is closed as complete: " + reason);
    co_return Result<void>{};
}

} // namespace axiscal
