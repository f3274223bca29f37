#include "acquisition/run/circle_order.hpp"

namespace axiscal {
namespace {

std::string words_of(const PlannedCircle& circle, std::size_t of) {
    return "Circle " + std::to_string(circle.number) + " of " + std::to_string(of) +
           " begins: " + std::string{name_of(circle.sense)} + ", " +
           (circle.warm_up ? "warm-up " : "repeat ") + std::to_string(circle.repeat) + ".";
}

} // namespace

CircleOrder::CircleOrder(const CircularPlan& plan)
    : circles_{planned_circles(plan)} {}

CircleVerdict CircleOrder::judge(const TriggerEvent& event) {
    if (event.origin == TriggerOrigin::dwell) return {};
    if (event.command == TriggerCommand::abort)
        return {CircleAnswer::abort, event.sequence, "The CNC aborted the test."};
    const int wanted = event.origin == TriggerOrigin::manual ? last_ + 1 : event.sequence;
    if (wanted == 0 || wanted == pending_) return {};
    const auto sequence = static_cast<std::uint16_t>(wanted);
    if (wanted == last_) return {CircleAnswer::again, sequence, {}};
    if (pending_ || wanted != last_ + 1 || wanted > circles() + 1)
        return {CircleAnswer::refuse, sequence,
                "Request " + std::to_string(wanted) + " came, " + std::to_string(last_ + 1) +
                    " was expected: start program and test anew."};
    pending_ = wanted;
    if (wanted == circles() + 1) return {CircleAnswer::end, sequence, "Every circle was driven."};
    return {CircleAnswer::begin, sequence,
            words_of(circles_[static_cast<std::size_t>(last_)], circles_.size())};
}

void CircleOrder::durable() {
    if (pending_) last_ = *pending_;
    pending_.reset();
}

} // namespace axiscal
