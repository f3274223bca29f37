#include "drivers/loop/line_writer.hpp"

#include <cerrno>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <poll.h>
#include <syslog.h>
#include <unistd.h>
#include <utility>

namespace axiscal {

/// What both sides know. The thread holds it, too: it may outlive its writer.
struct LineWriter::Queue {
    explicit Queue(Deliver to)
        : deliver{std::move(to)} {}

    void put(LogLine line);
    void drop_oldest();
    bool take(std::deque<LogLine>& batch);
    void serve();

    const Deliver deliver;
    std::mutex mutex; ///< guards the rest
    std::condition_variable wake, left;
    std::deque<LogLine> kept;
    std::size_t kept_bytes = 0; ///< of their text
    std::size_t missing = 0;    ///< lines that went before the first one kept
    bool finishing = false, ended = false;
};

namespace {

LogLine word_of(std::size_t missing) {
    std::string text =
        "axiscald: " + std::to_string(missing) +
        " lines are missing here: whoever reads this log did not take them in time\n";
    return {std::move(text), LOG_WARNING, {}};
}

} // namespace

void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count >= 0) {
            text.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno == EAGAIN) {
            ::pollfd ready{descriptor, POLLOUT, 0};
            (void)::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            return;
        }
    }
}

/// A line longer than all that may be kept is kept alone.
void LineWriter::Queue::put(LogLine line) {
    {
        const std::lock_guard lock{mutex};
        if (finishing) return;
        while (!kept.empty() && kept_bytes + line.text.size() > most_kept_bytes)
            drop_oldest();
        kept_bytes += line.text.size();
        kept.push_back(std::move(line));
    }
    wake.notify_one();
}

void LineWriter::Queue::drop_oldest() {
    kept_bytes -= kept.front().text.size();
    kept.pop_front();
    ++missing;
}

/// Waits for lines. False when there are none and will be none.
bool LineWriter::Queue::take(std::deque<LogLine>& batch) {
    batch.clear();
    std::unique_lock lock{mutex};
    wake.wait(lock, [this] { return finishing || !kept.empty(); });
    batch.swap(kept);
    kept_bytes = 0;
    if (missing != 0) batch.push_front(word_of(std::exchange(missing, 0)));
    ended = batch.empty();
    return !ended;
}

void LineWriter::Queue::serve() {
    std::deque<LogLine> batch;
    while (take(batch))
        for (const LogLine& line : batch)
            deliver(line);
    left.notify_all();
}

LineWriter::LineWriter(int descriptor)
    : LineWriter{[descriptor](const LogLine& line) { write_all(descriptor, line.text); }} {}

LineWriter::LineWriter(Deliver deliver)
    : queue_{std::make_shared<Queue>(std::move(deliver))}
    , thread_{[queue = queue_] { queue->serve(); }} {}

LineWriter::~LineWriter() {
    std::unique_lock lock{queue_->mutex};
    queue_->finishing = true;
    queue_->wake.notify_one();
    const bool ended = queue_->left.wait_for(lock, last_words, [this] { return queue_->ended; });
    lock.unlock();
    if (ended)
        thread_.join();
    else
        thread_.detach(); // it hangs in the delivery and goes with the process
}

void LineWriter::put(LogLine line) {
    queue_->put(std::move(line));
}

} // namespace axiscal
