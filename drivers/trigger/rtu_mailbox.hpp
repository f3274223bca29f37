#pragma once
// What the thread of a serial line and the loop tell each other. Thread-safe; no call waits longer
// than it was told to.

#include "drivers/trigger/register_map.hpp"

#include <condition_variable>
#include <mutex>

namespace axiscal {

class RtuMailbox {
public:
    RtuMailbox();
    ~RtuMailbox();
    RtuMailbox(const RtuMailbox&) = delete;
    RtuMailbox& operator=(const RtuMailbox&) = delete;

    /// The loop: what is to be read from now on.
    void put(const RegisterImage& image);
    /// The loop: one more posted request is answered by the image.
    void count();
    /// The line's thread: the image once it answers so many posted requests, as the loop stamped
    /// it. Empty when the loop did not come round in time.
    std::optional<RegisterImage> image_after(std::uint64_t requests, Duration patience);

    void stop();
    [[nodiscard]] bool stopped() const;
    /// A descriptor that is readable from stop() on, to be polled beside the line; -1 where the
    /// system had none to give.
    [[nodiscard]] int stop_signal() const { return stop_signal_; }
    /// The line's thread: a pause that stop() cuts short.
    void pause(Duration span);

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    RegisterImage image_;
    std::uint64_t requests_ = 0;
    bool stopped_ = false;
    int stop_signal_; ///< eventfd
};

} // namespace axiscal
