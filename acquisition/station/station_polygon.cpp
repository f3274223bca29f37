// A rotary axis before an autocollimator. Where the station file names it, a face is captured like
// any reading, in a still window; else a person reads the polygon's faces and types what is seen,
// and nothing proves that the axis stood still. From where it came neither shows; the points are
// those of the program's requests, or marked manual.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "drivers/loop/spawn.hpp"

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

/// As the history keeps it, a millimetre for a degree. An autocollimator counts nothing: neither
/// without light nor by a line that was opened anew is a zero lost.
Sample in_degrees(const Sample& shown) {
    const auto seconds_of_arc = shown.value();
    Sample kept = seconds_of_arc ? Sample{shown.channel, shown.at,
                                          mm(*seconds_of_arc / arcsec_per_degree).si()}
                                 : Sample::bad(shown.channel, shown.at, Quality::absent);
    kept.time_uncertainty = shown.time_uncertainty;
    return kept;
}

/// A micrometre stands for a thousandth of a degree.
std::string arcsec_of_um(double thousandths) {
    return plain_number(thousandths * arcsec_per_degree / 1000, 2) + " arcsec";
}

} // namespace

void Station::take_face(const Sample& sample) {
    readings_.take_reference(in_degrees(sample));
}

Error Station::no_still_face(const StillnessVerdict& seen) const {
    const CaptureConfig& limits = config_.capture;
    const WindowStatistics& found = seen.statistics;
    std::string why = "its readings spread over " + arcsec_of_um(found.spread.in(um)) +
                      " and drift by " + arcsec_of_um(found.slope_um_per_s) + "/s, " +
                      arcsec_of_um(limits.spread_limit.in(um)) + " and " +
                      arcsec_of_um(limits.slope_limit_um_per_s) + "/s are allowed";
    if (found.n == 0)
        why = "it shows no face, or does not answer";
    else if (seen.fault == Fault::signal_error)
        why = "the light was lost on the way";
    else if (found.n < limits.minimum_samples)
        why = "a window of " + in_seconds(limits.window) + " holds " + counted(found.n, "reading") +
              ", " + std::to_string(limits.minimum_samples) +
              " are needed: a shorter poll_period, or a longer capture.window";
    return {Fault::not_still,
            "The autocollimator shows no still face within " + in_seconds(limits.timeout) + ": " +
                why + ".",
            {},
            {}};
}

/// Once it was seen to see a face, having none before it is the way to the next: only where it
/// comes back without one, that is told, and the first face after it.
std::string Station::news_of_autocollimator(const InstrumentView& view) {
    const bool between_faces =
        autocollimator_ == InstrumentState::available && view.state == InstrumentState::faulty;
    if (between_faces || view.state == autocollimator_) return {};
    const InstrumentState before = std::exchange(autocollimator_, view.state);
    if (view.state == InstrumentState::faulty) return "answers, and sees no face";
    return before == InstrumentState::faulty && view.state == InstrumentState::available
               ? "sees a face"
               : news_of_state(view);
}

/// On the way to its first face it sees none: that it speaks is enough.
Result<void> Station::autocollimator_speaks() const {
    const auto id = roles_.autocollimator;
    if (!id) return {};
    const auto& last = readings_.latest(*id);
    if (last && scheduler_.now() - last->at <= laser_limit) return {};
    return fail(Fault::link_timeout, "the autocollimator (" + channel_of(*id).instrument_name +
                                         ") sends nothing; see 'axiscal devices'");
}

std::optional<int> Station::autocollimator_for(PreflightFacts& facts) const {
    const auto id = roles_.autocollimator;
    if (!id || facts.circular) return std::nullopt;
    facts.faces_read = true;
    if (const auto& last = readings_.latest(*id)) facts.face_age = facts.now - last->at;
    return id;
}

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
    if (!reads_polygon() || reads_faces())
        return fail(Fault::bad_request,
                    std::string{"this station reads its "} +
                        (reads_faces() ? "autocollimator" : "length") +
                        " by itself: 'axiscal trigger' captures the next point");
    if (!recording() || !datum_) return fail(Fault::no_run_armed, "'axiscal arm' opens a run");
    if (open_window_ == 0) {
        TriggerEvent event;
        event.at = scheduler_.now();
        event.origin = TriggerOrigin::manual;
        if (auto refusal = ask(event).refusal) return tl::unexpected<Error>(*std::move(refusal));
    }
    const std::uint64_t window = std::exchange(open_window_, 0);
    if (window == 0) return fail(Fault::busy, "the last reading is on its way to the disk");
    const MonotonicTime now = scheduler_.now();
    auto answer = ask(WindowResult{window, typed_capture(seconds_of_arc, now), now});
    if (answer.refusal) return tl::unexpected<Error>(*std::move(answer.refusal));
    return {};
}

} // namespace axiscal
