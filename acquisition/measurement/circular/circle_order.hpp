#pragma once
// The order of requests in a circular test: one before each circle, with StartMethod::trigger also
// one at each end of its arc, one more after the last circle. Pure.

#include "analysis/record/circular_setup.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <optional>
#include <string>

namespace axiscal {

enum class CircleAnswer : std::uint8_t {
    ignore, ///< idle, or this request is under way
    begin,  ///< circle `sequence` comes next, or its arc: make it durable, then acknowledge
    end,    ///< the last circle was driven
    again,  ///< the last durable request came again: acknowledge it again
    abort,  ///< the CNC gives up
    broken, ///< a circle was driven while the station was away: the test cannot go on
    refuse  ///< out of order, or a command that no circle has: `fault` says which
};

struct CircleVerdict {
    CircleAnswer answer = CircleAnswer::ignore;
    std::uint16_t sequence = 0;
    std::string sentence;      ///< what begins, or why it is refused
    Fault fault = Fault::none; ///< with `refuse`
    /// With `begin`, of a circle with a feed-in that was under way when the station ended: the CNC
    /// may stand at its request and wait, or drive it. Look on, and call circle_seen().
    bool once_more = false;
};

/// What a restarted station knows of the circles of an open test.
struct CirclesBefore {
    int last = 0;       ///< request that is durable; 0: none
    bool whole = false; ///< the circle of it was recorded to its end
};

class CircleOrder {
public:
    explicit CircleOrder(const CircularPlan& plan);
    /// Goes on after a restart. The request before a circle that is not whole begins it again; the
    /// next one is taken where that circle is whole, or was seen whole since.
    CircleOrder(const CircularPlan& plan, const CirclesBefore& before);

    /// A manual request has no number: it is the next one, or after an interruption the one before
    /// the circle that is not whole. Dwells mean nothing here. After `begin` or `end` the caller
    /// answers with durable() or failed().
    CircleVerdict judge(const TriggerEvent& event);
    void durable();
    void failed() { pending_.reset(); }
    /// The circle that began once more was driven from its feed-in to its feed-out. Without this
    /// the next request is `broken`.
    void circle_seen() { unseen_ = false; }

    [[nodiscard]] int circles() const { return static_cast<int>(circles_.size()); }
    [[nodiscard]] int begun() const;
    /// The circle of the last durable request, the first one before that.
    [[nodiscard]] const PlannedCircle& current() const;
    [[nodiscard]] std::uint16_t last_durable() const { return static_cast<std::uint16_t>(last_); }

private:
    [[nodiscard]] int requests() const { return circles() * requests_a_circle_; }
    /// The request before the circle that `sequence` speaks of.
    [[nodiscard]] int first_of(int sequence) const;
    [[nodiscard]] std::string words_of(int sequence, const char* begins) const;
    [[nodiscard]] CircleVerdict out_of_order(int wanted) const;
    [[nodiscard]] CircleVerdict driven_while_away(int wanted) const;
    [[nodiscard]] CircleVerdict judge_number(const TriggerEvent& event) const;

    std::vector<PlannedCircle> circles_;
    int requests_a_circle_ = 1;
    int last_ = 0;              ///< sequence that is durable
    bool interrupted_ = false;  ///< since then, and nothing was asked yet
    bool whole_ = false;        ///< and its circle was recorded all the same
    bool unseen_ = false;       ///< it began once more, and nobody saw it driven
    bool any_accepted_ = false; ///< by the station that opened the test, if it is another one
    std::optional<int> pending_;
};

} // namespace axiscal
