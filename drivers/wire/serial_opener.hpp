#pragma once
// Opens and closes one terminal where waiting hurts nobody. close(2) of a USB serial port whose
// device takes no more bytes lasts 30 s (closing_wait of the kernel's tty_port; only root may
// change it, and tcflush does not help), open(2) as long as the adapter's control requests take to
// fail.

#include "drivers/loop/work_thread.hpp"
#include "drivers/wire/byte_link.hpp"

#include <functional>
#include <mutex>

namespace axiscal {

/// A descriptor, or the error of opening it. Made by whoever opens; closed where it is not wanted.
using TtyOpener = std::function<Result<int>()>;

/// One job after the other on a thread of its own: what is closed is closed before the same path is
/// opened again, so that a replugged adapter gets its old node. open() and forget_loop() are
/// loop-bound, close() is thread-safe. A job that hangs in the kernel is left behind.
class SerialOpener : public std::enable_shared_from_this<SerialOpener> {
public:
    SerialOpener(std::string name, boost::asio::any_io_executor loop);

    /// @errors link_timeout when the kernel is still busy with this line at the deadline (what it
    /// opens later is closed again), and those of the opener.
    Task<Result<int>> open(Scheduler& scheduler, TtyOpener opener, MonotonicTime deadline);
    void close(int descriptor);
    /// The loop is about to end: nothing is posted to it any more.
    void forget_loop();

private:
    struct Request;
    Task<bool> answered(std::shared_ptr<Request> request);
    void hand_over(const std::weak_ptr<Request>& request, Result<int> opened);

    std::string name_;
    std::mutex mutex_;                  ///< guards loop_
    boost::asio::any_io_executor loop_; ///< empty once forgotten
    WorkThread thread_{WorkThread::End::left_behind};
};

} // namespace axiscal
