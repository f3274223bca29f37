#include "drivers/loop/work_thread.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

namespace axiscal {

struct WorkThread::State {
    explicit State(End of)
        : end{of} {}
    /// What to do next; nothing: the thread ends.
    std::optional<Job> next();
    /// True once for each thread that is to begin.
    bool needs_a_thread();

    const End end;
    std::mutex mutex; ///< guards all below
    std::condition_variable wake;
    std::deque<Job> jobs;
    bool finishing = false, ended = false;
    bool serving = false; ///< a thread that is left behind is there
};

std::optional<WorkThread::Job> WorkThread::State::next() {
    std::unique_lock lock{mutex};
    if (end == End::joined) wake.wait(lock, [this] { return finishing || !jobs.empty(); });
    if (jobs.empty()) {
        ended = finishing;
        serving = false;
        return std::nullopt;
    }
    Job job = std::move(jobs.front());
    jobs.pop_front();
    return job;
}

bool WorkThread::State::needs_a_thread() {
    const std::lock_guard lock{mutex};
    return end == End::left_behind && !jobs.empty() && !std::exchange(serving, true);
}

WorkThread::WorkThread(End end)
    : state_{std::make_shared<State>(end)} {
    if (end == End::joined) thread_ = std::thread{&WorkThread::serve, state_};
}

WorkThread::~WorkThread() {
    if (state_->end == End::joined) finish();
    join();
}

void WorkThread::join() {
    if (thread_.joinable()) thread_.join();
}

void WorkThread::post(Job job) {
    {
        const std::lock_guard lock{state_->mutex};
        if (state_->finishing) return;
        state_->jobs.push_back(std::move(job));
    }
    wake();
}

void WorkThread::wake() {
    state_->wake.notify_all();
    if (state_->needs_a_thread()) std::thread{&WorkThread::serve, state_}.detach();
}

void WorkThread::finish(Job last) {
    std::deque<Job> dropped; // dies without the lock: what it holds may be large
    {
        const std::lock_guard lock{state_->mutex};
        if (state_->finishing) return;
        state_->finishing = true;
        dropped.swap(state_->jobs);
        if (last) state_->jobs.push_back(std::move(last));
    }
    wake();
}

bool WorkThread::wanted() const {
    const std::lock_guard lock{state_->mutex};
    return state_->finishing || !state_->jobs.empty();
}

bool WorkThread::finishing() const {
    const std::lock_guard lock{state_->mutex};
    return state_->finishing;
}

bool WorkThread::ended() const {
    const std::lock_guard lock{state_->mutex};
    return state_->ended;
}

void WorkThread::serve(const std::shared_ptr<State>& state) {
    while (const auto job = state->next())
        (*job)(); // what it holds goes before the next one is done
}

WorkThreads::~WorkThreads() {
    for (const Seat& seat : seats_)
        seat.thread->finish();
    // Links that their drivers' frames still hold keep the object, not the thread.
    for (const Seat& seat : seats_)
        seat.thread->join();
}

Result<std::shared_ptr<WorkThread>> WorkThreads::start(const std::string& key) {
    std::erase_if(seats_, [](const Seat& seat) { return seat.thread->ended(); });
    for (const Seat& seat : seats_) {
        if (seat.key != key) continue;
        if (seat.thread->finishing()) return fail(Fault::link_timeout, device_hangs);
        return fail(Fault::busy, key + " is in use by another instrument of this station");
    }
    seats_.push_back({key, std::make_shared<WorkThread>()});
    return seats_.back().thread;
}

} // namespace axiscal
