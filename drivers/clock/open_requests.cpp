#include "drivers/clock/open_requests.hpp"

#include <algorithm>

namespace axiscal {

std::optional<MonotonicTime> OpenRequests::answered(MonotonicTime at) {
    while (open_.size() > 1 && at - open_.front() > latest_answer)
        open_.pop_front();
    listen_until_.reset();
    if (open_.empty()) return std::nullopt;
    const MonotonicTime asked = open_.front();
    open_.pop_front();
    // An instrument that works off its requests one by one sends the next answer when it has spent
    // the same time again, and no longer than this answer took.
    if (!open_.empty())
        listen_until_ = at + std::clamp(2 * (at - asked), Duration{}, latest_answer);
    return asked;
}

void OpenRequests::forget() {
    open_.clear();
    listen_until_.reset();
}

} // namespace axiscal
