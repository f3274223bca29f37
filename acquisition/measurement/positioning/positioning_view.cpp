// What a positioning run shows: to people and to the CNC.
#include "acquisition/capture/wording.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {

void PositioningMeasurement::put_on_status(StationStatus& shown) const {
    shown.run = status();
}

void PositioningMeasurement::put_on_port(PortStatus& status) const {
    const RunView view = machine_.view();
    if (view.next && !view.closed) {
        status.next_target = view.next->target_index;
        status.next_nominal_mm = target_of(*view.next).in(mm);
    }
    status.run_complete = view.complete;
    const bool stopped = view.stopped && !view.closed;
    status.feed_hold = stopped;
    status.may_move = status.state != PortState::settling && !stopped;
}

void PositioningMeasurement::put_on_axis(AxisView& axis, Length reading) const {
    if (!datum_ || !is_open()) return;
    const ReadingRule& rule = machine_.reading();
    const auto next = machine_.view().next;
    if (const auto place = place_of(reading)) axis.position_mm = place->in(mm);
    if (!next) return;
    const auto place = place_near(target_of(*next), reading);
    if (!place) return;
    if (rule.shows_place()) axis.position_mm = place->in(mm);
    axis.deviation_um = rule.deviation_of(*datum_, reading, *place, target_of(*next)).in(um);
}

Length PositioningMeasurement::target_of(const PlannedPoint& point) const {
    return header_.plan.targets[static_cast<std::size_t>(point.target_index)];
}

/// Nothing where the reading does not show it far from any target.
std::optional<Length> PositioningMeasurement::place_of(Length reading) const {
    const ReadingRule& rule = machine_.reading();
    if (!rule.sees_every_place()) return std::nullopt;
    const auto place = rule.position_of(*datum_, reading, context_.readings.last_scale_minus_1(),
                                        datum_->coordinate);
    return place ? std::optional{*place} : std::nullopt;
}

/// Nothing unless it is near.
std::optional<Length> PositioningMeasurement::place_near(Length target, Length reading) const {
    const auto place = machine_.reading().position_of(
        *datum_, reading, context_.readings.last_scale_minus_1(), target);
    if (!place || abs(*place - target) > header_.plan.near_tolerance) return std::nullopt;
    return *place;
}

std::optional<Length> PositioningMeasurement::place_now() const {
    if (!datum_ || !set_up_.lost().empty() || !datum_stands()) return std::nullopt;
    const auto reading = context_.readings.reference().newest();
    if (!reading || !reading->value()) return std::nullopt;
    return place_of(metre(*reading->value()));
}

RunStatus PositioningMeasurement::status() const {
    const RunView view = machine_.view();
    RunStatus run;
    run.run_id = run_.run_id;
    run.pass = header_.plan.pass;
    run.file = run_.path;
    run.step = view.done;
    run.steps = view.total;
    run.done = view.last_durable;
    run.certificate = run_.certificate;
    if (view.last_deviation) run.last_deviation_um = view.last_deviation->in(um);
    if (view.last_synchronisation)
        run.last_synchronisation_um = view.last_synchronisation->error_um;
    run.state = state_text(view);
    if (view.next && is_open()) {
        run.next_target = view.next->target_index;
        run.next_nominal_mm = target_of(*view.next).in(mm);
        run.next_direction = view.next->direction;
        run.next_approach = view.next->approach;
    }
    run.retakes_asked = view.retakes_asked;
    run.retakes_left = view.retakes_left;
    run.excluded = view.excluded;
    run.skipped = view.without_point;
    run.seconds_left = seconds_left(view);
    run.so_far = figures_.of(header_, machine_);
    tell_trouble(run, view);
    return run;
}

PointsView PositioningMeasurement::points(std::size_t from) const {
    const std::vector<AcceptedPoint>& all = machine_.accepted();
    PointsView view{run_.run_id, all.size(), {}, machine_.left_out()};
    for (std::size_t nth = from; nth < all.size(); ++nth)
        view.points.push_back(
            {all[nth], target_of(all[nth].planned), machine_.leaves_out(all[nth].step)});
    if (from == 0) view.targets = header_.plan.targets;
    view.so_far = figures_.of(header_, machine_);
    return view;
}

std::string PositioningMeasurement::state_text(const RunView& view) const {
    if (!is_open()) return run_.complete ? "complete" : "incomplete";
    if (view.stopped) return "stopped";
    if (!view.datum) return "tying datum";
    return view.state == PortState::settling ? "settling" : "armed";
}

void PositioningMeasurement::tell_trouble(RunStatus& run, const RunView& view) const {
    const auto tell = [&run](Fault fault, std::string sentence) {
        if (fault != Fault::none) run.last_fault = fault_name(fault);
        run.last_sentence = std::move(sentence);
    };
    if (!is_open() && !run_.complete)
        tell(run_.fault, run_.reason);
    else if (run_.no_certificate)
        tell(run_.no_certificate->fault, describe(*run_.no_certificate));
    else if (refusal_ && is_open())
        tell(refusal_->fault, describe(*refusal_));
    else if (view.without_point > 0)
        tell(Fault::none, "Warning: " + counted(view.without_point, "point") +
                              " skipped by the CNC, and not taken since: 'axiscal retake' takes "
                              "what is missing, 'axiscal abort' ends the run without.");
}

/// From the mean time between points; none before the second, for the first one waited for people.
std::optional<double> PositioningMeasurement::seconds_left(const RunView& view) const {
    if (taken_ < 2 || !is_open() || view.stopped) return std::nullopt;
    const double spacing = seconds_of(last_taken_ - first_taken_) / (taken_ - 1);
    const double since = seconds_of(context_.scheduler.now() - last_taken_);
    return std::max(0.0, spacing * (view.total - view.done - view.skipped) - since);
}

} // namespace axiscal
