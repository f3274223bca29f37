#pragma once
// Which request does an answer belong to, where the answer does not tell? Pure.

#include "drivers/sample.hpp"

#include <deque>
#include <optional>

namespace axiscal {

/// Requests to an instrument that answers them in their order, perhaps after the next one was sent,
/// perhaps never. An answer counts for the oldest request that it can belong to: its age is never
/// stated too small. Where an answer leaves requests open, whoever asks is to listen before it asks
/// again, or one lost answer would make every later one look old.
class OpenRequests {
public:
    /// What was not answered for so long, and was asked again, is lost.
    static constexpr Duration latest_answer = std::chrono::seconds{2};

    void asked(MonotonicTime now) { open_.push_back(now); }
    /// @returns when the request was sent that what came at `at` answers, and closes it; empty
    /// where none is open
    std::optional<MonotonicTime> answered(MonotonicTime at);
    /// Until then answers to requests that are open may come; afterwards forget() them. Empty:
    /// nothing is to be waited for. It lies no later than `latest_answer` after the last answer.
    [[nodiscard]] std::optional<MonotonicTime> listen_until() const { return listen_until_; }
    void forget();

private:
    std::deque<MonotonicTime> open_; ///< the oldest first
    std::optional<MonotonicTime> listen_until_;
};

} // namespace axiscal
