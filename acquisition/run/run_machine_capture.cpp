// The third of RunMachine that deals with places: what a request claims, what a window shows.
#include "acquisition/run/run_machine.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t diagnosed_targets = 2;

/// NOMINAL_POS of a target: 0.1 um, or 1e-5 degree on a rotary axis (1 mm stands for 1 degree).
double counts_per_mm(AxisKind kind) {
    return kind == AxisKind::rotary ? 1e5 : 1e4;
}

std::string name_of_point(const RunPlan& plan, const PlannedPoint& point, bool again) {
    return "target index " + std::to_string(point.target_index) + " at " +
           in_axis_unit(plan.axis_kind,
                        plan.targets[static_cast<std::size_t>(point.target_index)]) +
           " from the " + std::string{name_of(point.direction)} + " direction (point " +
           std::to_string(point.step + 1) + " of " + std::to_string(plan.points.size()) +
           (again ? ", to be taken again)" : ")");
}

Error datum_lost_error(const std::string& why) {
    return {Fault::datum_lost, why, {}, {}};
}

/// Where the CNC says a position, and another one than `planned`; `instead` ends the sentence.
std::optional<Error> objection_to_position(const TriggerEvent& event,
                                           AxisKind kind,
                                           Length planned,
                                           const std::string& instead) {
    if (!event.nominal_counts) return std::nullopt;
    const double counts = counts_per_mm(kind);
    // One step of the plan (1 um, 0.001 degree) allows for a control that rounds.
    if (std::abs(*event.nominal_counts - planned.in(mm)*counts) <= 1e-3 * counts)
        return std::nullopt;
    return Error{Fault::wrong_target,
                 "The CNC claims the position " +
                     in_axis_unit(kind, mm(*event.nominal_counts / counts)) + instead,
                 {},
                 {}};
}

} // namespace

bool breaks_counting(Fault fault) {
    return fault == Fault::beam_lost || fault == Fault::implausible_jump ||
           fault == Fault::datum_lost;
}

void RunMachine::open_window(Pending pending,
                             std::optional<ApproachClaim> approach,
                             Length expected,
                             RunActions& out) {
    pending.window = ++windows_;
    pending.deadline = pending.triggered_at + setup_.capture_timeout;
    set_state(PortState::settling, out);
    out.push_back(
        OpenWindow{pending.window, pending.triggered_at, pending.deadline, approach, expected});
    pending_ = std::move(pending);
}

void RunMachine::start_datum(const TriggerEvent& event, RunActions& out) {
    if (std::ranges::find(done_, true) != done_.end() ||
        std::ranges::find(skipped_, true) != skipped_.end())
        return refuse(event,
                      {Fault::bad_command,
                       "Points were taken under the datum: a new datum needs a "
                       "new run.",
                       {},
                       {}},
                      out);
    const RunPlan& plan = setup_.plan;
    if (const auto objection = objection_to_position(
            event, plan.axis_kind, plan.datum,
            "; the plan's datum is at " + in_axis_unit(plan.axis_kind, plan.datum) + "."))
        return refuse(event, *objection, out);
    if (!scale_minus_1_) return refuse(event, scale_minus_1_.error(), out);
    Pending pending;
    pending.purpose = Purpose::datum;
    pending.origin = event.origin;
    pending.sequence = event.sequence;
    pending.triggered_at = event.at;
    open_window(std::move(pending), std::nullopt, setup_.plan.datum, out);
}

Error RunMachine::no_datum_yet() const {
    return {Fault::no_run_armed,
            "No datum is tied yet: send prepare at " +
                in_axis_unit(setup_.plan.axis_kind, setup_.plan.datum) + " first.",
            {},
            {}};
}

