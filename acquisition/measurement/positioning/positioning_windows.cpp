// Readings of the axis: in a still window, or typed by a person who looks through an
// autocollimator.
#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/stillness.hpp"
#include "acquisition/capture/wording.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/positioning/polygon_reading.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"

#include <utility>

namespace axiscal {

Task<void> PositioningMeasurement::watch_window(Self test, OpenWindow window) {
    Scheduler& scheduler = test->context_.scheduler;
    StillWindowSearch search{window.from, test->context_.config.capture};
    while (test->open_window_ == window.window && !test->context_.stopping) {
        const MonotonicTime now = scheduler.now();
        if (test->drop_order_of_who_has_gone(now)) co_return;
        if (auto found = test->look_into(search, window, now)) {
            test->feed_with_air(WindowResult{window.window, *std::move(found), now});
            co_return;
        }
        co_await scheduler.sleep_for(look_every);
    }
}

/// What the window ends with; none while it is looked for. From which side the axis came, an
/// autocollimator cannot see.
std::optional<Result<Capture>> PositioningMeasurement::look_into(StillWindowSearch& search,
                                                                 const OpenWindow& window,
                                                                 MonotonicTime now) const {
    const CaptureConfig& limits = context_.config.capture;
    const SampleHistory& history = context_.readings.reference();
    const WindowSearch seen = search.look(history, now);
    if (seen.failure) return Result<Capture>{tl::unexpected<Error>(*seen.failure)};
    const std::optional<ApproachClaim> claim = reads_faces() ? std::nullopt : window.approach;
    if (seen.window) return make_capture(history, *seen.window, claim, limits);
    if (now < window.deadline) return std::nullopt;
    return Result<Capture>{tl::unexpected<Error>(
        reads_faces() ? no_still_face(seen.verdict, limits) : not_still(seen, now - window.from))};
}

/// Asked in each look for the datum, so that none is tied for nobody: the part program waits for
/// that alone, and goes on by itself.
bool PositioningMeasurement::drop_order_of_who_has_gone(MonotonicTime now) {
    if (datum_ || !orderer_has_gone_ || !orderer_has_gone_()) return false;
    feed(Abort{"Who armed the run hung up before its datum was tied.", now});
    not_tied_ =
        Error{Fault::refused, "who armed the run hung up before its datum was tied", {}, {}};
    return true;
}

/// The zero of the autocollimator is the datum of every face; of a point the reading is awaited.
Task<void> PositioningMeasurement::await_typed(Self test, OpenWindow window) {
    Scheduler& scheduler = test->context_.scheduler;
    const auto is_awaited = [&] {
        return test->open_window_ == window.window && !test->context_.stopping;
    };
    if (!window.approach) {
        test->open_window_ = 0; // nobody is to type into it
        const MonotonicTime now = scheduler.now();
        test->feed(WindowResult{window.window, typed_capture(0, now), now});
        co_return;
    }
    while (is_awaited() && scheduler.now() < window.deadline)
        co_await scheduler.sleep_for(look_every);
    if (!is_awaited()) co_return;
    test->open_window_ = 0;
    test->feed(
        WindowResult{window.window,
                     fail(Fault::not_still, "No reading of the autocollimator was typed within " +
                                                in_seconds(test->context_.config.capture.timeout) +
                                                ": 'axiscal reading --arcsec ...'."),
                     scheduler.now()});
}

Result<void> PositioningMeasurement::type_reading(double seconds_of_arc) {
    if (!records() || !datum_) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    if (open_window_ == 0) AXISCAL_CHECK(trigger());
    const std::uint64_t window = std::exchange(open_window_, 0);
    if (window == 0) return fail(Fault::busy, "the last reading is on its way to the disk");
    const MonotonicTime now = context_.scheduler.now();
    auto answer = ask(WindowResult{window, typed_capture(seconds_of_arc, now), now});
    if (answer.refusal) return tl::unexpected<Error>(*std::move(answer.refusal));
    return {};
}

} // namespace axiscal
