// The part of RunMachine that deals with what people decide about readings: to take them again, to
// leave them out. The trigger contract does not change: a retake's points stand behind the plan's
// own, and their requests count on from the last one.
#include "acquisition/run/run_machine.hpp"
#include "analysis/quantity/counted.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace axiscal {
namespace {

bool fits(const PointSelection& selection, const PlannedPoint& point) {
    return (!selection.target || *selection.target == point.target_index) &&
           (!selection.direction || *selection.direction == point.direction) &&
           (!selection.approach || *selection.approach == point.approach);
}

Error refused(std::string sentence) {
    return {Fault::bad_request, std::move(sentence), {}, {}};
}

std::size_t place(int step) {
    return static_cast<std::size_t>(step);
}

} // namespace

PlannedPoint RunMachine::planned_at(int step) const {
    const auto& points = setup_.plan.points;
    const bool again = place(step) >= points.size();
    return points[place(again ? retaken_[place(step) - points.size()] : step)];
}

bool RunMachine::plan_is_done() const {
    return std::ranges::all_of(last_reading_, [](int step) { return step >= 0; });
}

void RunMachine::append_retakes(const std::vector<RetakePoint>& points) {
    for (const RetakePoint& point : points) {
        retaken_.push_back(point.planned_step);
        done_.push_back(false);
        skipped_.push_back(false);
    }
}

bool RunMachine::is_left_out(int planned_step) const {
    return std::ranges::find(excluded_, last_reading_[place(planned_step)]) != excluded_.end();
}

bool RunMachine::leaves_out(int step) const {
    const auto holds_step = [step](const std::vector<int>& steps) {
        return std::ranges::find(steps, step) != steps.end();
    };
    return holds_step(excluded_) && !(unkept_ && holds_step(unkept_->excluded));
}

std::size_t RunMachine::left_out() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(excluded_, [this](int step) { return leaves_out(step); }));
}

std::vector<AcceptedPoint> RunMachine::counting() const {
    std::vector<AcceptedPoint> points;
    for (const AcceptedPoint& point : accepted_) {
        const bool is_last = last_reading_[place(point.planned.step)] == point.step;
        if (is_last && !leaves_out(point.step)) points.push_back(point);
    }
    return points;
}

bool RunMachine::awaits_retake(int planned_step) const {
    for (std::size_t k = 0; k < retaken_.size(); ++k) {
        const std::size_t step = setup_.plan.points.size() + k;
        if (retaken_[k] == planned_step && !done_[step] && !skipped_[step]) return true;
    }
    return false;
}

Result<std::vector<int>> RunMachine::chosen(const PointSelection& selection,
                                            bool skipped_too) const {
    if (!selection.target && !selection.direction && !selection.approach)
        return tl::unexpected<Error>(
            refused("Say which: a target, a direction, a cycle, or several of them."));
    std::vector<int> steps;
    bool planned = false;
    for (const PlannedPoint& point : setup_.plan.points) {
        if (!fits(selection, point)) continue;
        planned = true;
        const bool skipped = skipped_too && is_without_point(point.step);
        if (skipped || last_reading_[place(point.step)] >= 0) steps.push_back(point.step);
    }
    if (!planned)
        return tl::unexpected<Error>(
            refused("The plan has no such point; it has " +
                    counted(static_cast<long>(setup_.plan.targets.size()), "target") + " and " +
                    counted(setup_.plan.approaches, "cycle") +
                    (setup_.plan.bidirectional ? "." : ", in the positive direction only.")));
    if (steps.empty())
        return tl::unexpected<Error>(
            refused("Nothing of that is measured yet: it comes by itself in the plan's order."));
    return steps;
}

std::optional<Error> RunMachine::objection_to_retake(const Retake& retake) const {
    if (!armed_) return Error{Fault::no_run_armed, {}, {}, {}};
    if (stopped_) return Error{Fault::not_durable, "The run acknowledges nothing more.", {}, {}};
    if (closed_ && !complete_)
        return Error{
            Fault::no_run_armed, "The run was closed as incomplete: arm a new one.", {}, {}};
    if (wanted_close_) return Error{Fault::busy, "The run is being closed.", {}, {}};
    if (unkept_) return Error{Fault::busy, "The last order is on its way to the disk.", {}, {}};
    if (!datum_ || datum_broken_)
        return Error{Fault::datum_lost,
                     "The datum is lost: readings taken now would not belong to the run. Arm a new "
                     "one.",
                     {},
                     {}};
    if (retake.reason.empty()) return refused("A retake needs its reason.");
    return std::nullopt;
}