/// Index, direction, approach and nominal position as far as the CNC's shape carries them.
std::optional<Error> RunMachine::objection_to_claim(const TriggerEvent& event, int step) const {
    const auto& plan = setup_.plan;
    const PlannedPoint point = planned_at(step);
    const std::string next =
        "; the plan's next point is " + name_of_point(plan, point, step != point.step) + ".";
    if (event.target_index && *event.target_index != point.target_index)
        return Error{Fault::wrong_target,
                     "The CNC claims target index " + std::to_string(*event.target_index) + next,
                     {},
                     {}};
    if (event.direction && *event.direction != point.direction)
        return Error{Fault::wrong_direction,
                     "The CNC claims the " + std::string{name_of(*event.direction)} + " direction" +
                         next +
                         " The program exchanges forward and backward, or it drives another cycle "
                         "than the plan's.",
                     {},
                     {}};
    if (event.run_index && *event.run_index != point.approach)
        return Error{Fault::wrong_target,
                     "The CNC claims approach " + std::to_string(*event.run_index) +
                         " (RUN_INDEX), counted from 0, and " + std::to_string(point.approach) +
                         " is due" + next,
                     {},
                     {}};
    const auto target = plan.targets[static_cast<std::size_t>(point.target_index)];
    return objection_to_position(event, plan.axis_kind, target, next);
}

void RunMachine::start_point(const TriggerEvent& event, RunActions& out) {
    const auto step = next_step();
    if (!step) return refuse(event, {Fault::bad_command, "No point is left.", {}, {}}, out);
    if (!datum_) return refuse(event, no_datum_yet(), out);
    if (datum_broken_) {
        refuse(event, datum_lost_error("The counting was interrupted since the datum."), out);
        return close(false, "The counting was interrupted since the datum.", Fault::datum_lost,
                     out);
    }
    if (const auto objection = objection_to_claim(event, *step))
        return refuse(event, *objection, out);
    if (!scale_minus_1_) return refuse(event, scale_minus_1_.error(), out);
    Pending pending;
    pending.origin = event.origin;
    pending.sequence = event.sequence;
    pending.step = *step;
    pending.triggered_at = event.at;
    const PlannedPoint point = planned_at(*step);
    const ApproachClaim approach{point.direction, setup_.reading->sign(),
                                 setup_.reading->least_reading_of_way(setup_.plan.overrun),
                                 approach_since_};
    open_window(std::move(pending), approach,
                setup_.plan.targets[static_cast<std::size_t>(point.target_index)], out);
}

void RunMachine::on(const WindowResult& result, RunActions& out) {
    if (!pending_ || pending_->committing || pending_->window != result.window) {
        ++counters_.stray;
        return;
    }
    pending_->window = 0; // it has answered: nothing is left to be closed
    if (!result.capture) {
        const auto error = result.capture.error();
        if (datum_ && breaks_counting(error.fault)) datum_broken_ = true;
        refuse_pending(error, result.at, out);
        if (datum_ && error.fault == Fault::datum_lost)
            close(false, describe(error), Fault::datum_lost, out);
    } else if (pending_->purpose == Purpose::datum) {
        accept_datum(*result.capture, out);
    } else {
        accept_point(*result.capture, out);
    }
}

void RunMachine::accept_datum(const Capture& capture, RunActions& out) {
    auto& datum = pending_->datum;
    datum.id = setup_.laser_serial + "/" + std::to_string(capture.epoch) + "/" +
               std::to_string(++datum_count_);
    datum.at = capture.end;
    datum.coordinate = setup_.plan.datum;
    datum.reading = capture.mean;
    datum.epoch = capture.epoch;
    datum.spread = capture.spread;
    datum.slope_um_per_s = capture.slope_um_per_s;
    datum.n = capture.n;
    datum.sequence = pending_->sequence;
    datum.device_count = capture.device_count;
    pending_->committing = true;
    pending_->synchronisation = capture.synchronisation;
    out.push_back(CommitDatum{datum, capture.synchronisation});
}

/// `target` is that of the step before the pending one.
bool RunMachine::is_target_before(Length target) const {
    if (!pending_ || pending_->step < 1) return false;
    const auto before = static_cast<std::size_t>(planned_at(pending_->step - 1).target_index);
    return setup_.plan.targets[before] == target;
}

