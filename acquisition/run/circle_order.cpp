#include "acquisition/run/circle_order.hpp"

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
    , whole_{before.whole} {}

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
                " was expected: start program and test anew."};
}

CircleVerdict CircleOrder::judge(const TriggerEvent& event) {
    if (event.origin == TriggerOrigin::dwell) return {};
    if (event.command == TriggerCommand::abort)
        return {CircleAnswer::abort, event.sequence, "The CNC aborted the test."};
    const bool cut = interrupted_ && !whole_;
    const int again = interrupted_ ? first_of(last_) : 0;
    const int next = cut ? again : last_ + 1;
    const int wanted = event.origin == TriggerOrigin::manual ? next : event.sequence;
    if (wanted == 0 || wanted == pending_) return {};
    const auto sequence = static_cast<std::uint16_t>(wanted);
    if (pending_) return out_of_order(wanted);
    if (interrupted_ && wanted == again) {
        pending_ = wanted;
        return {CircleAnswer::begin, sequence, words_of(wanted, "begins again")};
    }
    if (wanted == last_) return {CircleAnswer::again, sequence, {}};
    if (cut && wanted > again && wanted <= again + requests_a_circle_)
        return {CircleAnswer::broken, sequence,
                "Circle " + std::to_string((last_ - 1) / requests_a_circle_ + 1) +
                    " was driven while the station was away: start the test anew."};
    if (wanted != last_ + 1 || wanted > requests() + 1) return out_of_order(wanted);
    pending_ = wanted;
    if (wanted == requests() + 1) return {CircleAnswer::end, sequence, "Every circle was driven."};
    return {CircleAnswer::begin, sequence, words_of(wanted, "begins")};
}

void CircleOrder::durable() {
    if (pending_) last_ = *pending_;
    pending_.reset();
    interrupted_ = false;
}

} // namespace axiscal
