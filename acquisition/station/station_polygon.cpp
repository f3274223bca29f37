// A rotary axis before an autocollimator: a person reads the polygon's faces and types what is
// seen. Nothing is on a wire, so nothing proves that the axis stood still or from where it came;
// the points are those of the program's requests, or marked manual.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/station/patience.hpp"
#include "drivers/spawn.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr double arcsec_per_degree = 3600;

/// One reading, at one instant; a millimetre stands for a degree.
Capture typed_capture(double seconds_of_arc, MonotonicTime now) {
    Capture capture;
    capture.begin = capture.end = now;
    capture.mean = mm(seconds_of_arc / arcsec_per_degree);
    capture.n = 1;
    return capture;
}

} // namespace

/// The zero of the autocollimator is the datum of every face; of a point the reading is awaited.
Task<void> Station::await_typed(OpenWindow window) {
    if (!window.approach) {
        open_window_ = 0; // nobody is to type into it
        feed(WindowResult{window.window, typed_capture(0, scheduler_.now()), scheduler_.now()});
        co_return;
    }
    while (open_window_ == window.window && !stopping_ && scheduler_.now() < window.deadline)
        co_await scheduler_.sleep_for(look_every);
    if (open_window_ != window.window || stopping_) co_return;
    open_window_ = 0;
    feed(WindowResult{window.window,
                      fail(Fault::not_still, "No reading of the autocollimator was typed within " +
                                                 in_seconds(config_.capture.timeout) +
                                                 ": 'axiscal reading --arcsec ...'."),
                      scheduler_.now()});
}

Result<void> Station::type_reading(double seconds_of_arc) {
    if (!reads_polygon())
        return fail(Fault::bad_request, "this station reads its length by itself: 'axiscal "
                                        "trigger' captures the next point");
    if (!recording() || !datum_) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    manual_refusal_.reset();
    run_->refusal.reset();
    if (open_window_ == 0) {
        TriggerEvent event;
        event.at = scheduler_.now();
        event.origin = TriggerOrigin::manual;
        feed_with_air(event);
    }
    if (manual_refusal_) return tl::unexpected<Error>(*manual_refusal_);
    const std::uint64_t window = std::exchange(open_window_, 0);
    if (window == 0) return fail(Fault::busy, "the last reading is on its way to the disk");
    const MonotonicTime now = scheduler_.now();
    feed_with_air(WindowResult{window, typed_capture(seconds_of_arc, now), now});
    if (run_->refusal) return tl::unexpected<Error>(*run_->refusal);
    return {};
}

} // namespace axiscal
