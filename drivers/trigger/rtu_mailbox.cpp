#include "drivers/trigger/rtu_mailbox.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

namespace axiscal {

RtuMailbox::RtuMailbox()
    : stop_signal_{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)} {}

RtuMailbox::~RtuMailbox() {
    if (stop_signal_ >= 0) ::close(stop_signal_);
}

void RtuMailbox::put(const RegisterImage& image) {
    const std::lock_guard lock{mutex_};
    image_ = image;
}

void RtuMailbox::count() {
    const std::lock_guard lock{mutex_};
    ++requests_;
    changed_.notify_all();
}

std::optional<RegisterImage> RtuMailbox::image_after(std::uint64_t requests, Duration patience) {
    std::unique_lock lock{mutex_};
    const bool arrived = changed_.wait_for(
        lock, patience, [this, requests] { return stopped_ || requests_ >= requests; });
    if (!arrived || stopped_) return std::nullopt;
    return image_;
}

void RtuMailbox::stop() {
    const std::lock_guard lock{mutex_};
    stopped_ = true;
    changed_.notify_all();
    // Fails only where there is no descriptor; the line then looks by itself.
    if (stop_signal_ >= 0) (void)::eventfd_write(stop_signal_, 1);
}

bool RtuMailbox::stopped() const {
    const std::lock_guard lock{mutex_};
    return stopped_;
}

void RtuMailbox::pause(Duration span) {
    std::unique_lock lock{mutex_};
    changed_.wait_for(lock, span, [this] { return stopped_; });
}

} // namespace axiscal
