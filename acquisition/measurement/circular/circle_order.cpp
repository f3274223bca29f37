#include "acquisition/measurement/circular/circle_order.hpp"

#include <algorithm>

namespace axiscal {

CircleOrder::CircleOrder(const CircularPlan& plan)
    : circles_{planned_circles(plan)}
    , requests_a_circle_{requests_a_circle(plan)} {}

CircleOrder::CircleOrder(const CircularPlan& plan, const CirclesBefore& before)
    : circles_{planned_circles(plan)}
    , requests_a_circle_{requests_a_circle(plan)}
    , last_{before.last}
    , interrupted_{before.last > 0}
    , whole_{before.whole}
    , any_accepted_{true} {}

int CircleOrder::begun() const {
    return std::min((last_ + requests_a_circle_ - 1) / requests_a_circle_, circles());
}

const PlannedCircle& CircleOrder::current() const {
    return circles_[static_cast<std::size_t>(std::max(begun(), 1) - 1)];
}

int CircleOrder::first_of(int sequence) const {
    return (sequence - 1) / requests_a_circle_ * requests_a_circle_ + 1;
}

std::string CircleOrder::words_of(int sequence, const char* begins) const {
    const PlannedCircle& circle =
        circles_[static_cast<std::size_t>((sequence - 1) / requests_a_circle_)];
    const int word = sequence - first_of(sequence);
    const std::string number = std::to_string(circle.number);
    if (word > 0) return "The arc of circle " + number + (word == 1 ? " begins." : " ends.");
    return "Circle " + number + " of " + std::to_string(circles_.size()) + " " + begins + ": " +
           std::string{name_of(circle.sense)} + ", " + (circle.warm_up ? "warm-up " : "repeat ") +
           std::to_string(circle.repeat) + ".";
}

CircleVerdict CircleOrder::out_of_order(int wanted) const {
    return {CircleAnswer::refuse, static_cast<std::uint16_t>(wanted),
            "Request " + std::to_string(wanted) + " came, " + std::to_string(last_ + 1) +
                " was expected: start program and test anew.",
            Fault::sequence_lost};
}

CircleVerdict CircleOrder::driven_while_away(int wanted) const {
    return {CircleAnswer::broken, static_cast<std::uint16_t>(wanted),
            "Circle " + std::to_string(current().number) +
                " was driven while the station was away: start the test anew."};
}

namespace {

/// A circle that was skipped, or one less, would make another test than the one that was armed.
CircleVerdict no_such_command(const TriggerEvent& event, std::uint16_t sequence) {
    const char* const name = event.command == TriggerCommand::prepare ? "1, prepare,"
                             : event.command == TriggerCommand::skip  ? "3, skip,"
                                                                      : "5, end,";
    return {CircleAnswer::refuse, sequence,
            std::string{"A circular test has no command "} + name +
                " only 2, capture, before each circle and 4, abort.",
            Fault::bad_command};
}

} // namespace

CircleVerdict CircleOrder::judge(const TriggerEvent& event) {
    if (event.origin == TriggerOrigin::dwell) return {};
    // What stands there when a test is armed belongs to another one: the baseline.
    if (event.standing && !any_accepted_) return {};
    if (event.command == TriggerCommand::abort)
        return {CircleAnswer::abort, event.sequence, "The CNC aborted the test."};
    CircleVerdict verdict = judge_number(event);
    if (verdict.answer != CircleAnswer::begin && verdict.answer != CircleAnswer::end)
        return verdict;
    if (event.command != TriggerCommand::capture) return no_such_command(event, verdict.sequence);
    any_accepted_ = true;
    unseen_ = verdict.once_more;
    pending_ = verdict.sequence;
    return verdict;
}

CircleVerdict CircleOrder::judge_number(const TriggerEvent& event) const {
    const bool cut = interrupted_ && !whole_;
    const int again = interrupted_ ? first_of(last_) : 0;
    const int next = cut ? again : last_ + 1;
    const int wanted = event.origin == TriggerOrigin::manual ? next : event.sequence;
    if (wanted == 0 || wanted == pending_) return {};
    const auto sequence = static_cast<std::uint16_t>(wanted);
    if (pending_) // a CNC that waited for its answer would not be that far
        return unseen_ && wanted == *pending_ + 1 ? driven_while_away(wanted)
                                                  : out_of_order(wanted);
    if (interrupted_ && wanted == again && !(whole_ && wanted == last_))
        return {CircleAnswer::begin, sequence, words_of(wanted, "begins again"), Fault::none,
                requests_a_circle_ == 1};
    if (wanted == last_) return {CircleAnswer::again, sequence, {}};
    if (cut && wanted > again && wanted <= again + requests_a_circle_)
        return driven_while_away(wanted);
    if (unseen_ && wanted == last_ + 1) return driven_while_away(wanted);
    if (wanted != last_ + 1 || wanted > requests() + 1) return out_of_order(wanted);
    if (wanted == requests() + 1) return {CircleAnswer::end, sequence, "Every circle was driven."};
    return {CircleAnswer::begin, sequence, words_of(wanted, "begins")};
}

void CircleOrder::durable() {
    if (pending_) last_ = *pending_;
    pending_.reset();
    interrupted_ = false;
}

} // namespace axiscal
