#pragma once
// A log that nobody reads stops whoever writes it. Here a thread of its own writes, so that the
// loop never waits for a full pipe, a stopped terminal or a journal that hangs.

#include "drivers/loop/log_line.hpp"
#include "drivers/loop/scheduler.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

namespace axiscal {

/// Thread-safe. Lines go out whole and in order; an idle writer wakes for nothing.
class LineWriter {
public:
    /// Text that is kept for a reader that is slow, some thousand lines. Beyond it the oldest go,
    /// and where they would have stood one line says how many.
    static constexpr std::size_t most_kept_bytes = std::size_t{128} * 1024;
    /// How long the end waits for the reader.
    static constexpr Duration last_words = std::chrono::seconds{1};
    /// Takes one line, on the thread, and may wait for ever. The thread may be left behind in it:
    /// what it uses must be its own, or last as long as the process.
    using Deliver = std::function<void(const LogLine&)>;

    /// Writes the text alone. The descriptor stays the caller's, and open for as long as the
    /// process lives.
    explicit LineWriter(int descriptor);
    explicit LineWriter(Deliver deliver);
    ~LineWriter(); ///< writes what is kept, within last_words
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;

    /// Never waits for the reader.
    void put(LogLine line);
    /// About nothing. `line` ends with its newline.
    void put(std::string line) { put(LogLine{std::move(line), 6, {}}); }

private:
    struct Queue;
    std::shared_ptr<Queue> queue_;
    std::thread thread_;
};

/// Waits until the descriptor has taken all of it, also where somebody who shares it made it
/// non-blocking. One that is closed or refuses takes nothing more of this; there is nobody to tell.
void write_all(int descriptor, std::string_view text);

} // namespace axiscal
