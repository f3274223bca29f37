#pragma once
// The order of requests in a circular test: n before circle n, one more after the last. Pure.

#include "analysis/circular/circular_setup.hpp"
#include "drivers/trigger_port.hpp"

#include <optional>
#include <string>

namespace axiscal {

enum class CircleAnswer : std::uint8_t {
    ignore, ///< idle, or this request is under way
    begin,  ///< circle `sequence` comes next: make it durable, then acknowledge
    end,    ///< the last circle was driven
    again,  ///< the last durable request came again: acknowledge it again
    abort,  ///< the CNC gives up
    refuse  ///< out of order: the count is lost
};

struct CircleVerdict {
    CircleAnswer answer = CircleAnswer::ignore;
    std::uint16_t sequence = 0;
    std::string sentence; ///< what begins, or why it is refused
};

class CircleOrder {
public:
    explicit CircleOrder(const CircularPlan& plan);

    /// A manual request has no number: it is the next one. Dwells mean nothing here. After `begin`
    /// or `end` the caller answers with durable() or failed().
    CircleVerdict judge(const TriggerEvent& event);
    void durable();
    void failed() { pending_.reset(); }

    [[nodiscard]] int circles() const { return static_cast<int>(circles_.size()); }
    [[nodiscard]] int begun() const { return last_ > circles() ? circles() : last_; }
    [[nodiscard]] std::uint16_t last_durable() const { return static_cast<std::uint16_t>(last_); }

private:
    std::vector<PlannedCircle> circles_;
    int last_ = 0; ///< sequence that is durable
    std::optional<int> pending_;
};

} // namespace axiscal
