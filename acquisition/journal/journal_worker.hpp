#pragma once
// The journal's own thread: it alone holds the run file, and writes what was noted with the next
// commit, at the latest after two seconds. Private to the journal.

#include "acquisition/journal/journal.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <boost/asio/async_result.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace axiscal {

struct Journal::Worker {
    using Job = std::function<void()>;

    Worker(boost::asio::any_io_executor loop_executor,
           JournalThread where,
           JournalClock& journal_clock);
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker();

    void enqueue(Job job);

    /// More of one kind. After hours without a disk the newest is let go.
    template <class T> void queue_note(std::vector<T>& queue, std::vector<T> items) {
        queue_with([&](RunBatch&) {
            if (queue.size() > most_kept) return false;
            queue.insert(queue.end(), std::make_move_iterator(items.begin()),
                         std::make_move_iterator(items.end()));
            return true;
        });
    }
    /// Puts `put(noted)` in the queue of notes unless that says no.
    template <class Put> bool queue_with(const Put& put) {
        {
            const std::scoped_lock lock{mutex};
            if (!put(noted)) return false;
            if (!save_at) save_at = clock.now() + longest_unsaved;
        }
        if (thread.joinable())
            wake.notify_one();
        else
            (void)save_notes(); // a failure is remembered and fails the next commit
        return true;
    }

    // The rest is the thread's, between its jobs or as one of them.
    Result<void> save_notes();
    Result<void> write_with_notes(RunBatch batch);
    Result<void> take(Result<RunFileWriter> opened);
    /// A failure of another file, closed since, is no reason against a new one.
    Result<void> may_open();
    void let_go();
    /// The first failed commit, which is final.
    [[nodiscard]] std::optional<Error> known_failure() const;
    Result<void> close(bool complete, const std::string& reason, const ClockTie& tie);

    static constexpr std::chrono::seconds longest_unsaved{2};
    static constexpr std::size_t most_kept = 100'000; // while nothing can be written: a few MB

    mutable std::mutex
        mutex; // guards jobs, noted, save_at, broken; the writer belongs to the thread
    std::condition_variable_any wake;
    std::deque<Job> jobs;
    RunBatch noted;
    std::optional<JournalClock::Time> save_at; // when something is noted
    std::optional<Error> broken;
    std::optional<RunFileWriter> writer;
    std::shared_ptr<const SecretKey> key; ///< set before the first job
    boost::asio::any_io_executor loop;
    JournalClock& clock;
    std::jthread thread;

private:
    void serve(const std::stop_token& stop);
    RunBatch take_notes();
    void drop_orders();
    void put_back(RunBatch notes);
    Result<void> write(const RunBatch& batch);
    Result<void> remember(Result<void> outcome);
};

// What one call waits for. Shared by the two threads in turn: the job writes the outcome before it
// posts the completion, the coroutine reads it afterwards.
template <class T> struct Call { std::optional<Result<T>> outcome; };

// Hands the job to the worker and completes on the loop. An initiation of its own and not a timer,
// so that no cancellation can leave the job's outcome unread; the guard keeps the loop alive.
template <class Worker, class T> struct StartCall {
    Worker* worker;
    std::shared_ptr<Call<T>> call;
    std::function<Result<T>()> work;

    template <class Handler> void operator()(Handler&& handler) {
        auto shared = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
        auto guard = boost::asio::make_work_guard(worker->loop);
        worker->enqueue(
            [loop = worker->loop, waiting = call, job = std::move(work), shared, guard]() mutable {
                waiting->outcome = job();
                boost::asio::post(loop, [waiter = std::move(shared)] { (*waiter)(); });
                guard.reset();
            });
    }
};

template <class Worker, class T>
Task<Result<T>> perform(Worker* worker, std::function<Result<T>()> work) {
    auto call = std::make_shared<Call<T>>();
    StartCall<Worker, T> start{worker, call, std::move(work)};
    co_await boost::asio::async_initiate<const boost::asio::use_awaitable_t<>, void()>(
        std::move(start), boost::asio::use_awaitable);
    co_return *std::move(call->outcome);
}

} // namespace axiscal
