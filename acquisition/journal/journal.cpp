#include "acquisition/journal/journal.hpp"

#include "acquisition/journal/run_file.hpp"

#include <boost/asio/async_result.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <deque>
#include <thread>

namespace axiscal {
namespace {

constexpr std::chrono::seconds longest_unsaved{2};
constexpr std::size_t most_kept = 100'000; // notes while nothing can be written: a few MB

} // namespace

struct Journal::Worker {
    using Job = std::function<void()>;

    Worker(boost::asio::any_io_executor loop_executor,
           JournalThread where,
           JournalClock& journal_clock)
        : loop{std::move(loop_executor)}
        , clock{journal_clock} {
        if (where == JournalThread::own)
            thread = std::jthread{[this](const std::stop_token& stop) { serve(stop); }};
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        if (thread.joinable()) {
            thread.request_stop();
            thread.join();
        }
        (void)save_notes(); // a failure is remembered; nobody is left to hear it
    }

    void enqueue(Job job) {
        if (!thread.joinable()) return job();
        const std::scoped_lock lock{mutex};
        jobs.push_back(std::move(job));
        wake.notify_one();
    }

    template <class T> void queue_note(std::vector<T>& queue, std::vector<T> items) {
        {
            const std::scoped_lock lock{mutex};
            if (queue.size() > most_kept) return; // hours without a disk: the newest is let go
            queue.insert(queue.end(), std::make_move_iterator(items.begin()),
                         std::make_move_iterator(items.end()));
            if (!save_at) save_at = clock.now() + longest_unsaved;
        }
        if (thread.joinable()) return wake.notify_one();
        (void)save_notes(); // a failure is remembered and fails the next commit
    }

    // Jobs in order; between them, notes that waited long enough, however many jobs there are.
    void serve(const std::stop_token& stop) {
        std::unique_lock lock{mutex};
        while (!stop.stop_requested() || !jobs.empty()) {
            const auto until = save_at;
            clock.sleep({lock, wake, stop}, until,
                        [this, until] { return !jobs.empty() || save_at != until; });
            if (save_at && clock.now() >= *save_at) {
                save_at = clock.now() + longest_unsaved; // if it is before a run
                run_unlocked(lock, [this] { (void)save_notes(); });
            }
            if (jobs.empty()) continue;
            const Job job = std::move(jobs.front());
            jobs.pop_front();
            run_unlocked(lock, job);
        }
    }

