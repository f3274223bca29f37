#include "acquisition/journal/journal_worker.hpp"

namespace axiscal {
namespace {

void run_unlocked(std::unique_lock<std::mutex>& lock, const std::function<void()>& job) {
    lock.unlock();
    job();
    lock.lock();
}

bool revises(const OrderRecord& order) {
    return order.kind == "retake" || order.kind == "exclude";
}

} // namespace

Journal::Worker::Worker(boost::asio::any_io_executor loop_executor,
                        JournalThread where,
                        JournalClock& journal_clock)
    : loop{std::move(loop_executor)}
    , clock{journal_clock} {
    if (where == JournalThread::own)
        thread = std::jthread{[this](const std::stop_token& stop) { serve(stop); }};
}

Journal::Worker::~Worker() {
    if (thread.joinable()) {
        thread.request_stop();
        thread.join();
    }
    (void)save_notes(); // a failure is remembered; nobody is left to hear it
}

void Journal::Worker::enqueue(Job job) {
    if (!thread.joinable()) return job();
    const std::scoped_lock lock{mutex};
    jobs.push_back(std::move(job));
    wake.notify_one();
}

// Jobs in order; between them, notes that waited long enough, however many jobs there are.
void Journal::Worker::serve(const std::stop_token& stop) {
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

RunBatch Journal::Worker::take_notes() {
    const std::scoped_lock lock{mutex};
    save_at.reset();
    return std::exchange(noted, {});
}

Result<void> Journal::Worker::save_notes() {
    if (!writer || writer->closed()) return {}; // outside a run: kept for its first commit
    if (auto why = known_failure()) {
        drop_orders();
        return tl::unexpected<Error>(*why);
    }
    RunBatch notes = take_notes();
    auto written = write(notes);
    if (!written) put_back(std::move(notes));
    return written;
}

/// Who gave them is told now that they were not kept: they must not be written later.
void Journal::Worker::drop_orders() {
    const std::scoped_lock lock{mutex};
    noted.retakes.clear();
    noted.exclusions.clear();
    std::erase_if(noted.orders, revises);
}

/// What could not be written waits for a disk. If it is there after all it stands there twice.
/// An order of a person does not wait: who gave it is told that it was not kept.
void Journal::Worker::put_back(RunBatch notes) {
    const std::scoped_lock lock{mutex};
    notes.preflight.insert(notes.preflight.end(), noted.preflight.begin(), noted.preflight.end());
    noted.preflight = std::move(notes.preflight);
    std::erase_if(notes.orders, revises);
    notes.orders.insert(notes.orders.end(), noted.orders.begin(), noted.orders.end());
    noted.orders = std::move(notes.orders);
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

Result<void> Journal::Worker::write_with_notes(RunBatch batch) {
    if (!writer) return fail(Fault::no_run_armed, "no run file is open");
    if (auto why = known_failure()) return tl::unexpected<Error>(*why);
    RunBatch notes = take_notes();
    // What was noted before comes first: the chain tells the order.
    batch.events.insert(batch.events.begin(), notes.events.begin(), notes.events.end());
    batch.environment = notes.environment;
    batch.circular = notes.circular;
    batch.streams = notes.streams;
    batch.chunks = notes.chunks;
    batch.preflight = notes.preflight;
    batch.retakes = notes.retakes;
    batch.exclusions = notes.exclusions;
    batch.orders = notes.orders;
    auto written = write(batch);
    if (!written) put_back(std::move(notes));
    return written;
}

void Journal::Worker::let_go() {
    writer.reset();
    const std::scoped_lock lock{mutex};
    broken.reset();
}

Result<void> Journal::Worker::write(const RunBatch& batch) {
    if (auto why = known_failure()) return tl::unexpected<Error>(*why);
    if (!writer) return fail(Fault::no_run_armed, "no run file is open");
    return remember(writer->write(batch));
}

Result<void> Journal::Worker::remember(Result<void> outcome) {
    if (outcome || outcome.error().fault != Fault::not_durable) return outcome;
    const std::scoped_lock lock{mutex};
    broken = outcome.error();
    return outcome;
}

std::optional<Error> Journal::Worker::known_failure() const {
    const std::scoped_lock lock{mutex};
    return broken;
}

Result<void> Journal::Worker::take(Result<RunFileWriter> opened) {
    if (!opened) return remember(tl::unexpected<Error>(opened.error()));
    writer.emplace(*std::move(opened));
    writer->reserve_log();
    return {};
}

Result<void> Journal::Worker::may_open() {
    if (writer) return fail(Fault::busy, writer->path() + " is still open");
    let_go();
    return {};
}

Result<void> Journal::Worker::close(bool complete, const std::string& reason, const ClockTie& tie) {
    AXISCAL_CHECK(save_notes());
    if (auto why = known_failure()) return tl::unexpected<Error>(*why);
    if (!writer) return fail(Fault::no_run_armed, "no run file is open");
    auto closed = remember(writer->close(complete, reason, tie, key.get()));
    if (closed) writer.reset();
    return closed;
}

} // namespace axiscal
