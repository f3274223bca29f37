#pragma once
// A log that nobody reads stops whoever writes it. Here a thread of its own writes, so that the
// loop never waits for a full pipe, a stopped terminal or a journal that hangs.

#include "drivers/loop/scheduler.hpp"

#include <cstddef>
#include <memory>
#include <string_view>
#include <thread>

namespace axiscal {

/// Thread-safe. Lines go out in order, whole ones together; an idle writer wakes for nothing.
class LineWriter {
public:
    /// Kept for a reader that is slow, some thousand lines. Beyond it the oldest go, and where they
    /// would have stood one line says how many.
    static constexpr std::size_t most_kept_bytes = std::size_t{128} * 1024;
    /// How long the end waits for the reader.
    static constexpr Duration last_words = std::chrono::seconds{1};

    /// The descriptor stays the caller's, and open for as long as the process lives: a thread that
    /// hangs in write(2) is left behind.
    explicit LineWriter(int descriptor);
    ~LineWriter(); ///< writes what is kept, within last_words
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;

    /// Never waits for the descriptor. `line` ends with its newline.
    void put(std::string_view line);

private:
    struct Queue;
    std::shared_ptr<Queue> queue_;
    std::thread thread_;
};

} // namespace axiscal