    static void run_unlocked(std::unique_lock<std::mutex>& lock, const Job& job) {
        lock.unlock();
        job();
        lock.lock();
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

    RunBatch take_notes() {
        const std::scoped_lock lock{mutex};
        save_at.reset();
        return std::exchange(noted, {});
    }

    Result<void> save_notes() {
        if (!writer) return {}; // before a run: kept for its first commit
        if (auto why = known_failure()) return tl::unexpected<Error>(*why);
        RunBatch notes = take_notes();
        auto written = write(notes);
        if (!written) put_back(std::move(notes));
        return written;
    }

    /// What could not be written waits for a disk. If it is there after all it stands there twice.
    /// An order of a person does not wait: who gave it is told that it was not kept.
    void put_back(RunBatch notes) {
        const std::scoped_lock lock{mutex};
        notes.preflight.insert(notes.preflight.end(), noted.preflight.begin(),
                               noted.preflight.end());
        noted.preflight = std::move(notes.preflight);
        notes.events.insert(notes.events.end(), noted.events.begin(), noted.events.end());
        notes.environment.insert(notes.environment.end(), noted.environment.begin(),
                                 noted.environment.end());
        notes.chunks.insert(notes.chunks.end(), std::make_move_iterator(noted.chunks.begin()),
                            std::make_move_iterator(noted.chunks.end()));
        noted.events = std::move(notes.events);
        noted.environment = std::move(notes.environment);
        noted.chunks = std::move(notes.chunks);
        if (!notes.circular) return;
        noted.circular = std::move(notes.circular);
        noted.streams = std::move(notes.streams);
    }

    Result<void> write_with_notes(const RunBatch& batch) {
        if (!writer) return fail(Fault::no_run_armed, "no run file is open");
        if (auto why = known_failure()) return tl::unexpected<Error>(*why);
        RunBatch notes = take_notes(), whole = batch;
        // What was noted before comes first: the chain tells the order.
        whole.events.insert(whole.events.begin(), notes.events.begin(), notes.events.end());
        whole.environment = notes.environment;
        whole.circular = notes.circular;
        whole.streams = notes.streams;
        whole.chunks = notes.chunks;
        whole.preflight = notes.preflight;
        whole.retakes = notes.retakes;
        whole.exclusions = notes.exclusions;
        auto written = write(whole);
        if (!written) put_back(std::move(notes));
        return written;
    }

    void let_go() {
        writer.reset();
        const std::scoped_lock lock{mutex};
        broken.reset();
    }

    Result<void> write(const RunBatch& batch) {
        if (auto why = known_failure()) return tl::unexpected<Error>(*why);
        if (!writer) return fail(Fault::no_run_armed, "no run file is open");
        return remember(writer->write(batch));
    }

    Result<void> remember(Result<void> outcome) {
        if (outcome || outcome.error().fault != Fault::not_durable) return outcome;
        const std::scoped_lock lock{mutex};
        broken = outcome.error();
        return outcome;
    }

    std::optional<Error> known_failure() const {
        const std::scoped_lock lock{mutex};
        return broken;
    }

    Result<void> take(Result<RunFileWriter> opened) {
        if (!opened) return remember(tl::unexpected<Error>(opened.error()));
        writer.emplace(*std::move(opened));
        return {};
    }

    /// A failure of another file, closed since, is no reason against a new one.
    Result<void> may_open() {
        if (writer) return fail(Fault::busy, writer->path() + " is still open");
        let_go();
        return {};
    }

    Result<void> close(bool complete, const std::string& reason, const ClockTie& tie) {
        AXISCAL_CHECK(save_notes());
        if (auto why = known_failure()) return tl::unexpected<Error>(*why);
        if (!writer) return fail(Fault::no_run_armed, "no run file is open");
        auto closed = remember(writer->close(complete, reason, tie));
        if (closed) writer.reset();
        return closed;
    }

    mutable std::mutex
        mutex; // guards jobs, noted, save_at, broken; the writer belongs to the thread
    std::condition_variable_any wake;
    std::deque<Job> jobs;
    RunBatch noted;
    std::optional<JournalClock::Time> save_at; // when something is noted
    std::optional<Error> broken;
    std::optional<RunFileWriter> writer;
    boost::asio::any_io_executor loop;
    JournalClock& clock;
    std::jthread thread;
};

namespace {

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

} // namespace

Journal::Journal(Scheduler& scheduler, JournalThread thread, JournalClock& clock)
    : scheduler_{scheduler}
    , worker_{std::make_unique<Worker>(scheduler.executor(), thread, clock)} {}
Journal::~Journal() = default;

Task<Result<void>> Journal::open(std::string path, RunRecord header) {
    return open(std::move(path), std::move(header), RunAttachments{});
}

Task<Result<void>> Journal::open(std::string path, RunRecord header, RunAttachments attachments) {
    Worker* worker = worker_.get();
    auto shared = std::make_shared<const RunRecord>(std::move(header));
    auto beside = std::make_shared<const RunAttachments>(std::move(attachments));
    std::function<Result<void>()> work = [worker, path, shared, beside]() -> Result<void> {
        AXISCAL_CHECK(worker->may_open());
        return worker->take(RunFileWriter::create(path, *shared, *beside));
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<void>> Journal::reopen(std::string path) {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker, path]() -> Result<void> {
        AXISCAL_CHECK(worker->may_open());
        return worker->take(RunFileWriter::reopen(path));
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<void>> Journal::reopen_closed(std::string path,
                                          std::optional<RetakeRecord> retake,
                                          std::vector<ExclusionRecord> exclusions) {
    Worker* worker = worker_.get();
    auto first = std::make_shared<RunBatch>();
    if (retake) first->retakes.push_back(*std::move(retake));
    first->exclusions = std::move(exclusions);
    std::function<Result<void>()> work = [worker, path, first]() -> Result<void> {
        AXISCAL_CHECK(worker->may_open());
        return worker->take(RunFileWriter::reopen_closed(path, *first));
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<JournalReceipt>> Journal::commit(RunBatch batch, std::uint16_t sequence, int step) {
    Worker* worker = worker_.get();
    auto shared = std::make_shared<RunBatch>(std::move(batch));
    std::function<Result<void>()> work = [worker, shared] {
        return worker->write_with_notes(*shared);
    };
    const auto written = co_await perform<Worker, void>(worker, std::move(work));
    if (!written) co_return tl::unexpected<Error>(written.error());
    co_return JournalReceipt{sequence, step};
}

Task<Result<JournalReceipt>> Journal::commit(PointRecord point) {
    const auto sequence = point.sequence;
    const int step = point.step;
    RunBatch batch;
    batch.point = std::move(point);
    co_return co_await commit(std::move(batch), sequence, step);
}

Task<Result<JournalReceipt>> Journal::commit(DatumRecord datum) {
    const auto sequence = datum.sequence;
    RunBatch batch;
    batch.datum = std::move(datum);
    co_return co_await commit(std::move(batch), sequence, -1);
}

Task<Result<JournalReceipt>> Journal::commit(EventRecord event, int step) {
    const auto sequence = event.sequence;
    RunBatch batch;
    batch.events.push_back(std::move(event));
    co_return co_await commit(std::move(batch), sequence, step);
}

Task<Result<JournalReceipt>> Journal::receipt_for(int step) {
    const Lookup lookup = [](const RunFileWriter& writer, int key) {
        return key < 0 ? writer.sequence_of_last_datum() : writer.sequence_of_point(key);
    };
    co_return co_await receipt_by(lookup, step, step);
}

Task<Result<JournalReceipt>> Journal::receipt_for_skip(std::uint16_t sequence, int step) {
    const Lookup lookup = [](const RunFileWriter& writer, int key) {
        return writer.sequence_of_skip(static_cast<std::uint16_t>(key));
    };
    co_return co_await receipt_by(lookup, sequence, step);
}

Task<Result<JournalReceipt>> Journal::receipt_by(Lookup lookup, int key, int step) {
    Worker* worker = worker_.get();
    std::function<Result<std::uint16_t>()> work = [worker, lookup, key,
                                                   step]() -> Result<std::uint16_t> {
        if (!worker->writer) return fail(Fault::no_run_armed, "no run file is open");
        AXISCAL_TRY(const auto sequence, lookup(*worker->writer, key));
        if (!sequence)
            return fail(Fault::not_found,
                        worker->writer->path() + " holds no point of step " + std::to_string(step));
        return *sequence;
    };
    const auto sequence = co_await perform<Worker, std::uint16_t>(worker, std::move(work));
    if (!sequence) co_return tl::unexpected<Error>(sequence.error());
    co_return JournalReceipt{*sequence, step};
}

Task<Result<JournalReceipt>> Journal::receipt_of_closed(std::string path) {
    Worker* worker = worker_.get();
    std::function<Result<LastRequest>()> work = [path]() -> Result<LastRequest> {
        AXISCAL_TRY(const auto last, last_request_of_closed(path));
        if (!last) return fail(Fault::not_found, path + " holds nothing that a CNC asked for");
        return *last;
    };
    const auto last = co_await perform<Worker, LastRequest>(worker, std::move(work));
    if (!last) co_return tl::unexpected<Error>(last.error());
    co_return JournalReceipt{last->sequence, last->step};
}

Task<Result<StoredDrift>>
Journal::find_drift(std::string folder, std::string which, std::string axis) {
    std::function<Result<StoredDrift>()> work = [folder, which, axis] {
        return axiscal::find_drift(folder, which, axis);
    };
    co_return co_await perform<Worker, StoredDrift>(worker_.get(), std::move(work));
}

void Journal::note(EventRecord event) {
    std::vector<EventRecord> one_event;
    one_event.push_back(std::move(event));
    worker_->queue_note(worker_->noted.events, std::move(one_event));
}

void Journal::note(std::vector<EnvironmentReading> readings) {
    worker_->queue_note(worker_->noted.environment, std::move(readings));
}

void Journal::note(CircularSetup setup, std::vector<StreamSetup> streams) {
    worker_->queue_with([&](RunBatch& noted) {
        noted.circular = std::move(setup);
        noted.streams = std::move(streams);
        return true;
    });
}

bool Journal::note(StreamChunk chunk) {
    return worker_->queue_with([&](RunBatch& noted) {
        if (noted.chunks.size() >= most_chunks) return false;
        noted.chunks.push_back(std::move(chunk));
        return true;
    });
}

void Journal::note(std::vector<PreflightRecord> checks) {
    worker_->queue_note(worker_->noted.preflight, std::move(checks));
}

void Journal::note(RetakeRecord retake) {
    std::vector<RetakeRecord> one_retake;
    one_retake.push_back(std::move(retake));
    worker_->queue_note(worker_->noted.retakes, std::move(one_retake));
}

void Journal::note(std::vector<ExclusionRecord> exclusions) {
    worker_->queue_note(worker_->noted.exclusions, std::move(exclusions));
}

Task<Result<void>> Journal::flush() {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker] { return worker->save_notes(); };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<void> Journal::let_go() {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker]() -> Result<void> {
        worker->let_go();
        return {};
    };
    (void)co_await perform<Worker, void>(worker, std::move(work)); // cannot fail
}

Task<Result<void>> Journal::tidy(std::string folder) {
    std::function<Result<void>()> work = [folder] { return tidy_run_files(folder); };
    co_return co_await perform<Worker, void>(worker_.get(), std::move(work));
}

Task<Result<RunRecord>> Journal::read(std::string path) {
    std::function<Result<RunRecord>()> work = [path] { return read_run_file(path); };
    co_return co_await perform<Worker, RunRecord>(worker_.get(), std::move(work));
}

Task<Result<void>> Journal::close(bool complete, std::string reason) {
    Worker* worker = worker_.get();
    const ClockTie tie = scheduler_.clock_tie();
    std::function<Result<void>()> work = [worker, complete, reason, tie] {
        return worker->close(complete, reason, tie);
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<void>> Journal::store(std::string path, StoredResult result) {
    auto shared = std::make_shared<const StoredResult>(std::move(result));
    std::function<Result<void>()> work = [path, shared] { return store_result(path, *shared); };
    co_return co_await perform<Worker, void>(worker_.get(), std::move(work));
}

std::optional<Error> Journal::failure() const {
    return worker_->known_failure();
}

} // namespace axiscal
