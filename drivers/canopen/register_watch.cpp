#include "drivers/canopen/register_watch.hpp"

#include <utility>

namespace axiscal {
namespace {

/// A node answers within some milliseconds; then it may be asked again.
constexpr Duration reply_patience = std::chrono::seconds{1};

} // namespace

std::optional<CanFrame> RegisterWatch::question(MonotonicTime now) {
    const bool waits = asked_ && now < asked_at_ + reply_patience;
    if (!due_ || waits) return std::nullopt;
    due_ = false;
    asked_ = SdoTransfer::read(node_, error_register_key);
    asked_at_ = now;
    return asked_->request();
}

std::optional<unsigned> RegisterWatch::take(const CanFrame& frame) {
    if (!asked_) return std::nullopt;
    const auto step = asked_->take(frame);
    if (step && *step == SdoTransfer::Step::ignored) return std::nullopt;
    const auto answered = std::exchange(asked_, std::nullopt);
    const bool done = step && *step == SdoTransfer::Step::done;
    if (due_ || !done || answered->content().empty()) return std::nullopt;
    return std::to_integer<unsigned>(answered->content().front());
}

} // namespace axiscal