void RunMachine::on(const Retake& retake, RunActions& out) {
    const auto objection = objection_to_retake(retake);
    if (objection) return object(0, *objection, out);
    auto steps = chosen(retake.selection, true);
    if (!steps) return object(0, steps.error(), out);
    std::erase_if(*steps, [this](int step) { return awaits_retake(step); });
    if (steps->empty()) return object(0, refused("That is to be taken again already."), out);
    RetakeRecord record;
    record.number = ++retakes_;
    record.at = retake.at;
    record.reason = retake.reason;
    int step = static_cast<int>(done_.size());
    for (const int planned : *steps)
        record.points.push_back({step++, planned});
    unkept_ = Unkept{done_.size(), {}, closed_};
    append_retakes(record.points);
    out.push_back(RecordRetake{std::move(record), closed_});
}

/// A run that was closed takes requests from now on.
void RunMachine::on(const RevisionKept& kept, RunActions& out) {
    const auto order = std::exchange(unkept_, std::nullopt);
    if (order && order->reopens) reopen(kept.at, out);
}

void RunMachine::reopen(MonotonicTime at, RunActions& out) {
    closed_ = complete_ = false;
    approach_since_ = at; // the way since the closing was not of this run
    approach_unseen_ = false;
    set_state(PortState::armed, out);
}

/// Of those that were lost, what the file holds all the same: a restart would find it there, and the
/// next order counts on behind it. A point of one may have been written with it.
void RunMachine::adopt_orders(const RunRevisions& orders, const RunRecord& run) {
    const std::size_t known = done_.size();
    for (auto k = place(retakes_); k < orders.retakes.size(); ++k)
        append_retakes(orders.retakes[k].points);
    retakes_ = std::max(retakes_, static_cast<int>(orders.retakes.size()));
    for (const ExclusionRecord& exclusion : orders.exclusions)
        if (std::ranges::find(excluded_, exclusion.step) == excluded_.end())
            excluded_.push_back(exclusion.step);
    for (const PointRecord& point : run.points) {
        if (place(point.step) < known || place(point.step) >= done_.size()) continue;
        Pending taken;
        taken.sequence = point.sequence;
        taken.step = point.step;
        taken.point = point;
        adopt(taken);
    }
}

/// Whatever came in between (a commit that failed, a request, an abort) stays as it is.
void RunMachine::on(const RevisionLost& lost, RunActions& out) {
    const auto order = std::exchange(unkept_, std::nullopt);
    if (!order) return;
    std::erase_if(excluded_, [&](int step) {
        return std::ranges::find(order->excluded, step) != order->excluded.end();
    });
    if (order->first_step < done_.size()) take_back_steps(order->first_step, lost.at, out);
}

void RunMachine::take_back_steps(std::size_t first, MonotonicTime at, RunActions& out) {
    const auto gone = [first](const std::optional<Pending>& of) {
        return of && of->step >= static_cast<int>(first);
    };
    if (gone(unwritten_)) unwritten_.reset();
    if (gone(pending_) && !pending_->committing)
        refuse_pending(
            {Fault::not_durable, "The order for this point could not be written.", {}, {}}, at,
            out);
    --retakes_;
    retaken_.resize(first - setup_.plan.points.size());
    done_.resize(first);
    skipped_.resize(first);
}

/// A standard deviation needs two readings; where one was planned, one.
bool RunMachine::leaves_enough(const std::vector<int>& planned_steps) const {
    const int least = std::min(setup_.plan.approaches, 2);
    for (const int step : planned_steps) {
        const PlannedPoint& of = setup_.plan.points[place(step)];
        int left = 0;
        for (const PlannedPoint& other : setup_.plan.points)
            if (other.target_index == of.target_index && other.direction == of.direction &&
                !is_left_out(other.step) &&
                (!is_without_point(other.step) || awaits_retake(other.step)) &&
                std::ranges::find(planned_steps, other.step) == planned_steps.end())
                ++left;
        if (left < least) return false;
    }
    return true;
}

void RunMachine::on(const Exclude& exclude, RunActions& out) {
    const auto no = [&](const Error& error) { object(0, error, out); };
    if (stopped_ || wanted_close_ || (closed_ && !complete_))
        return no({Fault::no_run_armed, "This run takes nothing more.", {}, {}});
    if (unkept_) return no({Fault::busy, "The last order is on its way to the disk.", {}, {}});
    if (exclude.reason.empty()) return no(refused("An exclusion needs its reason."));
    auto steps = chosen(exclude.selection, false);
    if (!steps) return no(steps.error());
    std::erase_if(*steps, [this](int step) { return is_left_out(step); });
    if (steps->empty()) return no(refused("That is left out already."));
    if (!leaves_enough(*steps))
        return no(refused("At least two readings of each target and direction must remain for a "
                          "standard deviation; take the point again instead."));
    unkept_ = Unkept{done_.size(), {}, false};
    std::vector<ExclusionRecord> records;
    records.reserve(steps->size());
    for (const int planned : *steps) {
        ExclusionRecord record;
        record.step = last_reading_[place(planned)];
        record.at = exclude.at;
        record.reason = exclude.reason;
        excluded_.push_back(record.step);
        unkept_->excluded.push_back(record.step);
        records.push_back(std::move(record));
    }
    out.push_back(RecordExclusion{std::move(records), closed_});
}

} // namespace axiscal
