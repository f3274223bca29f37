#include "acquisition/measurement/circular/circle_resume.hpp"

#include "analysis/circular/circle_cut.hpp"
#include "analysis/record/run_clock.hpp"

namespace axiscal {
namespace {

using Decision = CircleResume::Decision;

CircleResume closing(Fault fault, std::string sentence) {
    return {Decision::close_incomplete, fault, std::move(sentence), {}};
}

/// Recorded from its feed-in to its feed-out, without a hole between them.
bool is_whole(const RecordedCircles& from, const std::vector<CircleMark>& marks, int number) {
    for (const PlannedCircle& circle : planned_circles(from.setup.plan)) {
        if (circle.number != number) continue;
        const auto captured = cut_circle(from.setup, from.stream, marks, circle);
        return captured && captured->gaps == 0;
    }
    return false;
}

std::string words_of(int circle, std::size_t circles, bool whole) {
    if (circle == 0) return "No circle had begun.";
    return "Circle " + std::to_string(circle) + " of " + std::to_string(circles) +
           (whole ? " was recorded to its end before."
                  : " was not recorded to its end: it has to be driven again.");
}

int last_request_of(const RunRecord& run) {
    int last = 0;
    for (const EventRecord& event : run.events)
        if (event.kind == EventKind::note && event.sequence != 0) last = event.sequence;
    return last;
}

/// Empty: the readings of before and after have one zero.
std::string doubt_about_zero(const RecordedCircles& from, const BarNow& now) {
    if (!now.incremental || from.stream.at.empty()) return {};
    const bool proven =
        from.last && now.bar && datum_continues(*from.last, *now.bar, now.limits).continues;
    if (proven) return {};
    return "Nothing proves that the ballbar's counter ran on while the station was away: its zero "
           "may be lost. Start the test anew.";
}

} // namespace

CircleResume decide_circle_resume(const RecordedCircles& from, const BarNow& now) {
    const std::size_t circles = planned_circles(from.setup.plan).size();
    const auto marks = circle_marks(from.setup.plan, from.run.events);
    const int circle = marks.empty() ? 0 : marks.back().number;
    CirclesBefore before;
    before.last = last_request_of(from.run);
    if (static_cast<std::size_t>(circle) > circles)
        return {Decision::close_complete, Fault::none, "Every circle was driven.", before};
    if (now.config_hash != from.run.config_hash)
        return closing(Fault::bad_configuration,
                       "The station file was changed since the run was opened.");
    if (!is_same_boot(now.boot_id, from.run.boot_id))
        return closing(Fault::incomplete_run, "While circles were driven " +
                                                  restart_text(from.run.boot_id, now.boot_id) +
                                                  ": start the test anew.");
    if (!now.speaks)
        return closing(Fault::link_timeout,
                       "The ballbar sent nothing after the restart: start the test anew.");
    if (std::string doubt = doubt_about_zero(from, now); !doubt.empty())
        return closing(Fault::datum_lost, std::move(doubt));
    before.whole = circle > 0 && is_whole(from, marks, circle);
    return {Decision::go_on, Fault::none, words_of(circle, circles, before.whole), before};
}

} // namespace axiscal