std::string RunMachine::place_text(Length position, Length target) const {
    const auto shown = [this](Length at) { return in_axis_unit(setup_.plan.axis_kind, at); };
    std::string text = "The axis stands at " + shown(position) + ", " +
                       shown(abs(position - target)) + " from the target at " + shown(target) +
                       "; " + shown(setup_.plan.near_tolerance) + " are allowed";
    for (const auto other : setup_.plan.targets)
        if (other != target && abs(position - other) <= setup_.plan.near_tolerance)
            text += "; it stands at the target at " + shown(other) +
                    (is_target_before(other) ? ", the one before: one step late" : "");
    return text + setup_.reading->hint(position - target) + ".";
}

std::optional<Error> RunMachine::objection_to_place(Length position, Length target) const {
    if (abs(position - target) <= setup_.plan.near_tolerance) return std::nullopt;
    if (!setup_.reading->sees_every_place() ||
        static_cast<std::size_t>(view().done) >= diagnosed_targets)
        return Error{Fault::outside_window, place_text(position, target), {}, {}};
    auto claims = first_claims_;
    claims.push_back({target, position});
    return diagnose_first_targets(datum_->coordinate, claims);
}

/// Once, after a restart; a way that was seen to be wrong stays wrong.
bool RunMachine::may_have_been_unseen(const Error& error) const {
    return approach_unseen_ && error.fault == Fault::samples_lost;
}

void RunMachine::accept_point(const Capture& capture, RunActions& out) {
    if (capture.epoch != datum_epoch_) {
        refuse_pending(datum_lost_error("The counter was restarted since the datum."), capture.end,
                       out);
        return close(false, "The counter was restarted since the datum.", Fault::datum_lost, out);
    }
    if (!scale_minus_1_) return refuse_pending(scale_minus_1_.error(), capture.end, out);
    const auto planned = planned_at(pending_->step);
    const auto target = setup_.plan.targets[static_cast<std::size_t>(planned.target_index)];
    const auto found = setup_.reading->position_of(*datum_, capture.mean, *scale_minus_1_, target);
    if (!found) return refuse_pending(found.error(), capture.end, out);
    const Length position = *found;
    if (const auto objection = objection_to_place(position, target))
        return refuse_pending(*objection, capture.end, out);
    const auto& way = capture.approach_travel;
    if (!way && !may_have_been_unseen(way.error()))
        return refuse_pending(way.error(), capture.end, out);
    if (!way)
        record(EventKind::resumed, capture.end,
               "The way to the point of request " + std::to_string(pending_->sequence) +
                   " was not seen: the station was away.",
               Fault::none, pending_->sequence, out);
    if (first_claims_.size() < diagnosed_targets) first_claims_.push_back({target, position});
    auto& point = pending_->point;
    point.step = pending_->step;
    point.sequence = pending_->sequence;
    point.planned = planned;
    point.origin = pending_->origin;
    point.triggered_at = pending_->triggered_at;
    point.window_begin = capture.begin;
    point.window_end = capture.end;
    point.reading = capture.mean;
    point.spread = capture.spread;
    point.slope_um_per_s = capture.slope_um_per_s;
    point.n = capture.n;
    point.approach_travel = setup_.reading->way_of_reading(way.value_or(Length{}));
    point.datum_id = datum_->id;
    point.live_deviation = setup_.reading->deviation_of(*datum_, capture.mean, position, target);
    point.samples = capture.samples;
    last_position_ = position;
    last_deviation_ = point.live_deviation;
    last_synchronisation_ = capture.synchronisation;
    pending_->committing = true;
    pending_->synchronisation = capture.synchronisation;
    out.push_back(CommitPoint{point, capture.synchronisation});
}

void RunMachine::refuse_pending(const Error& error, MonotonicTime at, RunActions& out) {
    const auto pending = std::move(*pending_);
    pending_.reset();
    if (pending.window != 0) out.push_back(CloseWindow{pending.window});
    refuse(pending.sequence, pending.origin, error, at, out);
    set_state(armed_ ? PortState::armed : PortState::idle, out);
}

} // namespace axiscal
