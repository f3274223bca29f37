#pragma once
// A pseudo terminal whose slave is found under a name of our choice: the simulated cable.
// A reader that is slow or absent never blocks the writer. One thread.

#include "analysis/quantity/result.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal::simulate {

class Pty {
public:
    /// Makes the pty, raw, and a symlink to its slave; an older symlink is replaced.
    /// @errors io; refused where something that is no symlink stands in the way.
    static Result<Pty> open(const std::string& link_path);
    Pty(Pty&& other) noexcept;
    Pty& operator=(Pty&&) = delete;
    ~Pty();
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    /// A late reader finds everything of the last 1.5 s (64 KiB, or what `keep` says), as behind
    /// the kernel's tty layer. What nobody reads for longer is thrown away as a whole, and counted,
    /// so that the next reader finds whole records and not an old hour.
    void write(std::string_view record);
    /// A fast instrument: so many bytes for a late reader, if that is more.
    void keep(std::size_t bytes) { largest_rest_ = std::max(largest_rest_, bytes); }
    /// What has come in, up to 4096 bytes; waits at most this long.
    std::string read(std::chrono::milliseconds wait);
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; } ///< times
    /// Whole lines thrown away, without the few that the kernel had already.
    [[nodiscard]] std::uint64_t lines_dropped() const { return lines_dropped_; }

private:
    Pty(int master, int slave, std::string link)
        : master_{master}
        , slave_{slave}
        , link_{std::move(link)} {}
    [[nodiscard]] std::string_view rest() const { return std::string_view{rest_}.substr(gone_); }
    bool flush_rest();
    void drop();

    int master_ = -1, slave_ = -1; ///< our own slave handle keeps the line raw between readers
    std::string link_, rest_;
    std::size_t gone_ = 0;              ///< of rest_: what lies before was written
    std::size_t largest_rest_ = 65'536; ///< as much as the tty layer of Linux keeps
    std::uint64_t dropped_ = 0, lines_dropped_ = 0;
    std::optional<std::chrono::steady_clock::time_point> stuck_since_;
};

} // namespace axiscal::simulate
