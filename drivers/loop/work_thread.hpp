#pragma once
// Threads for what can block: each owns one handle and runs its jobs in order. Results go back to
// the loop by `on_thread`. Architecture: "what can block has a thread that owns its handle". Apart
// stay the journal (timed notes, a clock that tests turn), the log writer (bounded bytes, drops the
// oldest) and the RTU trigger line (two loops meet).

#include "drivers/loop/deadline.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace axiscal {

/// Thread-safe.
class WorkThread {
public:
    using Job = std::function<void()>;
    /// joined: begins at once; the destructor finishes and joins.
    /// left_behind: lives while there are jobs, so that an idle one costs nothing, and outlives
    /// this object until it has done them all. For jobs that may hang in the kernel, where neither
    /// the loop nor the end of the program may wait for them.
    enum class End : std::uint8_t { joined, left_behind };
    explicit WorkThread(End end = End::joined);
    ~WorkThread();
    WorkThread(const WorkThread&) = delete;
    WorkThread& operator=(const WorkThread&) = delete;

    void post(Job job);
    /// Drops what still waits, runs `last` and ends. Does not wait for it.
    void finish(Job last = {});
    /// A long job looks at this between its slices and returns.
    [[nodiscard]] bool wanted() const;    ///< another job waits, or the thread is to end
    [[nodiscard]] bool finishing() const; ///< and perhaps ended
    [[nodiscard]] bool ended() const;
    /// Waits for the end of one that is joined. Loop only.
    void join();

private:
    struct State;
    void wake();
    static void serve(const std::shared_ptr<State>& state);

    std::shared_ptr<State> state_; ///< shared with the thread, which may outlive this object
    std::thread thread_;
};

/// All such threads of one opener. Loop-bound. Destruction ends and joins them, so it must come
/// before the loop's.
class WorkThreads {
public:
    WorkThreads() = default;
    ~WorkThreads();
    WorkThreads(const WorkThreads&) = delete;
    WorkThreads& operator=(const WorkThreads&) = delete;
    /// A thread for the device called `key`.
    /// @errors Fault::busy while the device is in use here; link_timeout while an earlier thread of
    /// it still hangs in a call: a second one would only hang behind it.
    Result<std::shared_ptr<WorkThread>> start(const std::string& key);

private:
    struct Seat {
        std::string key;
        std::shared_ptr<WorkThread> thread;
    };
    std::vector<Seat> seats_;
};

namespace work_thread_detail {
template <class T> struct Pending {
    explicit Pending(const boost::asio::any_io_executor& loop)
        : done{loop, boost::asio::steady_timer::time_point::max()} {}
    std::optional<Result<T>> reply; ///< touched on the loop only, as is `done`
    boost::asio::steady_timer done;
};
template <class T> Task<Result<T>> reply_of(std::shared_ptr<Pending<T>> pending) {
    if (!pending->reply)
        co_await pending->done.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    if (!pending->reply) co_return fail(Fault::link_closed, "given up");
    co_return *std::move(pending->reply);
}
} // namespace work_thread_detail

/// What a device that hangs is called, by whatever it is noticed: a log then tells it once.
inline constexpr const char* device_hangs = "the device does not answer";

/// A job bounds itself by its deadline; beyond that and this it hangs in the kernel.
inline constexpr Duration work_grace = std::chrono::milliseconds{500};

/// Runs `job` on the thread and hands its result to the loop, however long that takes. Loop only.
template <class T>
Task<Result<T>> on_thread(const std::shared_ptr<WorkThread>& thread,
                          const boost::asio::any_io_executor& loop,
                          std::function<Result<T>()> job) {
    auto pending = std::make_shared<work_thread_detail::Pending<T>>(loop);
    thread->post([pending, loop, job = std::move(job)]() mutable {
        auto reply = job();
        // The job's last reference goes with the handler: timers die on the loop.
        boost::asio::post(loop, [pending = std::move(pending), reply = std::move(reply)]() mutable {
            pending->reply = std::move(reply);
            pending->done.cancel();
        });
    });
    return work_thread_detail::reply_of<T>(pending);
}

/// The same within `deadline` and a grace.
/// @errors those of the job; Fault::link_timeout when it still runs then.
template <class T>
Task<Result<T>> on_thread(std::shared_ptr<WorkThread> thread,
                          Scheduler& scheduler,
                          std::function<Result<T>()> job,
                          MonotonicTime deadline) {
    Task<Result<T>> waiting = on_thread<T>(thread, scheduler.executor(), std::move(job));
    auto reply = co_await before(scheduler, std::move(waiting), deadline + work_grace);
    if (!reply) co_return fail(Fault::link_timeout, device_hangs);
    co_return *std::move(reply);
}

} // namespace axiscal
