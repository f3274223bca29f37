#include "drivers/canopen/node_guard.hpp"

#include <utility>

namespace axiscal {

void NodeGuard::begin(MonotonicTime now) {
    next_ = now;
    answered_.reset();
    toggle_.reset();
    asked_ = 0;
}

bool NodeGuard::asks(MonotonicTime now) {
    if (!next_ || now < *next_) return false;
    if (!answered_ && asked_++ == questions_to_a_stranger) {
        end();
        return false;
    }
    next_ = now + period;
    return true;
}

bool NodeGuard::take(bool toggle, MonotonicTime at) {
    if (std::exchange(toggle_, toggle) == toggle) return false;
    answered_ = at;
    return true;
}

std::optional<MonotonicTime> NodeGuard::silent_from() const {
    if (!answered_ || !next_) return std::nullopt;
    return *answered_ + patience;
}

} // namespace axiscal
