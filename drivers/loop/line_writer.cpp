#include "drivers/loop/line_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <poll.h>
#include <string>
#include <unistd.h>

namespace axiscal {

/// What both sides know. The thread holds it, too: it may outlive its writer.
struct LineWriter::Queue {
    explicit Queue(int to)
        : descriptor{to} {}

    void put(std::string_view line);
    void drop_oldest();
    bool take(std::string& batch);
    void serve();

    const int descriptor;
    std::mutex mutex; ///< guards the rest
    std::condition_variable wake, left;
    std::string kept;
    std::size_t missing = 0; ///< lines that went before the first one kept
    bool finishing = false, ended = false;
};

namespace {

std::string word_of(std::size_t missing) {
    if (missing == 0) return {};
    return "axiscald: " + std::to_string(missing) +
           " lines are missing here: whoever reads this log did not take them in time\n";
}

/// A descriptor that is closed or refuses takes nothing more of this; there is nobody to tell.
void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count >= 0) {
            text.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno == EAGAIN) { // somebody who shares it made it so
            ::pollfd ready{descriptor, POLLOUT, 0};
            (void)::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            return;
        }
    }
}

} // namespace

/// A line longer than all that may be kept is kept alone.
void LineWriter::Queue::put(std::string_view line) {
    {
        const std::lock_guard lock{mutex};
        if (finishing) return;
        while (!kept.empty() && kept.size() + line.size() > most_kept_bytes)
            drop_oldest();
        kept.append(line);
    }
    wake.notify_one();
}

/// A sixteenth of the room at once: dropped one by one, each line would move all the others.
void LineWriter::Queue::drop_oldest() {
    const std::size_t newline = kept.find('\n', std::min(most_kept_bytes / 16, kept.size() - 1));
    const auto end = kept.begin() + static_cast<std::ptrdiff_t>(
                                        newline == std::string::npos ? kept.size() : newline + 1);
    missing += static_cast<std::size_t>(std::count(kept.begin(), end, '\n'));
    kept.erase(kept.begin(), end);
}

/// Waits for lines. False when there are none and will be none.
bool LineWriter::Queue::take(std::string& batch) {
    std::unique_lock lock{mutex};
    wake.wait(lock, [this] { return finishing || !kept.empty(); });
    batch.clear();
    batch.swap(kept);
    batch.insert(0, word_of(missing));
    missing = 0;
    ended = batch.empty();
    return !ended;
}

void LineWriter::Queue::serve() {
    std::string batch;
    while (take(batch))
        write_all(descriptor, batch);
    left.notify_all();
}

LineWriter::LineWriter(int descriptor)
    : queue_{std::make_shared<Queue>(descriptor)}
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
        thread_.detach(); // it hangs in write(2) and goes with the process
}

void LineWriter::put(std::string_view line) {
    queue_->put(line);
}

} // namespace axiscal
