#include "drivers/link/work_thread.hpp"

#include <algorithm>

namespace axiscal {

WorkThread::WorkThread()
    : thread_{&WorkThread::serve, this} {}

WorkThread::~WorkThread() {
    finish();
    join();
}

void WorkThread::join() {
    if (thread_.joinable()) thread_.join();
}

void WorkThread::post(Job job) {
    {
        const std::lock_guard lock{mutex_};
        if (finishing_) return;
        jobs_.push_back(std::move(job));
    }
    wake_.notify_all();
}

void WorkThread::finish(Job last) {
    std::deque<Job> dropped; // dies without the lock: what it holds may be large
    {
        const std::lock_guard lock{mutex_};
        if (finishing_) return;
        finishing_ = true;
        dropped.swap(jobs_);
        if (last) jobs_.push_back(std::move(last));
    }
    wake_.notify_all();
}

bool WorkThread::wanted() const {
    const std::lock_guard lock{mutex_};
    return finishing_ || !jobs_.empty();
}

bool WorkThread::finishing() const {
    const std::lock_guard lock{mutex_};
    return finishing_;
}

bool WorkThread::ended() const {
    const std::lock_guard lock{mutex_};
    return ended_;
}

std::optional<WorkThread::Job> WorkThread::next() {
    std::unique_lock lock{mutex_};
    wake_.wait(lock, [this] { return finishing_ || !jobs_.empty(); });
    if (jobs_.empty()) {
        ended_ = true;
        return std::nullopt;
    }
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    return job;
}

void WorkThread::serve() {
    while (const auto job = next())
        (*job)();
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
