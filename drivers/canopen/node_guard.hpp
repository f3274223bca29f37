#pragma once
// Node guarding, where a node has no heartbeat producer: it is asked for its state once a second by
// a remote frame. Only the questions and their times; no I/O. Loop-bound.
//
// Source: CiA 301 V4.2, 7.2.8.3.2.1. Guard time and life time factor (0x100C, 0x100D) are left as
// they are: they would let the node watch its master.

#include "analysis/quantity/time.hpp"

#include <optional>

namespace axiscal {

class NodeGuard {
public:
    static constexpr Duration period = std::chrono::seconds{1};
    /// Without an answer, of a node that has answered before: 2.5 questions.
    static constexpr Duration patience = std::chrono::milliseconds{2500};
    /// A node that answers none of the first does not know guarding and is not asked any more.
    static constexpr int questions_to_a_stranger = 3;

    void begin(MonotonicTime now);
    void end() { next_.reset(); }
    /// Whether a question is due; it then counts as asked.
    [[nodiscard]] bool asks(MonotonicTime now);
    /// An answer. False: its toggle bit is that of the one before, so it counts as not received.
    [[nodiscard]] bool take(bool toggle, MonotonicTime at);
    /// When the next question is due; empty: there is none.
    [[nodiscard]] std::optional<MonotonicTime> next_question() const { return next_; }
    /// From when on the node is silent; empty: it never answered.
    [[nodiscard]] std::optional<MonotonicTime> silent_from() const;

private:
    std::optional<MonotonicTime> next_, answered_;
    std::optional<bool> toggle_; ///< of the last answer
    int asked_ = 0;              ///< before the first answer
};

} // namespace axiscal
